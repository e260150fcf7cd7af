// Runs one node as the evaluator would, with checked and completed parameters and values in memory.
#pragma once
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "graph/compute.h"
#include "graph/diagnostic.h"
#include "graph/node_type.h"

namespace kinegraph {

class NodeInMemory : public Compute {
 public:
  explicit NodeInMemory(NodeType type) : type_(std::move(type)) {}

  NodeInMemory& set(const std::string& param, Json value) {
    given_[param] = std::move(value);
    return *this;
  }
  template <class T>
  NodeInMemory& link(const std::string& port, T value) {
    inputs_[port].push_back(std::make_shared<const T>(std::move(value)));
    return *this;
  }
  NodeInMemory& link(const std::string& port, ValuePtr value) {
    inputs_[port].push_back(std::move(value));
    return *this;
  }
  // Throws Failure as the node does; a parameter that its description refuses throws too.
  NodeInMemory& run() {
    Json::Object all;
    for (const Param& param : type_.params) {
      auto given = given_.find(param.name);
      if (given != given_.end()) {
        auto problems = check(param, given->second, param.name);
        if (!problems.empty()) throw Failure(problems.front());
        all[param.name] = completed(param, given->second);
      } else if (param.fallback) {
        all[param.name] = completed(param, *param.fallback);
      }
    }
    for (const auto& [name, value] : given_)
      if (!type_.find_param(name)) throw std::logic_error("no parameter " + name);
    for (const auto& [port, values] : inputs_)
      if (!type_.find_input(port)) throw std::logic_error("no port " + port);
    params_ = Params(std::move(all));
    type_.compute(*this);
    for (const auto& [port, value] : outputs_) {
      EXPECT_TRUE(type_.find_output(port)) << port;
      EXPECT_FALSE(value->non_finite()) << port;
    }
    return *this;
  }
  Diagnostic refusal() {
    try {
      run();
    } catch (const Failure& failure) {
      return failure.diagnostic();
    }
    ADD_FAILURE() << type_.name << " did not fail";
    return {};
  }
  template <class T>
  const T& out(const std::string& port) {
    return dynamic_cast<const T&>(*outputs_.at(port));
  }
  const Diagnostics& reported() const { return alone_.reported; }

  const Params& params() const override { return params_; }
  Work& work() override { return alone_; }
  FileAccess& files() override { throw std::logic_error("no files here"); }
  std::span<const ValuePtr> values(std::string_view port) const override {
    auto found = inputs_.find(port);
    return found == inputs_.end() ? std::span<const ValuePtr>() : found->second;
  }
  bool wanted(std::string_view) const override { return true; }
  void set_output(std::string_view port, ValuePtr value) override {
    outputs_[std::string(port)] = std::move(value);
  }
  void write_file(std::string_view, std::string_view, std::string_view) override {
    throw std::logic_error("no files here");
  }
  void rule(std::string_view, double, double, bool) override {}

 private:
  NodeType type_;
  std::map<std::string, Json> given_;
  std::map<std::string, std::vector<ValuePtr>, std::less<>> inputs_;
  std::map<std::string, ValuePtr> outputs_;
  Params params_;
  Alone alone_;
};

}  // namespace kinegraph
