// What a batch runs: an item for each clip, or each combination, or each row of a table.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace kinegraph {

struct BatchItem {
  std::string name;  // "cmu/08_01": unique, a path below DIR
  std::size_t index = 0;
  std::vector<std::string> sets;  // "NODE.PARAM=VALUE", as --set takes them
  std::uint64_t bytes = 0;        // of the files it names
  std::string table;              // the file and the line it comes from, if it does
  int line = 0;
};

struct BatchChoice {
  std::vector<std::string> each;  // "NODE.PARAM=GLOB"
  bool cross = false;
  std::string table;  // a CSV file, or ""
};
// Items in the order of the sorted files; several lists go in step or are crossed, the last one fastest.
// Throws UsageError: no NODE.PARAM=GLOB, a glob that nothing matches, lists of unequal length, a table that
// can't be read.
std::vector<BatchItem> batch_items(const BatchChoice& choice);

// Regular files that match, sorted by bytes: *, ?, [a-z] within a name, ** for any folders.
std::vector<std::string> files_matching(const std::string& glob);

struct Shard {
  std::size_t index = 0, count = 1;
  bool from_slurm = false;
};
// "I/N", or with "" what Slurm's array variables say, or all. Throws UsageError.
Shard shard_of(const std::string& text);
// The shard's items, in order. The largest are dealt first, each to the shard that has least, so that shards
// are of about one size; the same on every machine that sees the same files.
std::vector<BatchItem> items_of(const Shard& shard, const std::vector<BatchItem>& all);

}  // namespace kinegraph
