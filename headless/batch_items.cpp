#include "headless/batch_items.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include "headless/session.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

bool is_wild(const std::string& part) {
  return part.find_first_of("*?[") != std::string::npos;
}

// The folders before the first part with a wildcard; of a plain path its folder.
fs::path fixed_part(const std::string& glob) {
  fs::path fixed;
  const fs::path whole(glob);
  for (auto part = whole.begin(); part != whole.end(); ++part) {
    if (is_wild(part->string()) || std::next(part) == whole.end()) break;
    fixed /= *part;
  }
  return fixed;
}

void match(const fs::path& folder, fs::path::const_iterator part, fs::path::const_iterator end,
           std::set<std::string>& found) {
  std::error_code failed;
  const std::string pattern = part->string();
  const bool last = std::next(part) == end;
  if (pattern == "**" && !last) match(folder, std::next(part), end, found);
  if (!is_wild(pattern)) {
    const fs::path next = folder / *part;
    if (!last && fs::is_directory(next, failed)) match(next, std::next(part), end, found);
    if (last && fs::is_regular_file(next, failed)) found.insert(next.generic_string());
    return;
  }
  fs::directory_iterator entry(folder.empty() ? "." : folder, failed), none;
  for (; !failed && entry != none; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) != 0) continue;
    const fs::path next = folder / name;
    if (pattern == "**") {
      if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) match(next, part, end, found);
      if (last && entry->is_regular_file(ignored)) found.insert(next.generic_string());
    } else if (last) {
      if (entry->is_regular_file(ignored)) found.insert(next.generic_string());
    } else if (entry->is_directory(ignored)) {
      match(next, std::next(part), end, found);
    }
  }
}

// One list of a batch: for each of its entries a name and what is set.
struct Entry {
  std::string name;
  std::vector<std::string> sets;
  std::uint64_t bytes = 0;
  int line = 0;  // of the table
};

std::uint64_t size_of(const std::string& path) {
  std::error_code failed;
  const auto size = fs::is_regular_file(path, failed) ? fs::file_size(path, failed) : 0;
  return failed ? 0 : size;
}

std::vector<Entry> places_of_glob(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw UsageError(error("bad-option", fmt::format("--each {} is not NODE.PARAM=GLOB", text)));
  const std::string glob = text.substr(equals + 1);
  const fs::path fixed = fixed_part(glob);
  std::vector<Entry> places;
  for (const std::string& file : files_matching(glob)) {
    fs::path below = fixed.empty() ? fs::path(file) : fs::path(file).lexically_relative(fixed);
    below.replace_extension();
    places.push_back({below.generic_string(), {text.substr(0, equals + 1) + file}, size_of(file)});
  }
  if (places.empty())
    throw UsageError(
        Diagnostic(error("no-match", fmt::format("--each {}: no file matches", text))
                       .hinting("the pattern starts from the current folder; quote it from the shell; values "
                                "that are no files come from a --table")));
  return places;
}

struct Row {
  std::vector<std::string> fields = {""};
  int line = 1;
};

// RFC 4180: fields between commas, in quotes where they hold commas, quotes or line ends.
std::vector<Row> rows_of(const std::string& text) {
  std::vector<Row> rows;
  Row whole;
  std::vector<std::string>& row = whole.fields;
  bool quoted = false;
  int line = 1;
  const auto end_row = [&] {
    if (row.size() > 1 || !row[0].empty()) rows.push_back(whole);
    whole = Row{.line = line};
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    line += c == '\n';
    if (quoted) {
      if (c != '"')
        row.back() += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        row.back() += text[++i];
      else
        quoted = false;
    } else if (c == '"' && row.back().empty()) {
      quoted = true;
    } else if (c == ',') {
      row.emplace_back();
    } else if (c == '\n') {
      end_row();
    } else if (c != '\r') {
      row.back() += c;
    }
  }
  end_row();
  return rows;
}

std::vector<Entry> places_of_table(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in.is_open() || fs::is_directory(file))
    throw UsageError(Diagnostic(error("missing-file", fmt::format("the table '{}' can't be read", file))
                                    .hinting("is it there? its path starts from the current folder")));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  const auto rows = rows_of(text);
  if (rows.size() < 2)
    throw UsageError(
        Diagnostic(error("empty-table", fmt::format("the table '{}' has no rows", file))
                       .hinting("a header that names NODE.PARAM in each column, then a row for each item")));
  const auto& header = rows.front().fields;
  std::vector<Entry> places;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::vector<std::string>& fields = rows[i].fields;
    if (fields.size() != header.size())
      throw UsageError(Diagnostic(error("bad-table", fmt::format("this row has {} fields, the header {}",
                                                                 fields.size(), header.size()))
                                      .in_file(file, {rows[i].line, 1})
                                      .hinting("an empty field leaves the graph's own value: a,,c")));
    Entry place;
    place.line = rows[i].line;
    for (std::size_t column = 0; column < header.size(); ++column) {
      const std::string& value = fields[column];
      if (header[column] == "item") {
        place.name = value;
        continue;
      }
      if (value.empty()) continue;  // the graph's own value
      place.sets.push_back(header[column] + "=" + value);
      const std::uint64_t bytes = size_of(value);
      place.bytes += bytes;
      if (place.name.empty() && bytes > 0) place.name = fs::path(value).stem().string();
    }
    if (place.name.empty()) place.name = fmt::format("row_{}", i);
    places.push_back(std::move(place));
  }
  return places;
}

