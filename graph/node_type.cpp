#include "graph/node_type.h"

#include <algorithm>

namespace kinegraph {

NodeType& NodeType::input(std::string port, std::vector<std::string> types, std::string port_help) {
  inputs.push_back({std::move(port), std::move(types), std::move(port_help), false, false});
  return *this;
}
NodeType& NodeType::optional_input(std::string port, std::vector<std::string> types, std::string port_help) {
  inputs.push_back({std::move(port), std::move(types), std::move(port_help), true, false});
  return *this;
}
NodeType& NodeType::list_input(std::string port, std::vector<std::string> types, std::string port_help) {
  inputs.push_back({std::move(port), std::move(types), std::move(port_help), false, true});
  return *this;
}
NodeType& NodeType::output(std::string port, std::string type, std::string port_help, std::string passes) {
  outputs.push_back({std::move(port), std::move(type), std::move(port_help), std::move(passes), nullptr});
  return *this;
}
NodeType& NodeType::param(std::string param_name, ParamType type, std::string param_help) {
  type.name = std::move(param_name);
  type.help = std::move(param_help);
  params.push_back(std::move(type));
  return *this;
}

namespace {
template <class Named>
const Named* find_in(const std::vector<Named>& all, std::string_view name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}
template <class Named>
std::vector<std::string> names_in(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}
}  // namespace

const InputPort* NodeType::find_input(std::string_view port) const {
  return find_in(inputs, port);
}
const OutputPort* NodeType::find_output(std::string_view port) const {
  return find_in(outputs, port);
}
const Param* NodeType::find_param(std::string_view param_name) const {
  return find_in(params, param_name);
}
std::vector<std::string> NodeType::input_names() const {
  return names_in(inputs);
}
std::vector<std::string> NodeType::output_names() const {
  return names_in(outputs);
}
std::vector<std::string> NodeType::param_names() const {
  return names_in(params);
}

}  // namespace kinegraph
