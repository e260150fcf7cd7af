#include "graph/cache/memory_cache.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/graph/toys.h"

namespace kinegraph {
namespace {

using toys::Numbers;

Cached of_size(std::size_t bytes) {
  return {std::make_shared<const Numbers>(std::vector<double>{}, bytes), {}};
}
Key key(std::uint64_t number) {
  return {0, number};
}

TEST(MemoryCache, GivesBackTheSameValueAndItsNotes) {
  MemoryCache cache(1 << 20);
  Cached entry = of_size(100);
  entry.notes.push_back(warning("odd", "an odd thing"));
  cache.put(key(1), entry);
  auto found = cache.find(key(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->value, entry.value);
  ASSERT_EQ(found->notes.size(), 1u);
  EXPECT_EQ(found->notes[0].code, "odd");
  EXPECT_FALSE(cache.find(key(2)));
}

TEST(MemoryCache, KeepsThatANodeHasNoSuchOutput) {
  MemoryCache cache(1 << 20);
  cache.put(key(1), {});
  ASSERT_TRUE(cache.find(key(1)));
  EXPECT_FALSE(cache.find(key(1))->value);
}

TEST(MemoryCache, IsLimitedInBytesAndDropsTheOldestUse) {
  MemoryCache cache(10'000);
  for (std::uint64_t i = 0; i < 3; ++i) cache.put(key(i), of_size(3'000));
  ASSERT_TRUE(cache.find(key(0)));  // used again, so 1 is the oldest
  cache.put(key(3), of_size(3'000));
  EXPECT_TRUE(cache.contains(key(0)));
  EXPECT_FALSE(cache.contains(key(1)));
  EXPECT_TRUE(cache.contains(key(2)));
  EXPECT_TRUE(cache.contains(key(3)));
  EXPECT_LE(cache.bytes(), 10'000u);
}

TEST(MemoryCache, DoesNotEmptyItselfForAValueLargerThanAllOfIt) {
  MemoryCache cache(10'000);
  cache.put(key(1), of_size(1'000));
  cache.put(key(2), of_size(20'000));
  EXPECT_TRUE(cache.contains(key(1)));
  EXPECT_FALSE(cache.contains(key(2)));
}

TEST(MemoryCache, FreesOnlyWhatNobodyElseHolds) {
  MemoryCache cache(100'000);
  auto held = of_size(1'000);
  cache.put(key(1), held);
  cache.put(key(2), of_size(1'000));
  cache.put(key(3), of_size(1'000));
  EXPECT_GE(cache.free_up(500), 1'000u);
  EXPECT_TRUE(cache.contains(key(1))) << "dropping it would free nothing";
  EXPECT_FALSE(cache.contains(key(2)));
  EXPECT_TRUE(cache.contains(key(3)));
}

TEST(MemoryCache, MayBeUsedByManyThreads) {
  MemoryCache cache(20'000);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::uint64_t i = 0; i < 500; ++i) {
        cache.put(key(i % 37), of_size(1'000));
        cache.find(key((i + static_cast<std::uint64_t>(t)) % 37));
        if (i % 50 == 0) cache.free_up(5'000);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_LE(cache.bytes(), 20'000u);
}

}  // namespace
}  // namespace kinegraph
