#include "graph/evaluate/file_store.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>

#include "graph/evaluate/real_path.h"
#include "graph/missing_file.h"

namespace kinegraph {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece = std::size_t{1} << 20;
constexpr std::int64_t too_young =
    2'000'000'000;  // ns: coarser clocks of file systems could hide a second change

struct Descriptor {
  int number = -1;
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

// Where an open file really is, whatever links led to it.
std::string path_of(int descriptor) {
  std::error_code problem;
  auto path = fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), problem);
  return problem ? std::string() : path.string();
}

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

// What tells one content of a file from another without reading it. The change time is part of it because a
// copy can keep size, inode and modification time.
struct Identity {
  dev_t device;
  ino_t inode;
  off_t size;
  std::int64_t modified, changed;
  auto operator<=>(const Identity&) const = default;
};
Identity identity_of(const struct stat& info) {
  return {info.st_dev, info.st_ino, info.st_size, nanoseconds(info.st_mtim), nanoseconds(info.st_ctim)};
}
bool is_old_enough(const Identity& identity) {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return nanoseconds(now) - std::max(identity.modified, identity.changed) >= too_young;
}

}  // namespace

struct FileStore::State {
  std::vector<std::string> roots;  // links resolved
  bool sandboxed = false;

  mutable std::mutex mutex;
  std::vector<std::string> named;
  std::map<Identity, Key> digests;
  std::atomic<std::uint64_t> made{0};

  bool allowed(const std::string& real) const {
    if (!sandboxed) return true;
    if (real.empty()) return false;
    for (const auto& root : roots)
      if (is_below(real, root)) return true;
    std::lock_guard lock(mutex);
    for (const auto& path : named)
      if (is_below(real, real_path(path))) return true;
    return false;
  }

  bool is_named(const std::string& path) const {
    std::lock_guard lock(mutex);
    return std::find(named.begin(), named.end(), path) != named.end();
  }

  [[noreturn]] static void outside(const std::string& shown) {
    throw Failure(error("outside-sandbox", "'" + shown + "' lies outside the folders that may be read")
                      .hinting("move it below the graph's folder, or name its folder with --assets"));
  }
  [[noreturn]] static void irregular(const std::string& shown, mode_t mode) {
    const char* what = S_ISDIR(mode)    ? "a folder"
                       : S_ISFIFO(mode) ? "a pipe"
                       : S_ISSOCK(mode) ? "a socket"
                                        : "a device";
    throw Failure(
        error("not-a-regular-file", "'" + shown + "' is " + what).hinting("only regular files are read"));
  }
  [[noreturn]] void unopened(const std::string& path, const std::string& shown, int why) const {
    const bool visible = allowed(real_path(path));
    if (!visible) outside(shown);
    if (why == ENOENT || why == ENOTDIR) {
      const auto instead = what_is_instead_of(path);
      throw Failure(error("missing-file", "there is no file '" + shown + "'")
                        .hinting(!instead.empty() ? instead
                                 : is_named(path)
                                     ? "check the path: one on the command line starts at the current folder"
                                     : "check the path: a graph's own start at its folder, the command "
                                       "line's at the current one"));
    }
    throw Failure(error("unreadable-file", "'" + shown + "' can't be read: " + std::strerror(why))
                      .hinting("check its permissions"));
  }

  // A pipe or device is not even opened where that can be seen beforehand; what is opened is looked at again,
  // because the name may have changed hands in between.
  int open(const std::string& path, const std::string& shown, struct stat& info) const {
    if (path.find('\0') != std::string::npos) unopened(path.c_str(), shown, ENOENT);
    if (::stat(path.c_str(), &info) != 0) unopened(path, shown, errno);
    if (sandboxed && !allowed(real_path(path))) outside(shown);
    if (!S_ISREG(info.st_mode)) irregular(shown, info.st_mode);
    const int opened = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (opened < 0) unopened(path, shown, errno);
    Descriptor guard(opened);
    if (::fstat(opened, &info) != 0) unopened(path, shown, errno);
    if (!S_ISREG(info.st_mode)) irregular(shown, info.st_mode);
    if (sandboxed && !allowed(path_of(opened))) outside(shown);
    guard.number = -1;
    return opened;
  }

