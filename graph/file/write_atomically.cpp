#include "graph/file/write_atomically.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>

#include "graph/diagnostic.h"

namespace kinegraph {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const char* doing, int code) {
  const std::string folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path().string() : ".";
  std::string found, hint;
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      found = fmt::format("the disk of {} is full", folder);
      hint = "make room on it and try again";
      break;
    case ENOENT:
    case ENOTDIR:
      found = fmt::format("the folder {} isn't there", folder);
      hint = "make it again, or write elsewhere";
      break;
    case EACCES:
    case EPERM:
    case EROFS:
      found = fmt::format("the folder {} can't be written to", folder);
      hint = "ask for the right to write there, or write elsewhere";
      break;
    case ENAMETOOLONG:
      found = fmt::format("the name of {} is too long", path);
      hint = "give it a shorter one";
      break;
    default:
      found = fmt::format("{}: {}: {}", path, doing, std::strerror(code));
      hint = "try again, or write elsewhere";
  }
  throw Failure(error("cannot-write", found).in_file(path).hinting(hint));
}

// The file that is really written: a symbolic link stays, what it names is replaced.
fs::path link_followed(fs::path path) {
  std::error_code ignored;
  for (int hops = 0; hops < 40 && fs::is_symlink(path, ignored); ++hops) {
    const fs::path target = fs::read_symlink(path, ignored);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

// Gone again unless it was renamed.
class Aside {
 public:
  Aside(const std::string& shown, const fs::path& beside) : shown_(shown) {
    std::random_device random;
    for (int tries = 0; tries < 100; ++tries) {
      path_ = beside.parent_path() / fmt::format(".{}.{:08x}", beside.filename().string(), random());
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0 || errno != EEXIST) break;
    }
    if (descriptor_ < 0) fail(shown_, "making a file beside it", errno);
  }
  ~Aside() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

  void keep_permissions_of(const fs::path& old) {
    struct stat status;
    if (::stat(old.c_str(), &status) == 0 && ::fchmod(descriptor_, status.st_mode & 07777) != 0)
      fail(shown_, "keeping its permissions", errno);
  }
  void write(std::string_view bytes, Lasting lasting) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(shown_, "writing", errno);
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    if (lasting == Lasting::yes && ::fsync(descriptor_) != 0) fail(shown_, "syncing", errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(shown_, "closing", errno);
  }
  void rename_to(const fs::path& path) {
    if (::rename(path_.c_str(), path.c_str()) != 0) fail(shown_, "renaming", errno);
    renamed_ = true;
  }

 private:
  const std::string& shown_;
  fs::path path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

// So that the new name itself outlives a crash. Some network folders can't be synced: the file is whole
// either way.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void write_file_atomically(const std::string& path, std::string_view bytes, Lasting lasting) {
  const fs::path target = link_followed(path);
  std::error_code ignored;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
    throw Failure(error("cannot-write", fmt::format("{} is not a regular file", path)));
  Aside aside(path, target);
  aside.keep_permissions_of(target);
  aside.write(bytes, lasting);
  aside.rename_to(target);
  if (lasting == Lasting::yes) sync_folder(target.parent_path());
}

}  // namespace kinegraph
