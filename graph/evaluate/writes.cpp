#include "graph/evaluate/writes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "graph/evaluate/real_path.h"

namespace kinegraph {

namespace {

namespace fs = std::filesystem;

std::string normal(const std::string& path) {
  return fs::path(path).lexically_normal().string();
}

Failure cannot_write(const std::string& path, int why) {
  return Failure(error("cannot-write", "'" + path + "' can't be written: " + std::strerror(why))
                     .hinting(why == ENOSPC || why == EDQUOT ? "free some room on the disk"
                                                             : "check the folder and its permissions"));
}

// Opens the folder of an absolute path whose links are resolved, making what is missing. No link is followed,
// so that one put there meanwhile leads nowhere.
int open_folder(const std::string& folder, const std::string& path) {
  int at = ::open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (at < 0) throw cannot_write(path, errno);
  for (const auto& part : fs::path(folder).relative_path()) {
    if (part.empty()) continue;
    int next = ::openat(at, part.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (next < 0 && errno == ENOENT) {
      if (::mkdirat(at, part.c_str(), 0777) == 0 || errno == EEXIST) {
        next = ::openat(at, part.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
      }
    }
    const int why = errno;
    struct stat info {};
    const bool link =
        next < 0 && ::fstatat(at, part.c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(info.st_mode);
    ::close(at);
    if (link) {
      throw Failure(error("write-outside",
                          "a folder of '" + path + "' is a link that leads nowhere or has just changed")
                        .hinting("remove the link"));
    }
    if (next < 0) throw cannot_write(path, why);
    at = next;
  }
  return at;
}

constexpr std::size_t write_piece = std::size_t{1} << 20;

// Closes what is open still.
struct Descriptor {
  mutable int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  int close() const { return ::close(std::exchange(number, -1)) == 0 ? 0 : errno; }
};

}  // namespace

WriteRules::WriteRules(const RunOptions& options)
    : allow_outside_(options.allow_outside), out_(options.out.empty() ? "" : real_path(options.out)) {
  for (const auto& path : options.outside_allowed) {
    outside_allowed_.insert(normal(path));
    outside_allowed_.insert(real_path(path));
  }
}

void WriteRules::reads(const std::string& path) {
  std::lock_guard lock(mutex_);
  reads_.insert(real_path(path));
}

void WriteRules::is_graph(const std::string& path) {
  std::lock_guard lock(mutex_);
  graphs_.insert(real_path(path));
}

bool WriteRules::inside(const std::string& real, const std::string& path, const std::string& of) const {
  if (allow_outside_ || is_below(real, out_)) return true;
  const bool named = outside_allowed_.contains(normal(of));
  if (path == of) return named;
  return named && fs::path(real).parent_path() == fs::path(real_path(of)).parent_path();
}

std::string WriteRules::take(const std::string& node, const std::string& path, const std::string& of) {
  const std::string real = real_path(path);
  if (!inside(real, path, of)) {
    const bool linked = is_below(normal(path), out_);
    throw Failure(error("write-outside", "'" + path + "' " +
                                             (linked ? "is linked to '" + real + "' and so " : "") +
                                             "lies outside the output folder '" + out_ + "'")
                      .hinting("give a path below --out, or allow it with --allow-outside"));
  }
  std::lock_guard lock(mutex_);
  if (real.ends_with(".kg.json") || graphs_.contains(real)) {
    throw Failure(
        error("writes-onto-graph", "'" + path + "' is a graph file").hinting("export to another file"));
  }
  if (reads_.contains(real)) {
    throw Failure(error("writes-onto-input", "'" + path + "' is a file that this run reads")
                      .hinting("export to another file"));
  }
  const auto [at, added] = taken_.emplace(real, node);
  if (!added && at->second != node) {
    throw Failure(error("shared-file", "'" + path + "' is also written by " + at->second)
                      .hinting("give each Export a file of its own"));
  }
  return real;
}

bool is_refusal(const Diagnostic& diagnostic) {
  for (const char* code : {"write-outside", "shared-file", "writes-onto-input", "writes-onto-graph"})
    if (diagnostic.code == code) return true;
  return false;
}

StagedFiles::~StagedFiles() {
  for (auto& file : files_) {
    if (!file.placed) ::unlinkat(file.folder, file.aside.c_str(), 0);
    ::close(file.folder);
  }
}

void StagedFiles::add(const std::string& path, std::string_view bytes, const std::function<void()>& check) {
  static std::atomic<unsigned> counter{0};
  const fs::path whole(path);
  Staged file;
  file.name = whole.filename().string();
  file.path = path;
  file.placed = false;
  if (file.name.empty() || file.name == "." || file.name == "..") throw cannot_write(path, EISDIR);
  file.aside = "." + file.name.substr(0, 200) + "." + std::to_string(::getpid()) + "-" +
               std::to_string(counter++) + ".tmp";
  file.content.reserve(bytes.size());
  file.folder = open_folder(whole.parent_path().string(), path);

  struct stat old {};
  const bool replaces = ::fstatat(file.folder, file.name.c_str(), &old, AT_SYMLINK_NOFOLLOW) == 0;
  const int to = replaces && S_ISDIR(old.st_mode)
                     ? (errno = EISDIR, -1)
                     : ::openat(file.folder, file.aside.c_str(),
                                O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (to < 0) {
    const int why = errno;
    ::close(file.folder);
    throw cannot_write(path, why);
  }
  if (replaces && S_ISREG(old.st_mode)) static_cast<void>(::fchmod(to, old.st_mode & 07777));
  files_.push_back(std::move(file));  // from here on the destructor removes it
  std::string& content = files_.back().content;
  const Descriptor open{to};
  for (std::size_t done = 0; done < bytes.size();) {
    check();
    const auto put = ::write(to, bytes.data() + done, std::min(bytes.size() - done, write_piece));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) throw cannot_write(path, errno);
    content.append(bytes, done, static_cast<std::size_t>(put));
    done += static_cast<std::size_t>(put);
  }
  if (const int why = open.close()) throw cannot_write(path, why);
}

void StagedFiles::put_in_place() {
  for (auto& file : files_) {
    if (::renameat(file.folder, file.aside.c_str(), file.folder, file.name.c_str()) != 0) {
      throw cannot_write(file.path, errno);
    }
    file.placed = true;
  }
}

}  // namespace kinegraph