// A name that stays below the folder whatever it was.
std::string tame(const std::string& name) {
  std::string path;
  for (const fs::path& part : fs::path(name)) {
    const std::string text = part.string();
    if (text.empty() || text == "." || text == "/" || text == "..") continue;
    path += (path.empty() ? "" : "/") + (text == ".kinegraph" ? "_kinegraph" : text);
  }
  return path.empty() ? "item" : path;
}

}  // namespace

std::vector<std::string> files_matching(const std::string& glob) {
  std::set<std::string> found;
  const fs::path whole(glob);
  auto part = whole.begin();
  fs::path start;
  if (whole.is_absolute()) start = *part++;
  if (part != whole.end()) match(start, part, whole.end(), found);
  return {found.begin(), found.end()};
}

std::vector<BatchItem> batch_items(const BatchChoice& choice) {
  std::vector<std::vector<Entry>> lists;
  for (const std::string& text : choice.each) lists.push_back(places_of_glob(text));
  if (!choice.table.empty()) lists.push_back(places_of_table(choice.table));
  if (lists.empty())
    throw UsageError(Diagnostic(error("bad-option", "a batch needs something to run over")
                                    .hinting("--each NODE.PARAM=GLOB or --table FILE.csv")));
  std::size_t count = choice.cross ? 1 : lists.front().size();
  for (const auto& list : lists) {
    if (choice.cross)
      count *= list.size();
    else if (list.size() != count)
      throw UsageError(Diagnostic(
          error("unequal-counts", fmt::format("lists in step have {} and {} places", count, list.size()))
              .hinting("--cross runs every combination")));
  }
  std::vector<BatchItem> items;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < count; ++i) {
    BatchItem item;
    item.index = i;
    std::size_t rest = i, below = count;
    std::string name;
    for (std::size_t l = 0; l < lists.size(); ++l) {
      std::size_t at = i;
      if (choice.cross) {
        below /= lists[l].size();
        at = rest / below;
        rest %= below;
      }
      const Entry& place = lists[l][at];
      if (l == 0 || choice.cross) name += (name.empty() ? "" : "+") + place.name;
      item.sets.insert(item.sets.end(), place.sets.begin(), place.sets.end());
      item.bytes += place.bytes;
      if (place.line == 0) continue;
      item.table = choice.table;
      item.line = place.line;
    }
    name = tame(name);
    item.name = name;
    for (int n = 2; !taken.insert(item.name).second; ++n) item.name = fmt::format("{}-{}", name, n);
    items.push_back(std::move(item));
  }
  return items;
}

Shard shard_of(const std::string& text) {
  const auto whole = [](const std::string& digits) -> std::size_t {
    if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
      throw UsageError(Diagnostic(error("bad-option", fmt::format("'{}' is no shard", digits))
                                      .hinting("--shard I/N, counted from 0")));
    return std::stoul(digits);
  };
  Shard shard;
  if (!text.empty()) {
    const auto slash = text.find('/');
    shard.index = whole(text.substr(0, slash));
    shard.count = whole(slash == std::string::npos ? "" : text.substr(slash + 1));
  } else if (const char* id = std::getenv("SLURM_ARRAY_TASK_ID"); id && *id) {
    const auto variable = [](const char* name, const char* otherwise) {
      const char* value = std::getenv(name);
      return std::string(value && *value ? value : otherwise);
    };
    const std::size_t first = whole(variable("SLURM_ARRAY_TASK_MIN", "0")),
                      step = whole(variable("SLURM_ARRAY_TASK_STEP", "1"));
    const std::size_t at = whole(id);
    shard.count = whole(variable("SLURM_ARRAY_TASK_COUNT", "1"));
    if (at < first || step == 0 || (at - first) % step != 0)
      throw UsageError(
          Diagnostic(error("bad-shard", fmt::format("Slurm's array task {} is none of an even array", id))
                         .hinting("--array=0-9, or --shard I/N")));
    shard.index = (at - first) / step;
    shard.from_slurm = true;
  }
  if (shard.index >= shard.count)
    throw UsageError(
        Diagnostic(error("bad-option", fmt::format("there is no shard {} of {}", shard.index, shard.count))
                       .hinting("shards count from 0")));
  return shard;
}

std::vector<BatchItem> items_of(const Shard& shard, const std::vector<BatchItem>& all) {
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return all[a].bytes > all[b].bytes; });
  std::vector<std::pair<std::uint64_t, std::size_t>> load(shard.count);  // bytes, items
  std::vector<std::size_t> mine;
  for (const std::size_t item : order) {
    const auto least = std::min_element(load.begin(), load.end());
    least->first += all[item].bytes;
    ++least->second;
    if (static_cast<std::size_t>(least - load.begin()) == shard.index) mine.push_back(item);
  }
  std::sort(mine.begin(), mine.end());
  std::vector<BatchItem> items;
  for (const std::size_t item : mine) items.push_back(all[item]);
  return items;
}

}  // namespace kinegraph
