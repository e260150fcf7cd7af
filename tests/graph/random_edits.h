// Edits at random, of every kind that people make.
#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "graph/collapse.h"
#include "graph/diagnostic.h"
#include "graph/edit.h"
#include "graph/file/diff.h"
#include "graph/nested.h"

namespace kinegraph {

// Any edit at random that the document allows.
class RandomEdits {
 public:
  static constexpr int kinds = 28;
  // `draw`: values for parameters, of which most should fit; without it a few that fit those of the toys.
  RandomEdits(unsigned seed, const Registry& registry, std::function<Json(const Param&)> draw = {})
      : random_(seed), registry_(registry), draw_(std::move(draw)) {}
  int made(int kind) const { return made_[kind]; }  // how many of a kind
  int fewest() const { return *std::min_element(made_.begin(), made_.end()); }

  Edit next(const Document& document) {
    for (;;) {
      const int kind = static_cast<int>(below(kinds));
      for (int tries = 0; tries < 100; ++tries) {
        try {
          Edit edit = attempt(document, kind);
          if (edit.empty()) continue;
          ++made_[kind];
          return edit;
        } catch (const Failure&) {
        }
      }
    }
  }

 private:
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  template <class Map>
  std::string key_of(const Map& map) {
    if (map.empty()) return "none";
    auto one = map.begin();
    std::advance(one, static_cast<long>(below(map.size())));
    return one->first;
  }
  std::string one_of(const std::vector<std::string>& all) {
    return all.empty() ? "none" : all[below(all.size())];
  }

  Edit attempt(const Document& document, int kind) {
    if (document.nodes.empty()) return add_node(document, registry_, "first", "Load");
    const std::string node = key_of(document.nodes), other = key_of(document.nodes);
    const Node& found = document.nodes.at(node);
    const NodeType* type = known_type(registry_, found);
    const std::string port = key_of(found.inputs), new_name = "n" + std::to_string(below(40));
    const auto unit = [&](Unit::Kind of, const std::string& name, std::optional<Json> value,
                          const std::string& key = {}) {
      return set_unit(document, {of, name, key}, below(3) == 0 ? std::nullopt : std::move(value), "Unit");
    };
    // A graph that stays large enough for links to be cut and nodes to be put on them.
    if ((kind == 1 || kind == 2) && document.nodes.size() < 12 && below(4)) return {};
    const std::string short_name = "v" + std::to_string(below(3));
    const Json spot = Json::Object{{"pos", Json::Array{below(500), below(500)}}};
    switch (kind) {
      case 0:
        return add_node(document, registry_, new_name, one_of(registry_.names()));
      case 1:
        return remove_nodes(document, registry_, {node}, false);
      case 2:
        return remove_nodes(document, registry_, {node, other}, true);
      case 3:
        return rename_node(document, node, new_name);
      case 4:
      case 5:
        return set_some_param(document, node, type);
      case 6:
        return reset_param(document, node, key_of(found.params));
      case 7:
      case 8:
      case 9: {
        const NodeType* giver = known_type(registry_, document.nodes.at(other));
        return connect(document, registry_, {other, giver ? one_of(giver->output_names()) : "none", {}}, node,
                       type ? one_of(type->input_names()) : "none");
      }
      case 10:
        return disconnect(document, registry_, node, port, below(3));
      case 11:
        return set_enabled(document, node, below(2) == 0);
      case 12:
        return set_note(document, node, below(2) ? "a note" : "");
      case 13:
        return take_out(document, registry_, node);
      case 14:
        return insert_on_link(document, registry_, other, node, port, below(2));
      case 15:
        return paste(document, registry_, copied(document, registry_, {node, other}), 3, 4);
      case 16:
        return unit(Unit::Kind::variable, short_name, Json(below(9)));
      case 17:
        return unit(Unit::Kind::publish_param, short_name, Json::Array{node + ".a", node + ".b"});
      case 18:
        return unit(Unit::Kind::publish_input, short_name, Json(node + ".motion"));
      case 19:
        return unit(Unit::Kind::publish_output, short_name, Json(node + ".motion"));
      case 20:
        return unit(Unit::Kind::node_extra, node, Json(below(4)), "x-k");
      case 21:
        return unit(below(2) ? Unit::Kind::publish_extra : Unit::Kind::extra, "x-" + short_name,
                    Json(below(4)));
      case 22:
        return unit(Unit::Kind::ui_node, node, spot);
      case 23:
        return unit(Unit::Kind::ui_frame, short_name,
                    Json::Object{{"title", short_name}, {"nodes", Json::Array{node, other}}});
      case 24:
        return unit(Unit::Kind::ui_note, short_name,
                    Json::Object{{"text", short_name}, {"pos", Json::Array{1, 2}}});
      case 25:
        return unit(Unit::Kind::ui_extra, "x-" + short_name, Json(below(4)));
      case 26:
        return collapse(document, registry_, {node, other}, {"part.kg.json", "/g", "/g"}).edit;
      default: {  // what another program made of the file, as one step
        Document changed = document;
        for (int i = 0; i < 3; ++i) apply(changed, attempt(changed, static_cast<int>(below(26))));
        return edit_between(document, changed, "Read again");
      }
    }
  }
  Edit set_some_param(const Document& document, const std::string& node, const NodeType* type) {
    const std::string name = type ? one_of(type->param_names()) : "none";
    const Param* param = type ? type->find_param(name) : nullptr;
    return set_param(document, registry_, node, name, draw_ && param ? draw_(*param) : some_value());
  }
  Json some_value() {
    switch (below(6)) {
      case 0:
        return static_cast<double>(below(3)) / 2;
      case 1:
        return "travel";
      case 2:
        return Json::Array{0, 20};
      case 3:
        return Json::Object{{"*Leg*", 2}};
      case 4:
        return "${clip}";
      default:
        return below(2) == 0;
    }
  }
  std::mt19937 random_;
  const Registry& registry_;
  std::function<Json(const Param&)> draw_;
  std::array<int, kinds> made_{};
};

}  // namespace kinegraph
