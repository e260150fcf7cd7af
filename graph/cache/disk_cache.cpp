#include "graph/cache/disk_cache.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>
#include <utility>

#include "graph/cache/cache_folder.h"
#include "graph/cache/entry.h"

namespace kinegraph {
namespace {

// What a full cache is brought down to, so that it isn't full again at the next entry.
std::uint64_t kept_by(std::uint64_t limit) {
  return limit - limit / 10;
}

}  // namespace

struct DiskCache::State {
  State(std::string path, std::uint64_t bytes, const Registry& types)
      : folder(std::move(path)), limit(bytes), registry(types) {}

  const std::string folder;
  const std::uint64_t limit;
  const Registry& registry;

  std::mutex mutex;
  Diagnostics warnings;
  std::set<Key> damaged;  // to be written over, although there
  bool measured = false;
  std::uint64_t held = 0;            // bytes in the folder, as far as known
  std::uint64_t since_measured = 0;  // bytes written by this process since `held` was measured

  void warn(Diagnostic what) {
    std::lock_guard lock(mutex);
    for (const auto& earlier : warnings)
      if (earlier.code == what.code) return;
    warnings.push_back(std::move(what));
  }

  // Other processes write too, so what is known ages with the bytes written here: the folder is measured
  // again after every sixteenth of the limit, which keeps the cost of looking small beside that of writing.
  void count(std::uint64_t written) {
    if (limit == 0) return;
    {
      std::lock_guard lock(mutex);
      held += written;
      since_measured += written;
      if (measured && held <= limit && since_measured < limit / 16) return;
      since_measured = 0;
      measured = true;
    }
    auto now = stat(folder);
    if (now.bytes > limit) now = collect(folder, kept_by(limit));
    std::lock_guard lock(mutex);
    held = now.bytes;
  }
};

DiskCache::DiskCache(std::string folder, std::uint64_t limit_bytes, const Registry& registry)
    : state_(std::make_unique<State>(std::move(folder), limit_bytes, registry)) {}
DiskCache::~DiskCache() = default;

const std::string& DiskCache::folder() const {
  return state_->folder;
}

std::optional<Cached> DiskCache::find(const Key& key, const GiveUp& give_up) {
  const auto path = entry_path(state_->folder, key);
  try {
    std::string bytes;
    if (auto why = read_entry_file(path, bytes, give_up)) {
      if (why != std::errc::no_such_file_or_directory && why != std::errc::not_a_directory) {
        state_->warn(warning("cache-unreadable", "cache entry " + path + " can't be read: " + why.message())
                         .hinting("check the permissions of the cache folder"));
      }
      return std::nullopt;
    }
    auto cached = decode_entry(key, bytes, state_->registry, give_up);
    touch_entry_file(path);
    return cached;
  } catch (const Cancelled&) {
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& what) {
    // Left in place: another process may have mended it by now. The next put writes over it.
    {
      std::lock_guard lock(state_->mutex);
      state_->damaged.insert(key);
    }
    state_->warn(
        warning("cache-damaged", "cache entry " + path + " is damaged (" + what.what() + "); computed again")
            .hinting("`kinegraph cache verify` looks at all of them"));
    return std::nullopt;
  }
}

bool DiskCache::contains(const Key& key) const {
  struct stat info {};
  return ::stat(entry_path(state_->folder, key).c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

void DiskCache::put(const Key& key, const Cached& entry, const GiveUp& give_up) {
  bool over = false;
  {
    std::lock_guard lock(state_->mutex);
    over = state_->damaged.contains(key);
  }
  if (!over && contains(key)) return;
  try {
    const auto bytes = encode_entry(key, entry, give_up);
    if (state_->limit != 0 && bytes.size() > kept_by(state_->limit)) {
      // It would push out everything else, and then go itself.
      state_->warn(warning("cache-limit", "a result of " + std::to_string(bytes.size()) +
                                              " bytes is larger than the cache may hold, and isn't kept")
                       .hinting("give a larger --cache-limit"));
      return;
    }
    const auto why = write_entry_file(entry_path(state_->folder, key), bytes, give_up);
    if (!why) {
      {
        std::lock_guard lock(state_->mutex);
        state_->damaged.erase(key);
      }
      state_->count(bytes.size());
    } else if (why.value() == ENOSPC || why.value() == EDQUOT) {
      state_->warn(warning("cache-full", "no room left for the cache in " + state_->folder)
                       .hinting("free some, or give a smaller --cache-limit"));
    } else {
      state_->warn(
          warning("cache-unwritable", "the cache " + state_->folder + " can't be written: " + why.message())
              .hinting("check the folder's permissions, or give another --cache"));
    }
  } catch (const Cancelled&) {
  } catch (const std::exception& what) {
    state_->warn(warning("cache-unwritable", std::string("a cache entry could not be made: ") + what.what()));
  }
}

std::unique_ptr<Claim> DiskCache::claim(const Key& node_key, const GiveUp& give_up) {
  return Claim::wait_for(state_->folder, node_key, give_up);
}

Diagnostics DiskCache::take_warnings() {
  std::lock_guard lock(state_->mutex);
  return std::exchange(state_->warnings, {});
}

namespace {

void add(DiskCache::Stat& stat, const CacheFile& file) {
  (file.key ? stat.entries : stat.leftovers) += 1;
  stat.bytes += file.bytes;
}

}  // namespace

DiskCache::Stat DiskCache::stat(const std::string& folder) {
  Stat all;
  for (const auto& file : cache_files(folder)) add(all, file);
  return all;
}

DiskCache::Stat DiskCache::verify(const std::string& folder,
                                  const std::function<void(std::string)>& damaged) {
  Stat all;
  for (const auto& file : cache_files(folder)) {
    add(all, file);
    if (!file.key) continue;
    std::string bytes;
    const auto why = read_entry_file(file.path, bytes, {});
    if (why == std::errc::no_such_file_or_directory) continue;  // collected meanwhile
    if (why || !is_whole_entry(*file.key, bytes)) {
      ++all.damaged;
      if (damaged) damaged(file.path);
    }
  }
  return all;
}

DiskCache::Stat DiskCache::collect(const std::string& folder, std::uint64_t limit_bytes,
                                   double leftover_age) {
  auto files = cache_files(folder);
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.age != b.age ? a.age > b.age : a.path < b.path; });
  Stat left;
  for (const auto& file : files) add(left, file);
  for (const auto& file : files) {
    const bool stale = !file.key && file.age > leftover_age;
    const bool excess = file.key && limit_bytes > 0 && left.bytes > limit_bytes;
    if (!stale && !excess) continue;
    if (::unlink(file.path.c_str()) != 0 && errno != ENOENT) continue;
    left.bytes -= file.bytes;
    (file.key ? left.entries : left.leftovers) -= 1;
  }
  return left;
}

DiskCache::Stat DiskCache::clear(const std::string& folder) {
  Stat removed;
  for (const auto& file : cache_files(folder))
    if (::unlink(file.path.c_str()) == 0) add(removed, file);
  return removed;
}

}  // namespace kinegraph
