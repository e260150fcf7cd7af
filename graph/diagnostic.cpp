#include "graph/diagnostic.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace kinegraph {

const char* name_of(Severity severity) {
  switch (severity) {
    case Severity::info:
      return "info";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return "";
}

namespace {

Diagnostic made(Severity severity, std::string code, std::string message) {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.code = std::move(code);
  diagnostic.message = std::move(message);
  return diagnostic;
}

// "node.port", "node.param", joint and frame: whatever there is.
std::string whereabouts(const Diagnostic& d) {
  std::string where = d.node;
  const std::string& part = d.port.empty() ? d.param : d.port;
  if (!part.empty()) where += (where.empty() ? "" : ".") + part;
  if (!d.joint.empty()) where += (where.empty() ? "joint " : ", joint ") + d.joint;
  if (d.frame) where += (where.empty() ? "frame " : ", frame ") + std::to_string(*d.frame);
  return where;
}

}  // namespace

Diagnostic error(std::string code, std::string message) {
  return made(Severity::error, std::move(code), std::move(message));
}
Diagnostic warning(std::string code, std::string message) {
  return made(Severity::warning, std::move(code), std::move(message));
}
Diagnostic info(std::string code, std::string message) {
  return made(Severity::info, std::move(code), std::move(message));
}

bool has_error(const Diagnostics& all) {
  return std::any_of(all.begin(), all.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::error; });
}

std::string to_text(const Diagnostic& d) {
  std::string text;
  if (!d.file.empty()) {
    text += d.file;
    if (d.place.line > 0) text += ":" + std::to_string(d.place.line) + ":" + std::to_string(d.place.column);
    text += ": ";
  }
  text += name_of(d.severity);
  text += ": " + d.code + ": ";
  if (const std::string where = whereabouts(d); !where.empty()) text += where + ": ";
  text += d.message;
  if (!d.hint.empty()) text += " (" + d.hint + ")";
  return text;
}

Json to_json(const Diagnostic& d) {
  Json::Object object;
  object["severity"] = name_of(d.severity);
  object["code"] = d.code;
  object["message"] = d.message;
  const auto put = [&](const char* key, const std::string& value) {
    if (!value.empty()) object[key] = value;
  };
  put("hint", d.hint);
  put("file", d.file);
  put("node", d.node);
  put("port", d.port);
  put("param", d.param);
  put("joint", d.joint);
  if (d.frame) object["frame"] = *d.frame;
  if (d.place.line > 0) {
    object["line"] = d.place.line;
    object["column"] = d.place.column;
  }
  return object;
}

Failure::Failure(Diagnostic diagnostic) : diagnostic_(std::move(diagnostic)), text_(to_text(diagnostic_)) {}

namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Edits to turn one into the other: insert, delete, replace, swap neighbours (optimal string alignment). Case
// is free.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_back(b.size() + 1), back(b.size() + 1), row(b.size() + 1);
  std::iota(back.begin(), back.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({back[j] + 1, row[j - 1] + 1, back[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], two_back[j - 2] + 1);
    }
    std::swap(two_back, back);
    std::swap(back, row);
  }
  return back[b.size()];
}

}  // namespace

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, std::min<std::size_t>(name.size() / 3 + 1, 4)) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(name.size(), candidate.size());
    const std::size_t shorter = std::min(name.size(), candidate.size());
    if (longer - shorter >= best_distance) continue;
    const std::size_t edits = distance(name, candidate);
    if (edits < best_distance && edits < longer) {
      best_distance = edits;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& all) {
  if (const std::string near = nearest(name, all); !near.empty()) return "did you mean \"" + near + "\"?";
  if (all.empty()) return "there is none";
  std::vector<std::string_view> candidates;  // each once, in the order given
  std::set<std::string_view> seen;
  for (const auto& one : all)
    if (seen.insert(one).second) candidates.push_back(one);
  constexpr std::size_t shown = 12;
  std::string text = "there is ";
  for (std::size_t i = 0; i < std::min(candidates.size(), shown); ++i)
    (text += i ? ", " : "") += candidates[i];
  if (candidates.size() > shown) text += " and " + std::to_string(candidates.size() - shown) + " more";
  return text;
}

}  // namespace kinegraph
