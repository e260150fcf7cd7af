#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/cartoon/pin.h"

namespace kinegraph {
namespace {

PinParams settings_of(const Params& params, const Motion& motion) {
  PinParams settings;
  settings.fade = params.number("fade");
  for (const Json& entry : params.json("pins").array()) {
    PinnedJoint pinned;
    pinned.joint = entry.find("joint")->string();
    const auto& range = entry.find("range")->array();
    const auto frame = [](const Json& number) {
      const double value = number.number();
      return value > 0 ? static_cast<std::size_t>(value) : 0;
    };
    pinned.start = frame(range[0]);
    pinned.end = range[1].is_null() ? motion.frames() : frame(range[1]);
    const auto& p = entry.find("position")->array();
    pinned.position = {p[0].number(), p[1].number(), p[2].number()};
    settings.pins.push_back(std::move(pinned));
  }
  return settings;
}

}  // namespace

NodeType pin_node() {
  NodeType type;
  type.name = "Pin";
  type.code_version = 6;
  type.category = "cartoon";
  type.help =
      "Makes hands, feet or other ends of chains pass exactly through given points, by bending the chain.";
  type.source = "Kwon & Lee, §6, Fig. 10; Nealen et al., FiberMesh, 2007";
  type.keywords = {"pin", "constraint", "target", "reach", "hit", "plant", "Kwon"};
  type.input("motion", {"Motion"}, "the motion to bend");
  type.optional_input("contacts", {"Contacts"},
                      "planted points, which stay on the ground where they are planted; open: pins only");
  type.output("motion", "Motion", "the motion through the pins", "motion");
  const auto metres = [] { return number(0).between(-1e6, 1e6).in("m"); };
  type.param(
      "pins",
      list(object({
          required(text("")).as("joint", "the joint that is pinned"),
          range().as("range", "the frames in which it is").optional(Json(Json::Array{Json(0), Json()})),
          required(tuple({metres(), metres(), metres()})).as("position", "where to, world metres"),
      })),
      "which joints stand where and when");
  // A third of a second: a pin 20 cm off then adds under 13 m/s², what a brisk arm swing has.
  type.param("fade", number(0.3).between(0, 1000).in("s").slider(0, 1),
             "how long before a pin the chain starts towards it, and after it goes back");
  type.compute = [](Compute& compute) {
    const auto motion = compute.shared_input<Motion>("motion");
    const Contacts* contacts = compute.optional_input<Contacts>("contacts");
    compute.output("motion", pin(*motion, settings_of(compute.params(), *motion), contacts, compute.work()));
  };
  return type;
}

}  // namespace kinegraph
