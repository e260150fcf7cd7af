#include "gui/components/component_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace kinegraph {
namespace {

Json::Array entries_of(const Json& edits) {
  return edits.is_array() ? edits.array() : Json::Array{};
}

std::string text_of(const Json* value) {
  if (!value) return {};
  if (value->is_string()) return value->string();
  return value->is_number() ? fmt::format("u{:g}", value->number()) : std::string();
}

bool is_of(const Json& entry, const std::string& op, int component) {
  const Json* its = entry.find("op");
  if (!its || !its->is_string() || its->string() != op) return false;
  const std::string name = text_of(entry.find("component"));
  return name == fmt::format("u{}", component) || name == fmt::format("{}", component);
}

const char* field_of(const std::string& op) {
  return op == "scale" ? "factor" : "value";
}

}  // namespace

Json with_amount(const Json& edits, const std::string& op, int component, double amount) {
  Json::Array all = entries_of(edits);
  for (auto entry = all.rbegin(); entry != all.rend(); ++entry)
    if (is_of(*entry, op, component)) {
      entry->object()[field_of(op)] = Json(amount);
      return Json(std::move(all));
    }
  all.push_back(
      Json(Json::Object{{"op", Json(op)}, {"component", Json(component)}, {field_of(op), Json(amount)}}));
  return Json(std::move(all));
}

double amount_of(const Json& edits, const std::string& op, int component) {
  double amount = op == "scale" ? 1 : 0;
  for (const Json& entry : entries_of(edits))
    if (is_of(entry, op, component))
      if (const Json* value = entry.find(field_of(op)); value && value->is_number())
        amount = op == "scale" ? amount * value->number() : amount + value->number();
  return amount;
}

Json with_merge(const Json& edits, const std::vector<int>& components) {
  Json::Array all = entries_of(edits);
  std::set<std::string> taken;
  for (const Json& entry : all)
    if (const Json* name = entry.find("name"); name && name->is_string()) taken.insert(name->string());
  std::string name;
  for (int number = 1; name.empty() || taken.count(name); ++number) name = fmt::format("group{}", number);
  Json::Array terms;
  for (int component : components) terms.push_back(Json(Json::Array{Json(component), Json(1)}));
  all.push_back(
      Json(Json::Object{{"op", Json("merge")}, {"name", Json(name)}, {"terms", Json(std::move(terms))}}));
  return Json(std::move(all));
}

Json with_transfer(const Json& edits, const std::vector<int>& components, int from, int to) {
  Json::Array all = entries_of(edits);
  Json::Array which;
  for (int component : components) which.push_back(Json(component));
  all.push_back(Json(Json::Object{{"op", Json("transfer")},
                                  {"components", Json(std::move(which))},
                                  {"from", Json(from)},
                                  {"to", Json(to)}}));
  return Json(std::move(all));
}

std::vector<std::string> told(const Json& edits) {
  std::vector<std::string> words;
  for (const Json& entry : entries_of(edits)) {
    const Json* op = entry.find("op");
    if (!op || !op->is_string()) continue;
    const auto number = [&](const char* key) {
      const Json* value = entry.find(key);
      return value && value->is_number() ? value->number() : 0;
    };
    const std::string component = text_of(entry.find("component"));
    std::string one = component.empty() ? op->string() : op->string() + " " + component;
    if (op->string() == "scale") one = fmt::format("{} × {:.3g}", component, number("factor"));
    if (op->string() == "translate")
      one =
          fmt::format("{} {} {:.3g}", component, number("value") < 0 ? "−" : "+", std::abs(number("value")));
    if (op->string() == "merge") one = "merge into " + text_of(entry.find("name"));
    if (op->string() == "transfer") one = fmt::format("transfer {:g} → {:g}", number("from"), number("to"));
    words.push_back(one);
  }
  return words;
}

}  // namespace kinegraph
