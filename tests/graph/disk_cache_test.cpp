#include "graph/cache/disk_cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <thread>

#include "graph/cache/cache_folder.h"
#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;
using toys::Folder;
using toys::Numbers;

class DiskCacheTest : public testing::Test {
 protected:
  DiskCacheTest() { toys::add_toy_values(registry); }

  static Key key(std::uint64_t number) { return digest(std::to_string(number)); }
  static Cached numbers(std::uint64_t seed, std::size_t count = 1000) {
    std::mt19937_64 random(seed);
    std::vector<double> all(count);
    for (auto& one : all) one = std::uniform_real_distribution<>(-1, 1)(random);
    return {std::make_shared<const Numbers>(std::move(all)), {}};
  }
  static const std::vector<double>& of(const Cached& cached) {
    return dynamic_cast<const Numbers&>(*cached.value).all;
  }
  static void set_age(const std::string& path, int seconds) {
    const timespec times[2] = {{::time(nullptr) - seconds, 0}, {::time(nullptr) - seconds, 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), times, 0), 0);
  }

  Registry registry;
  Folder folder;
  const std::string place = folder / "cache";
};

TEST_F(DiskCacheTest, GivesBackBitForBitWhatWasPut) {
  Cached entry = numbers(1, 100'000);
  entry.notes.push_back(warning("odd", "an odd thing").at_joint("Hips").at_frame(3).hinting("look"));
  DiskCache(place, 0, registry).put(key(1), entry);
  DiskCache cache(place, 0, registry);
  EXPECT_TRUE(cache.contains(key(1)));
  auto found = cache.find(key(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(of(*found), of(entry));
  ASSERT_EQ(found->notes.size(), 1u);
  EXPECT_EQ(to_text(found->notes[0]), to_text(entry.notes[0]));
  EXPECT_FALSE(cache.find(key(2)));
  EXPECT_TRUE(cache.take_warnings().empty());
}

TEST_F(DiskCacheTest, KeepsEmptyValuesAndAbsentOutputs) {
  DiskCache cache(place, 0, registry);
  cache.put(key(1), numbers(1, 0));
  cache.put(key(2), {});
  ASSERT_TRUE(cache.find(key(1)));
  EXPECT_TRUE(of(*cache.find(key(1))).empty());
  ASSERT_TRUE(cache.find(key(2)));
  EXPECT_FALSE(cache.find(key(2))->value);
}

TEST_F(DiskCacheTest, MakesNoFolderBeforeTheFirstWrite) {
  DiskCache cache(place, 0, registry);
  EXPECT_FALSE(cache.find(key(1)));
  EXPECT_FALSE(fs::exists(place));
}

TEST_F(DiskCacheTest, AnyDamageIsAMissWithAWarningAndIsReplaced) {
  const auto entry = numbers(1, 50);
  const auto path = entry_path(place, key(1));
  DiskCache(place, 0, registry).put(key(1), entry);
  const auto whole = toys::content(path);
  auto try_damaged = [&](const std::string& bytes) {
    toys::write(path, bytes);
    DiskCache cache(place, 0, registry);
    EXPECT_FALSE(cache.find(key(1)));
    auto warnings = cache.take_warnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].code, "cache-damaged");
    EXPECT_EQ(warnings[0].severity, Severity::warning);
    cache.put(key(1), entry);
    EXPECT_EQ(toys::content(path), whole);
    EXPECT_TRUE(cache.find(key(1)));
    EXPECT_TRUE(cache.take_warnings().empty());
  };
  for (std::size_t at = 0; at < whole.size(); at += 7) {
    auto flipped = whole;
    flipped[at] ^= 0x10;
    try_damaged(flipped);
  }
  for (std::size_t length : {std::size_t{0}, std::size_t{5}, std::size_t{28}, whole.size() - 1})
    try_damaged(whole.substr(0, length));
  try_damaged(whole + "x");
}

TEST_F(DiskCacheTest, AnEntryUnderAnotherKeysNameIsDamaged) {
  DiskCache cache(place, 0, registry);
  cache.put(key(1), numbers(1));
  fs::create_directories(fs::path(entry_path(place, key(2))).parent_path());
  fs::rename(entry_path(place, key(1)), entry_path(place, key(2)));
  EXPECT_FALSE(cache.find(key(2)));
  EXPECT_EQ(cache.take_warnings().size(), 1u);
}

TEST_F(DiskCacheTest, AFolderThatCannotBeWrittenIsAWarningOnly) {
  toys::write(place, "a file stands where the folder should be");
  DiskCache cache(place, 0, registry);
  cache.put(key(1), numbers(1));
  auto warnings = cache.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, "cache-unwritable");
}

