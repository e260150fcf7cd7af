#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/time/motion_warp.h"

namespace kinegraph {
namespace {

std::vector<WarpKey> keys_of(const Json& list) {
  std::vector<WarpKey> keys;
  for (const Json& entry : list.array()) {
    WarpKey key;
    key.frame = static_cast<std::int64_t>(entry.find("frame")->number());
    key.joint = entry.find("joint")->string();
    if (const Json* q = entry.find("rotation"); q && !q->is_null()) {
      const auto& n = q->array();
      key.rotation = Quat{n[0].number(), n[1].number(), n[2].number(), n[3].number()};
    }
    if (const Json* p = entry.find("position"); p && !p->is_null()) {
      const auto& n = p->array();
      key.position = Vec3{n[0].number(), n[1].number(), n[2].number()};
    }
    keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace

NodeType motion_warp_node() {
  NodeType type;
  type.name = "MotionWarp";
  type.category = "time";
  type.help =
      "Changes a few poses and carries the change smoothly through the frames between, so that the motion's "
      "detail stays.";
  type.source = "Witkin & Popović, Motion Warping, 1995";
  type.keywords = {"keyframe", "edit", "ik", "pose", "displacement"};
  type.input("motion", {"Motion"}, "The motion to change.");
  type.output("motion", "Motion", "The motion through the keys.", "motion");
  const auto component = [] { return number(0).between(-1e6, 1e6); };
  type.param("keys",
             list(object({
                 required(integer(0).between(0, 1e9)).as("frame", "Where the key stands."),
                 required(text("")).as("joint", "The joint's name."),
                 tuple({component(), component(), component(), component()})
                     .as("rotation", "Wanted local rotation, x y z w.")
                     .optional(),
                 tuple({component(), component(), component()})
                     .as("position", "Wanted world position, metres; reached by the limb's two main joints.")
                     .optional(),
             })),
             "Wanted poses. A key without rotation and position is an anchor: there the joint stays as it "
             "is, and so it does from one anchor to the next. The first and last frame are anchors.");
  type.code_version = 2;
  type.compute = [](Compute& node) {
    const auto& motion = node.input<Motion>("motion");
    node.output("motion", motion_warp(motion, keys_of(node.params().json("keys")), node.work()));
  };
  return type;
}

}  // namespace kinegraph
