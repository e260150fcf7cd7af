#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/feet/detect_contacts.h"

namespace kinegraph {
namespace {

DetectContactsParams detect_contacts_params(const Params& params) {
  DetectContactsParams result;
  result.heels = params.text("heels");
  result.balls = params.text("balls");
  result.height = params.number("height");
  result.speed = params.number("speed");
  result.min_time = params.number("min_time");
  for (const Json& entry : params.json("edits").array()) {
    const Params edit(entry.object());
    result.edits.push_back(
        {edit.text("foot"), edit.text("part"), edit.range("range"), edit.boolean("planted")});
  }
  return result;
}

}  // namespace

NodeType detect_contacts_node() {
  const DetectContactsParams defaults;
  NodeType type;
  type.name = "DetectContacts";
  type.category = "feet";
  type.help = "Finds when heels and balls of the feet are planted, also where they slide a little.";
  type.source = "Kovar, Schreiner, Gleicher 2002, section 3";
  type.keywords = {"feet", "plant", "foot", "constraint"};
  type.input("motion", {"Motion"}, "The motion to look at.");
  type.output("contacts", "Contacts", "One flag a frame for the heel and the ball of each foot.");
  type.param("heels", pattern(""), "Joints that are heels; empty = found: the ankles.");
  type.param("balls", pattern(""), "Joints that are balls of feet; empty = found: the toe joints.");
  type.param("height", number(defaults.height).between(0, 10).in("m").slider(0, 0.15),
             "A plant is at most this far above the point's usual low.");
  type.param("speed", number(defaults.speed).between(0.001, 100).in("m/s").slider(0.05, 0.6),
             "A plant moves by less than this against its own even slide.");
  type.param("min_time", number(defaults.min_time).between(0, 10).in("s").slider(0, 0.4),
             "Shorter plants are dropped; a runner's can be as short as 0.04.");
  type.param("edits",
             list(object({required(text("left")).as("foot", "left, right, or the ankle joint's name"),
                          choice({{"both", "heel and ball"}, {"heel", "the heel"}, {"ball", "the ball"}})
                              .as("part", "which part of the foot")
                              .optional(Json("both")),
                          range().as("range", "frames"),
                          boolean(true).as("planted", "planted there or not").optional(Json(true))})),
             "Corrections by hand, applied in order over what was found.");
  type.code_version = 4;
  type.compute = [](Compute& node) {
    const auto& motion = node.input<Motion>("motion");
    node.output("contacts", detect_contacts(motion, detect_contacts_params(node.params()), node.work()));
  };
  return type;
}

}  // namespace kinegraph
