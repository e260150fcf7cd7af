// The disk cache's folder: where entries lie, what is in it, and putting a file there whole or not at all.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "graph/key.h"

namespace kinegraph {

std::error_code make_folders(const std::string& path);  // all that are missing
std::string entry_path(const std::string& folder, const Key& key);

struct CacheFile {
  std::string path;
  std::optional<Key> key;  // nothing: a leftover
  std::uint64_t bytes = 0;
  double age = 0;  // seconds since its last use
};
// Every entry and leftover, in no order. Other files are not the cache's and are left out.
std::vector<CacheFile> cache_files(const std::string& folder);

// The whole file, or why not.
std::error_code read_entry_file(const std::string& path, std::string& bytes,
                                const std::function<bool()>& give_up);
// Writes beside and renames. On an error nothing is left behind.
std::error_code write_entry_file(const std::string& path, std::string_view bytes,
                                 const std::function<bool()>& give_up);
// Renews the time of last use, at most once a minute.
void touch_entry_file(const std::string& path);

}  // namespace kinegraph
