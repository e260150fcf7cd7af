#include "gui/components/component_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gui/components/component_edits.h"

namespace kinegraph {
namespace {

// A component stands in an edit as its number, or by the name "u3".
bool is(const Json* value, int component) {
  if (!value) return false;
  if (value->is_string()) return value->string() == fmt::format("u{}", component);
  return value->is_number() && value->number() == component;
}

// Of a list of components, or of [component, factor] pairs.
bool lists(const Json* values, int component) {
  return values && values->is_array() &&
         std::any_of(values->array().begin(), values->array().end(), [&](const Json& one) {
           return one.is_array() ? !one.array().empty() && is(&one.array().front(), component)
                                 : is(&one, component);
         });
}

}  // namespace

std::string mark_of(const Json& edits, int component) {
  std::string mark;
  const auto add = [&](const std::string& what) {
    if (mark.find(what) == std::string::npos) mark += (mark.empty() ? "" : "  ") + what;
  };
  if (const double times = amount_of(edits, "scale", component); times != 1)
    add(fmt::format("× {:.3g}", times));
  if (const double plus = amount_of(edits, "translate", component); plus != 0)
    add(fmt::format("{} {:.3g}", plus < 0 ? "−" : "+", std::abs(plus)));
  if (!edits.is_array()) return mark;
  for (const Json& entry : edits.array()) {
    const Json* op = entry.find("op");
    if (!op || !op->is_string()) continue;
    if (op->string() == "merge" && lists(entry.find("terms"), component)) {
      const Json* name = entry.find("name");
      add("→ " + (name && name->is_string() ? name->string() : std::string("group")));
    }
    if (op->string() == "substitute" && is(entry.find("component"), component)) add("replaced");
    const Json *from = entry.find("from"), *to = entry.find("to");
    if (op->string() == "transfer" && lists(entry.find("components"), component) && from && to &&
        from->is_number() && to->is_number())
      add(fmt::format("{:g} → {:g}", from->number(), to->number()));
  }
  return mark;
}

}  // namespace kinegraph