  // Calls `take` with each piece up to the file's end.
  template <class Take>
  static void read_all(int file, const std::string& shown, const std::function<void()>& check, char* buffer,
                       std::size_t size, const Take& take) {
    while (true) {
      if (check) check();
      const auto got = ::read(file, buffer, size);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        throw Failure(error("unreadable-file", "'" + shown + "' can't be read: " + std::strerror(errno)));
      }
      if (got == 0) return;
      take(std::string_view(buffer, static_cast<std::size_t>(got)));
    }
  }

  // `before`: as the file stood when it was opened. Remembered only if it stayed so and could not have
  // changed unseen.
  void remember(int file, const struct stat& before, const Key& digest) {
    struct stat after {};
    const auto identity = identity_of(before);
    if (::fstat(file, &after) != 0 || identity_of(after) != identity || !is_old_enough(identity)) return;
    std::lock_guard lock(mutex);
    digests[identity] = digest;
  }
};

FileStore::FileStore(std::vector<std::string> roots, std::vector<std::string> named)
    : state_(std::make_unique<State>()) {
  state_->sandboxed = !roots.empty();
  for (const auto& root : roots) state_->roots.push_back(real_path(root));
  state_->named = std::move(named);
}
FileStore::~FileStore() = default;

void FileStore::allow(std::string absolute_path) {
  std::lock_guard lock(state_->mutex);
  state_->named.push_back(std::move(absolute_path));
}

FileBytes FileStore::read(const std::string& absolute_path) {
  return read_hashed(absolute_path, {}).bytes;
}

FileStore::Content FileStore::read_hashed(const std::string& path, const Reading& reading) {
  const auto& shown = reading.shown.empty() ? path : reading.shown;
  struct stat info {};
  Descriptor file(state_->open(path, shown, info));
  struct Held {
    std::shared_ptr<void> reserved;
    std::string bytes;
  };
  auto held = std::make_shared<Held>();
  const auto size = static_cast<std::size_t>(info.st_size);
  if (reading.reserve) held->reserved = reading.reserve(size);
  held->bytes.reserve(size);
  Digester digester;
  std::string buffer(std::clamp<std::size_t>(size, 4096, piece), '\0');
  State::read_all(file.number, shown, reading.check, buffer.data(), buffer.size(), [&](std::string_view got) {
    held->bytes += got;
    digester.add(got);
  });
  Content content;
  content.digest = digester.finish();
  content.bytes = FileBytes(held, &held->bytes);
  state_->remember(file.number, info, content.digest);
  return content;
}

bool FileStore::exists(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode) && state_->allowed(real_path(path));
}

std::vector<std::string> FileStore::list(const std::string& folder) {
  std::vector<std::string> names;
  std::unique_ptr<DIR, int (*)(DIR*)> handle(::opendir(folder.c_str()), &::closedir);
  if (!handle || !state_->allowed(path_of(::dirfd(handle.get())))) return names;
  while (const auto* entry = ::readdir(handle.get())) {
    std::string name = entry->d_name;
    if (name != "." && name != "..") names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

Key FileStore::digest_of(const std::string& path, const Reading& reading) {
  const auto& shown = reading.shown.empty() ? path : reading.shown;
  struct stat info {};
  Descriptor file(state_->open(path, shown, info));
  {
    std::lock_guard lock(state_->mutex);
    auto known = state_->digests.find(identity_of(info));
    if (known != state_->digests.end()) return known->second;
  }
  Digester digester;
  std::string buffer(std::clamp<std::size_t>(static_cast<std::size_t>(info.st_size), 4096, piece), '\0');
  State::read_all(file.number, shown, reading.check, buffer.data(), buffer.size(),
                  [&](std::string_view got) { digester.add(got); });
  ++state_->made;
  const auto digest = digester.finish();
  state_->remember(file.number, info, digest);
  return digest;
}

std::uint64_t FileStore::digests_made() const {
  return state_->made;
}

}  // namespace kinegraph
