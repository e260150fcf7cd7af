#include "nodes/motion/joint_pattern.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/diagnostic.h"

namespace kinegraph {

namespace {

// One pattern of a list: characters, each literal or the wildcard.
struct Item {
  std::string shown;        // as written, for messages
  bool removes = false;     // -
  bool with_below = false;  // >
  std::string characters;
  std::vector<bool> wild;  // characters[i] is an unescaped *
  bool exact = true;
  std::size_t literals = 0;  // characters that aren't wildcards
};

[[noreturn]] void bad_pattern(std::string_view param, std::string_view pattern, std::string_view what) {
  throw Failure(
      error("bad-pattern", fmt::format("\"{}\": {}", pattern, what))
          .at_param(std::string(param))
          .hinting("patterns are names, * for any characters, - to leave out, > for all below, with commas "
                   "between; \\ takes a character as it is"));
}

Item parsed_item(std::string_view text, std::string_view param, std::string_view pattern) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  Item item;
  item.shown = text;
  if (!text.empty() && text.front() == '-') {
    item.removes = true;
    text.remove_prefix(1);
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    bool escaped = false;
    if (c == '\\') {
      if (i + 1 == text.size() || std::string_view(",*>-\\").find(text[i + 1]) == std::string_view::npos)
        bad_pattern(param, pattern, "a \\ stands before a character that needs none");
      c = text[++i];
      escaped = true;
    }
    if (c == '>' && !escaped) {
      if (i + 1 != text.size()) bad_pattern(param, pattern, "> stands only at the end of a name");
      item.with_below = true;
      break;
    }
    bool wild = c == '*' && !escaped;
    item.characters += c;
    item.wild.push_back(wild);
    if (wild)
      item.exact = false;
    else
      ++item.literals;
  }
  if (item.characters.empty()) bad_pattern(param, pattern, "a name is missing");
  return item;
}

std::vector<Item> parsed(std::string_view pattern, std::string_view param) {
  std::vector<Item> items;
  if (pattern.find_first_not_of(' ') == pattern.npos) return items;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= pattern.size(); ++i) {
    if (i < pattern.size() && pattern[i] == '\\') {
      ++i;
      if (i < pattern.size()) continue;
    }
    if (i < pattern.size() && pattern[i] != ',') continue;
    items.push_back(parsed_item(pattern.substr(begin, i - begin), param, pattern));
    begin = i + 1;
  }
  return items;
}

bool matches(const Item& item, std::string_view name) {
  if (item.exact) return item.characters == name;
  // Greedy with one place to come back to: the last * takes one character more.
  std::size_t p = 0, n = 0, star = std::string::npos, resume = 0;
  while (n < name.size()) {
    if (p < item.characters.size() && item.wild[p]) {
      star = p++;
      resume = n;
    } else if (p < item.characters.size() && item.characters[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < item.characters.size() && item.wild[p]) ++p;
  return p == item.characters.size();
}

std::vector<std::string> names_of(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

// Names that the item takes, its descendants included; tells when there are none.
std::vector<bool> taken_by(const Item& item, const std::vector<std::string>& names, const Skeleton* skeleton,
                           std::string_view param, Work& work) {
  std::vector<bool> taken(names.size());
  bool any = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    taken[i] = matches(item, names[i]);
    any = any || taken[i];
  }
  if (!any && item.exact) {
    throw Failure(error("unknown-joint", fmt::format("there is no \"{}\"", item.characters))
                      .at_param(std::string(param))
                      .at_joint(item.characters)
                      .hinting(suggestion(item.characters, names)));
  }
  if (!any) {
    work.report(warning("no-joint", fmt::format("\"{}\" matches no name", item.shown))
                    .at_param(std::string(param))
                    .hinting(suggestion(item.characters, names)));
  }
  if (item.with_below && skeleton) {
    for (int j = 0; j < skeleton->size(); ++j) {
      int parent = skeleton->joints[j].parent;
      if (parent >= 0 && taken[parent]) taken[j] = true;
    }
  }
  return taken;
}

std::vector<bool> chosen(const std::vector<Item>& items, const std::vector<std::string>& names,
                         const Skeleton* skeleton, std::string_view param, Work& work) {
  std::vector<bool> flags(names.size(), !items.empty() && items[0].removes);
  for (const Item& item : items) {
    auto taken = taken_by(item, names, skeleton, param, work);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (taken[i]) flags[i] = !item.removes;
  }
  return flags;
}

}  // namespace

std::vector<bool> chosen_joints(std::string_view pattern, const Skeleton& skeleton, std::string_view param,
                                Work& work) {
  return chosen(parsed(pattern, param), names_of(skeleton), &skeleton, param, work);
}

std::vector<bool> chosen_names(std::string_view pattern, const std::vector<std::string>& names,
                               std::string_view param, Work& work) {
  auto items = parsed(pattern, param);
  for (const Item& item : items)
    if (item.with_below) bad_pattern(param, pattern, "> has no meaning for names that form no tree");
  return chosen(items, names, nullptr, param, work);
}

void check_pattern(std::string_view pattern) {
  parsed(pattern, {});
}

std::vector<int> most_specific(const std::vector<std::string>& patterns, const Skeleton& skeleton,
                               std::string_view param, Work& work) {
  struct Match {
    int pattern = -1;
    bool exact = false;
    std::size_t literals = 0;
  };
  auto names = names_of(skeleton);
  std::vector<Match> best(names.size());
  for (std::size_t p = 0; p < patterns.size(); ++p) {
    auto items = parsed(patterns[p], param);
    auto flags = chosen(items, names, &skeleton, param, work);
    Alone unheard;  // the line above has told already
    std::vector<Match> matches_of(names.size(), Match{static_cast<int>(p), false, 0});
    for (const Item& item : items) {
      if (item.removes) continue;
      auto taken = taken_by(item, names, &skeleton, param, unheard);
      for (std::size_t j = 0; j < names.size(); ++j) {
        if (!taken[j]) continue;
        matches_of[j].exact = matches_of[j].exact || (item.exact && item.characters == names[j]);
        matches_of[j].literals = std::max(matches_of[j].literals, item.literals);
      }
    }
    for (std::size_t j = 0; j < names.size(); ++j) {
      if (!flags[j]) continue;
      const Match& match = matches_of[j];
      Match& kept = best[j];
      bool better = kept.pattern < 0                  ? true
                    : match.exact != kept.exact       ? match.exact
                    : match.literals != kept.literals ? match.literals > kept.literals
                                                      : patterns[p] < patterns[kept.pattern];
      if (better) kept = match;
    }
  }
  std::vector<int> chosen_patterns;
  for (const Match& match : best) chosen_patterns.push_back(match.pattern);
  return chosen_patterns;
}

}  // namespace kinegraph
