// What Kinegraph says to a person or a CI log: one struct for every error, warning and info, and the one exception
// that carries an error out of an algorithm.
#pragma once
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "graph/json.h"

namespace kinegraph {

enum class Severity { info, warning, error };
const char* name_of(Severity severity);

// Everything is optional but severity, code and message. `message` says what was found, `hint` what to do.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;  // kebab-case, stable: scripts match on it ("unknown-port")
  std::string message;
  std::string hint;
  std::string file;  // as the user named it
  Place place;       // in that file
  std::string node;
  std::string port;
  std::string param;  // "edits[2].factor" inside a structured parameter
  std::string joint;
  std::optional<std::int64_t> frame;

  // Fluent, so that a call site reads as a sentence: error("x", "…").at_joint("Hips").at_frame(3).hinting("…")
  Diagnostic& hinting(std::string text) & { hint = std::move(text); return *this; }
  Diagnostic&& hinting(std::string text) && { hint = std::move(text); return std::move(*this); }
  Diagnostic&& in_file(std::string name, Place where = {}) && { file = std::move(name); place = where; return std::move(*this); }
  Diagnostic&& at_node(std::string name) && { node = std::move(name); return std::move(*this); }
  Diagnostic&& at_port(std::string name) && { port = std::move(name); return std::move(*this); }
  Diagnostic&& at_param(std::string name) && { param = std::move(name); return std::move(*this); }
  Diagnostic&& at_joint(std::string name) && { joint = std::move(name); return std::move(*this); }
  Diagnostic&& at_frame(std::int64_t number) && { frame = number; return std::move(*this); }
};
using Diagnostics = std::vector<Diagnostic>;

Diagnostic error(std::string code, std::string message);
Diagnostic warning(std::string code, std::string message);
Diagnostic info(std::string code, std::string message);

bool has_error(const Diagnostics& all);
// `FILE:LINE:COL: severity: code: node.port, joint J, frame F: message (hint)`, leaving out what is empty.
std::string to_text(const Diagnostic& diagnostic);
// The report's form: {"severity","code","param","port","frame","joint","message","hint"} and, where they are known,
// "file", "line", "column" and "node"; what is empty is left out.
Json to_json(const Diagnostic& diagnostic);

// Thrown where work can't go on. Readers of graph files collect Diagnostics instead and report them all.
class Failure : public std::exception {
 public:
  explicit Failure(Diagnostic diagnostic);
  const char* what() const noexcept override { return text_.c_str(); }
  const Diagnostic& diagnostic() const { return diagnostic_; }

 private:
  Diagnostic diagnostic_;
  std::string text_;
};
// Thrown by Work when it was asked to stop. Not an error of the work.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

// The candidate nearest to `name` by edit distance, or "" when none is near enough to be a slip of the hand.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);
// A hint for an unknown name: `did you mean "fps"?`, or the names there are when none is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace kinegraph
