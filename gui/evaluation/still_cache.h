// The stills of the motions that an evaluator still has, each made once.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "graph/evaluate/evaluator.h"
#include "gui/evaluation/still.h"

namespace kinegraph {

class StillCache {
 public:
  explicit StillCache(const Registry& registry) : registry_(registry) {}
  // Of the first output of `node` that is a motion; null where none is known.
  std::shared_ptr<const Still> of(const Document& document, const Evaluator::Known& known,
                                  const std::string& node);
  void forget_what_is_gone();

 private:
  const Registry& registry_;
  std::map<const Value*, std::pair<std::weak_ptr<const Value>, std::shared_ptr<const Still>>> made_;
};

}  // namespace kinegraph
