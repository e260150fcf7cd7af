#include "graph/variables.h"

#include <fmt/format.h>

#include <algorithm>

#include "graph/document.h"

namespace kinegraph {

namespace {

using Kind = ParamType::Kind;

bool is_path(const ParamType& type) {
  return type.kind == Kind::open_file || type.kind == Kind::save_file;
}
bool is_batch_name(std::string_view name) {
  return name == "item" || name == "index";
}

// The alternative of an `either` that a value of this JSON kind would be.
const ParamType& alternative(const ParamType& type, const Json& value) {
  for (const ParamType& part : type.parts) {
    const bool list = part.kind == Kind::list || part.kind == Kind::tuple || part.kind == Kind::range;
    const bool object = part.kind == Kind::object || part.kind == Kind::table;
    if (value.is_array() ? list : value.is_object() ? object : value.is_string() && is_path(part))
      return part;
  }
  return type.parts.front();
}

class Substitution {
 public:
  Substitution(const Variables& variables, Diagnostics& problems)
      : variables_(variables), problems_(problems) {}

  Json of(const Json& value, const ParamType& type, const std::string& where) {
    Json result = in(value, type, where);
    result.place = value.place;
    result.key_place = value.key_place;
    return result;
  }
  const std::vector<std::string>& asked_for() const { return asked_for_; }

 private:
  Json in(const Json& value, const ParamType& type, const std::string& where) {
    if (value.is_string()) return in_text(value, type, where);
    if (!value.is_array() && !value.is_object()) return value;
    if (type.kind == Kind::either) return of(value, alternative(type, value), where);
    if (value.is_array()) {
      Json result = value;
      for (std::size_t i = 0; i < value.array().size(); ++i)
        result.array()[i] = of(value.array()[i], element(type, i), fmt::format("{}[{}]", where, i));
      return result;
    }
    Json result = value;
    for (auto& [key, member] : result.object()) member = of(member, field(type, key), where + "." + key);
    return result;
  }

  const ParamType& element(const ParamType& type, std::size_t i) const {
    if (type.kind == Kind::list) return type.parts[0];
    if (type.kind == Kind::tuple && i < type.parts.size()) return type.parts[i];
    return type.kind == Kind::range ? frame_ : any_;
  }
  const ParamType& field(const ParamType& type, const std::string& key) const {
    if (type.kind == Kind::table) return type.parts[0];
    if (type.kind == Kind::object)
      for (const ParamType& part : type.parts)
        if (part.name == key) return part;
    return any_;
  }

  Json in_text(const Json& value, const ParamType& type, const std::string& where) {
    const std::string& text = value.string();
    if (text.find("${") == std::string::npos) return value;
    const bool written = type.kind == Kind::save_file;
    if (const std::string_view name = whole_variable(text); !name.empty()) {
      const Json* found = find(name, value, where, written);
      return found ? typed(*found, name, type, value, where) : value;
    }
    const ParamType& meant = type.kind == Kind::either ? alternative(type, value) : type;
    return is_path(meant) ? in_path(value, meant.kind == Kind::save_file, where)
                          : in_plain_text(value, where);
  }

  // A value given on the command line is text until the parameter says what it is.
  Json typed(const Json& found, std::string_view name, const ParamType& type, const Json& value,
             const std::string& where) {
    const auto given = variables_.given.find(std::string(name));
    if (given == variables_.given.end() || !found.is_string()) return found;
    try {
      return parse_value(type, found.string());
    } catch (const Failure& failure) {
      Diagnostic diagnostic = failure.diagnostic();
      diagnostic.message = fmt::format("variable {}: {}", name, diagnostic.message);
      add(std::move(diagnostic), value, where);
      return value;
    }
  }

