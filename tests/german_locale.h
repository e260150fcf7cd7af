// A locale whose decimal sign is the comma, made for a test.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>

namespace kinegraph {

// The folder for $LOCPATH in which de_DE.UTF-8 lies; "" where this system can't make one (Debian: package
// locales).
inline std::string german_locale_path() {
  namespace fs = std::filesystem;
  std::string folder = (fs::temp_directory_path() / "kinegraph-locale-XXXXXX").string();
  if (!mkdtemp(folder.data())) return {};
  const std::string make = "localedef -c -i de_DE -f UTF-8 '" + folder +
                           "/de_DE.UTF-8' >/dev/null 2>&1; test -e '" + folder + "/de_DE.UTF-8/LC_NUMERIC'";
  if (std::system(make.c_str()) == 0) return folder;
  fs::remove_all(folder);
  return {};
}

}  // namespace kinegraph