TEST_F(DiskCacheTest, AFullDiskIsAWarningAndLeavesNothingBehind) {
  // A write past the file size limit fails as one on a full disk does, half-way through the entry.
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    DiskCache cache(place, 0, registry);
    cache.put(key(1), numbers(1, 10'000));
    ::_exit(cache.take_warnings().size() == 1 ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(DiskCache::stat(place).entries, 0u);
  EXPECT_EQ(DiskCache::stat(place).leftovers, 0u);
}

TEST_F(DiskCacheTest, StaysWithinItsLimitAndDropsTheOldestUse) {
  const std::uint64_t limit = 200'000;
  DiskCache cache(place, limit, registry);
  for (std::uint64_t i = 0; i < 15; ++i) {
    cache.put(key(i), numbers(i));
    set_age(entry_path(place, key(i)), 3600 - static_cast<int>(i));
  }
  ASSERT_TRUE(cache.find(key(0)));  // used now, so 1 is the oldest
  for (std::uint64_t i = 15; i < 30; ++i) cache.put(key(i), numbers(i));
  EXPECT_LE(DiskCache::stat(place).bytes, limit);
  EXPECT_TRUE(cache.contains(key(0)));
  EXPECT_FALSE(cache.contains(key(1)));
  EXPECT_TRUE(cache.contains(key(29)));
}

TEST_F(DiskCacheTest, AnEntryAboveTheLimitPushesNothingOut) {
  DiskCache large(place, 0, registry);
  large.put(key(1), numbers(1));
  const std::uint64_t one = DiskCache::stat(place).bytes;
  DiskCache cache(place, one, registry);
  cache.put(key(2), numbers(2));
  EXPECT_TRUE(cache.contains(key(1)));
  EXPECT_FALSE(cache.contains(key(2)));
  const Diagnostics warnings = cache.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, "cache-limit");
  EXPECT_NE(warnings[0].hint, "");
}

TEST_F(DiskCacheTest, CollectRemovesOldLeftoversAndLeavesYoungOnes) {
  DiskCache cache(place, 0, registry);
  cache.put(key(1), numbers(1));
  const auto old = entry_path(place, key(1)) + ".1-0-1.tmp", young = entry_path(place, key(1)) + ".1-0-2.tmp";
  toys::write(old, "half");
  toys::write(young, "half");
  set_age(old, 7200);
  EXPECT_EQ(DiskCache::stat(place).leftovers, 2u);
  EXPECT_EQ(DiskCache::collect(place, 0).leftovers, 1u);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(young));
  EXPECT_TRUE(cache.contains(key(1)));
}

TEST_F(DiskCacheTest, VerifyNamesWhatIsDamagedAndClearTakesOnlyItsOwn) {
  DiskCache cache(place, 0, registry);
  for (std::uint64_t i = 0; i < 4; ++i) cache.put(key(i), numbers(i));
  toys::write(entry_path(place, key(2)), "nonsense");
  toys::write(place + "/README", "somebody's");
  toys::write(place + "/ab/notes.txt", "somebody's");
  std::vector<std::string> damaged;
  auto stat = DiskCache::verify(place, [&](std::string path) { damaged.push_back(std::move(path)); });
  EXPECT_EQ(stat.entries, 4u);
  EXPECT_EQ(stat.damaged, 1u);
  EXPECT_EQ(damaged, std::vector<std::string>{entry_path(place, key(2))});
  EXPECT_EQ(DiskCache::clear(place).entries, 4u);
  EXPECT_EQ(DiskCache::stat(place).entries, 0u);
  EXPECT_TRUE(fs::exists(place + "/README"));
  EXPECT_TRUE(fs::exists(place + "/ab/notes.txt"));
}

TEST_F(DiskCacheTest, GivesUpWhenAsked) {
  DiskCache cache(place, 0, registry);
  cache.put(key(1), numbers(1), [] { return true; });
  EXPECT_FALSE(cache.contains(key(1)));
  EXPECT_EQ(DiskCache::stat(place).leftovers, 0u);
  cache.put(key(1), numbers(1));
  EXPECT_FALSE(cache.find(key(1), [] { return true; }));
  EXPECT_TRUE(cache.find(key(1)));
  EXPECT_TRUE(cache.take_warnings().empty());
}

// Each child writes and reads the same keys under a tight limit, so that they also collect under each other's
// feet.
TEST_F(DiskCacheTest, ManyProcessesShareOneFolder) {
  std::vector<pid_t> children;
  for (int process = 0; process < 3; ++process) {
    const pid_t child = ::fork();
    if (child == 0) {
      DiskCache cache(place, 150'000, registry);
      bool good = true;
      for (std::uint64_t round = 0; round < 150; ++round) {
        const auto at = (round * 7 + static_cast<std::uint64_t>(process)) % 40;
        const auto wanted = numbers(at);
        if (auto found = cache.find(key(at))) {
          good = good && of(*found) == of(wanted);
        } else {
          cache.put(key(at), wanted);
        }
      }
      ::_exit(good && cache.take_warnings().empty() ? 0 : 1);
    }
    children.push_back(child);
  }
  for (auto child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(DiskCache::verify(place, {}).damaged, 0u);
  EXPECT_EQ(DiskCache::stat(place).leftovers, 0u);
}

TEST_F(DiskCacheTest, AKilledWriterLeavesNoTornEntry) {
  const auto large = numbers(1, 200'000);
  for (int round = 0; round < 12; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      DiskCache cache(place, 0, registry);
      for (std::uint64_t i = 0;; ++i) cache.put(key(1000 * static_cast<std::uint64_t>(round) + i), large);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 3 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  EXPECT_EQ(DiskCache::verify(place, {}).damaged, 0u);
  EXPECT_EQ(DiskCache::collect(place, 0, -1).leftovers, 0u);
}

}  // namespace
}  // namespace kinegraph