  Json in_path(const Json& value, bool written, const std::string& where) {
    const std::string& text = value.string();
    std::string path;
    for (std::size_t i = 0; i < text.size();) {
      if (text.compare(i, 3, "$${") == 0) {
        path += "${";
        i += 3;
        continue;
      }
      if (text.compare(i, 2, "${") != 0) {
        path += text[i++];
        continue;
      }
      const std::size_t end = text.find('}', i);
      const std::string name = text.substr(i + 2, end == std::string::npos ? end : end - i - 2);
      if (end == std::string::npos || !is_node_name(name)) {
        add(error("bad-variable", fmt::format("{} is no variable", in_quotes(text.substr(i))))
                .hinting("a variable is ${name}; $${ writes a plain ${"),
            value, where);
        return value;
      }
      const Json* found = find(name, value, where, written);
      if (found && found->is_string()) {
        path += found->string();
      } else if (found && found->is_number()) {
        path += shortest_number(found->number());
      } else if (found) {
        add(error("bad-variable",
                  fmt::format("variable {} is {} and can't stand in a path", name, name_of(found->kind())))
                .hinting("a string or a number can"),
            value, where);
      } else {
        path += text.substr(i, end + 1 - i);
      }
      i = end + 1;
    }
    return Json(std::move(path));
  }

  Json in_plain_text(const Json& value, const std::string& where) {
    std::string text = value.string();
    bool unescaped = false;
    for (std::size_t i = text.find("${"); i != std::string::npos; i = text.find("${", i + 2)) {
      if (i > 0 && text[i - 1] == '$')
        text.erase(--i, 1);
      else
        unescaped = true;
    }
    if (unescaped)
      add(warning("variable-not-replaced",
                  fmt::format("a variable inside {} is left as it stands", in_quotes(value.string())))
              .hinting("use it as the whole value or in a path; $${ writes a plain ${"),
          value, where);
    return Json(std::move(text));
  }

  const Json* find(std::string_view name, const Json& value, const std::string& where, bool written) {
    asked_for_.emplace_back(name);
    if (const Json* found = variables_.find(name)) return found;
    if (written && variables_.batch_fills_in && is_batch_name(name)) return nullptr;
    add(error("undefined-variable", fmt::format("variable \"{}\" is not defined", name))
            .hinting(written && is_batch_name(name) ? "only `kinegraph batch` sets it" : how_to_define(name)),
        value, where);
    return nullptr;
  }

  std::string how_to_define(std::string_view name) const {
    const auto names = variables_.names();
    return fmt::format("{}--var {}=VALUE or an entry of \"variables\" defines it",
                       names.empty() ? "" : suggestion(std::string(name), names) + "; ", name);
  }

  void add(Diagnostic diagnostic, const Json& value, const std::string& where) {
    diagnostic.place = value.place;
    diagnostic.param = where;
    problems_.push_back(std::move(diagnostic));
  }

  const Variables& variables_;
  Diagnostics& problems_;
  std::vector<std::string> asked_for_;
  ParamType frame_ = integer(0);
  ParamType any_ = text("");
};

}  // namespace

const Json* Variables::find(std::string_view name) const {
  if (const auto found = given.find(std::string(name)); found != given.end()) return &found->second;
  for (const auto* file : files)
    if (const auto found = file->find(name); found != file->end()) return &found->second;
  return nullptr;
}

std::vector<std::string> Variables::names() const {
  std::vector<std::string> all;
  for (const auto& [name, value] : given) all.push_back(name);
  for (const auto* file : files)
    for (const auto& [name, value] : *file) all.push_back(name);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::string_view whole_variable(std::string_view text) {
  if (!text.starts_with("${") || !text.ends_with("}")) return {};
  const std::string_view name = text.substr(2, text.size() - 3);
  return is_node_name(name) ? name : std::string_view();
}

std::vector<std::string> variables_in(const Json& value, const ParamType& type) {
  const Variables none;
  Diagnostics problems;
  Substitution substitution(none, problems);
  substitution.of(value, type, "");
  return substitution.asked_for();
}

namespace {
bool mentions_a_variable(const Json& value) {
  if (value.is_string()) return value.string().find("${") != std::string::npos;
  if (value.is_array()) return std::any_of(value.array().begin(), value.array().end(), mentions_a_variable);
  return value.is_object() &&
         std::any_of(value.object().begin(), value.object().end(),
                     [](const auto& member) { return mentions_a_variable(member.second); });
}
}  // namespace

Json substituted(const Json& value, const ParamType& type, const Variables& variables,
                 const std::string& where, Diagnostics& problems) {
  if (!mentions_a_variable(value)) return value;
  return Substitution(variables, problems).of(value, type, where);
}

}  // namespace kinegraph
