#include "graph/file/doubt.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "graph/file/text_bytes.h"

namespace kinegraph {

namespace {

using Codes = std::set<std::string_view>;

// Of what is there, whatever may be missing or stand elsewhere.
bool is_certain(const Diagnostic& problem) {
  static const Codes certain = {
      "syntax",        "bad-number",      "not-finite",         "trailing-comma", "comment",
      "bad-utf8",      "bad-character",   "byte-order-mark",    "not-a-graph",    "bad-version",
      "newer-schema",  "unknown-type",    "newer-version",      "unknown-param",  "unknown-port",
      "out-of-range",  "bad-range",       "bad-choice",         "bad-value",      "wrong-length",
      "bad-link",      "needs-list",      "one-link",           "type-mismatch",  "not-an-integer",
      "missing-file",  "unreadable-file", "not-a-regular-file", "bad-path",       "leads-outside",
      "absolute-path", "backslash-path",  "conflict-markers"};
  return certain.contains(problem.code);
}
bool is_of_form(const Diagnostic& problem) {
  return problem.code == "syntax" || problem.code == "trailing-comma";
}
bool is_of_bytes(const Diagnostic& problem) {
  return problem.code == "bad-utf8" || problem.code == "bad-character";
}
bool speaks_of_replaced(const Diagnostic& problem) {
  return has_replaced(problem.message) || has_replaced(problem.node) || has_replaced(problem.param);
}

}  // namespace

void drop_other_side(Diagnostics& problems, const Diagnostics& of_other, const Doubt& doubt) {
  const auto in_conflict = [&](int line) {
    return std::any_of(doubt.conflicts.begin(), doubt.conflicts.end(),
                       [&](const auto& block) { return line >= block.first && line <= block.second; });
  };
  std::set<std::tuple<std::string_view, int, int>> others;
  for (const Diagnostic& problem : of_other)
    others.insert({problem.code, problem.place.line, problem.place.column});
  std::erase_if(problems, [&](const Diagnostic& problem) {
    const auto [line, column] = problem.place;
    if (doubt.torn_at > 0 && line >= doubt.torn_at) return is_of_form(problem) || !is_certain(problem);
    return doubt.other_side && !in_conflict(line) && !others.contains({problem.code, line, column});
  });
}

void drop_consequences(Diagnostics& problems, const Doubt& doubt) {
  if (doubt.anywhere)
    std::erase_if(problems, [&](const Diagnostic& problem) { return !is_certain(problem); });
  if (std::any_of(problems.begin(), problems.end(), is_of_bytes))
    std::erase_if(problems, [&](const Diagnostic& problem) {
      return !is_of_bytes(problem) && speaks_of_replaced(problem);
    });
  const Codes of_values = {"syntax", "bad-number", "not-finite"},
              of_keys = {"unknown-key", "unknown-param", "unknown-port", "bad-name", "duplicate-key"};
  std::set<std::tuple<std::string, int, int>> unread;
  const auto at = [](const Diagnostic& problem) {
    return std::tuple(problem.file, problem.place.line, problem.place.column);
  };
  std::erase_if(problems, [&](const Diagnostic& problem) {
    const bool of_value = of_values.contains(problem.code) && problem.node.empty();
    if (of_value) return !unread.insert(at(problem)).second;
    if (problem.code == "not-finite") return !unread.empty();  // by way of a variable
    return unread.contains(at(problem)) && !of_keys.contains(problem.code);
  });
}

bool stands_before(const Diagnostic& a, const Diagnostic& b) {
  return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
}

}  // namespace kinegraph
