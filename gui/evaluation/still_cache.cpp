#include "gui/evaluation/still_cache.h"

#include "graph/nested.h"

namespace kinegraph {

namespace {
constexpr int figures = 5;
}

std::shared_ptr<const Still> StillCache::of(const Document& document, const Evaluator::Known& known,
                                            const std::string& node) {
  const auto found = document.nodes.find(node);
  const NodeType* type = found == document.nodes.end() ? nullptr : known_type(registry_, found->second);
  if (!type || type->role == Role::pass) return nullptr;
  for (const OutputPort& port : type->outputs) {
    if (!port.type.empty() && port.type != "Motion") continue;
    const auto motion = std::dynamic_pointer_cast<const Motion>(known.value(node, port.name));
    if (!motion) continue;
    auto& made = made_[motion.get()];
    if (made.first.expired()) made = {motion, std::make_shared<Still>(make_still(*motion, figures))};
    return made.second;
  }
  return nullptr;
}

void StillCache::forget_what_is_gone() {
  std::erase_if(made_, [](const auto& made) { return made.second.first.expired(); });
}

}  // namespace kinegraph
