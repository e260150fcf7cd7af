#include "graph/cache/cache_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <memory>
#include <random>
#include <utility>

#include "graph/diagnostic.h"

namespace kinegraph {

namespace {

constexpr std::string_view entry_ending = ".kgv";
constexpr std::string_view aside_ending = ".tmp";
constexpr std::size_t piece = std::size_t{4} << 20;

std::error_code last_error() {
  return {errno, std::generic_category()};
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  int close() { return ::close(std::exchange(number_, -1)); }

 private:
  int number_;
};

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::unique_ptr<DIR, int (*)(DIR*)> handle(::opendir(folder.c_str()), &::closedir);
  if (!handle) return names;
  while (const auto* entry = ::readdir(handle.get())) names.emplace_back(entry->d_name);
  return names;
}

bool is_shard(const std::string& name) {
  return name.size() == 2 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Unique among processes, machines that share the folder, and threads.
std::string aside_name(const std::string& path) {
  static std::atomic<std::uint64_t> counter{0};
  std::random_device entropy;
  const std::uint64_t salt = std::uint64_t{entropy()} << 32 | entropy();
  return path + "." + std::to_string(::getpid()) + "-" + std::to_string(counter++) + "-" +
         std::to_string(salt) + std::string(aside_ending);
}

}  // namespace

std::error_code make_folders(const std::string& path) {
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    if (::mkdir(part.c_str(), 0777) != 0 && errno != EEXIST) {
      const auto why = last_error();
      struct stat info {};
      if (::stat(part.c_str(), &info) != 0 || !S_ISDIR(info.st_mode)) return why;
    }
    if (slash == std::string::npos) return {};
  }
}

std::string entry_path(const std::string& folder, const Key& key) {
  const std::string name = to_text(key);
  return folder + "/" + name.substr(0, 2) + "/" + name + std::string(entry_ending);
}

std::vector<CacheFile> cache_files(const std::string& folder) {
  std::vector<CacheFile> files;
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  for (const auto& shard : names_in(folder)) {
    if (!is_shard(shard)) continue;
    for (const auto& name : names_in(folder + "/" + shard)) {
      CacheFile file;
      file.path = folder + "/" + shard + "/" + name;
      const bool aside = name.ends_with(aside_ending) && key_from_text(std::string_view(name).substr(0, 32));
      if (name.ends_with(entry_ending)) {
        file.key = key_from_text(std::string_view(name).substr(0, name.size() - entry_ending.size()));
      }
      if (!file.key && !aside) continue;
      struct stat info {};
      if (::lstat(file.path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) continue;
      file.bytes = static_cast<std::uint64_t>(info.st_size);
      file.age =
          now - static_cast<double>(info.st_mtim.tv_sec) - 1e-9 * static_cast<double>(info.st_mtim.tv_nsec);
      files.push_back(std::move(file));
    }
  }
  return files;
}

std::error_code read_entry_file(const std::string& path, std::string& bytes,
                                const std::function<bool()>& give_up) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) return last_error();
  struct stat info {};
  if (::fstat(file.number(), &info) != 0) return last_error();
  if (!S_ISREG(info.st_mode)) return std::make_error_code(std::errc::invalid_argument);
  bytes.resize(static_cast<std::size_t>(info.st_size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    if (give_up && give_up()) throw Cancelled();
    const auto got = ::read(file.number(), bytes.data() + done, std::min(piece, bytes.size() - done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return last_error();
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return {};
}

std::error_code write_entry_file(const std::string& path, std::string_view bytes,
                                 const std::function<bool()>& give_up) {
  if (auto why = make_folders(path.substr(0, path.rfind('/')))) return why;
  const std::string aside = aside_name(path);
  Descriptor file(::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.number() < 0) return last_error();
  const auto undo = [&](std::error_code why) {
    ::unlink(aside.c_str());
    return why;
  };
  for (std::size_t done = 0; done < bytes.size();) {
    if (give_up && give_up()) {
      ::unlink(aside.c_str());
      throw Cancelled();
    }
    const auto put = ::write(file.number(), bytes.data() + done, std::min(piece, bytes.size() - done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return undo(last_error());
    done += static_cast<std::size_t>(put);
  }
  if (file.close() != 0) return undo(last_error());
  if (::rename(aside.c_str(), path.c_str()) != 0) return undo(last_error());
  return {};
}

void touch_entry_file(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0 || ::time(nullptr) - info.st_mtim.tv_sec < 60) return;
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
}

}  // namespace kinegraph
