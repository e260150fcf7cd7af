#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/character.h"
#include "nodes/time/retarget.h"

namespace kinegraph {
namespace {

// The lowest vertex of a mesh, which is its sole as it stands.
std::optional<double> sole_of(const Character& character) {
  const Pose rest = rest_pose_of(*character.skeleton);
  std::optional<double> low;
  for (const MeshPart& part : character.parts) {
    if (part.skin < 0) continue;
    for (Vec3 vertex : posed_vertices(character, part, rest))
      low = std::min(low.value_or(vertex.y), vertex.y);
  }
  return low;
}

// A character without a motion, as a target.
Motion standing(const Character& character) {
  auto facts = std::make_shared<SourceFacts>();
  facts->format = "gltf";
  facts->unit = character.unit;
  facts->unit_name = character.unit == 1 ? "m" : "";
  return Motion(character.skeleton, facts, 1, 0, {});
}

}  // namespace

NodeType retarget_node() {
  NodeType type;
  type.name = "Retarget";
  type.version = 2;
  type.migrations = {{1, [](Json::Object&, Json::Object&) {}}};  // feet is new; its default is what was done
  type.code_version = 4;
  type.category = "time";
  type.help =
      "Puts a motion on another skeleton: other names, other proportions, another rest pose. Links point "
      "where "
      "the motion's do, and the path is scaled by the legs.";
  type.source = "Wu, On-line Motion Style Transfer, §8; Cao, Motion Editing With ICA, §5.2";
  type.keywords = {"retarget", "skeleton", "character", "transfer", "Mixamo", "rig", "map"};
  type.input("motion", {"Motion"}, "The motion.");
  type.input(
      "target", {"Motion", "Character"},
      "Whose skeleton: a motion of which only the skeleton counts, or a skinned character, which can be "
      "exported with the result.");
  type.output("motion", "Motion", "The motion on the target's skeleton.", "motion");
  type.param("map", list(text("")),
             "Joints that belong together, each as FROM=TO: a joint of the motion and one of the target. The "
             "others are found by names and shape. =TO and FROM= take a joint out.");
  type.param("scale", number(0).between(0, 1e6).slider(0, 3),
             "How many times as far and high the target goes; 0 = by the length of the legs.");
  type.param("feet",
             choice({{"soles",
                      "Soles are flat where the motion's are; where a mesh would go below the ground, toes "
                      "and feet bend."},
                     {"direction",
                      "From ankle to toes they point where the motion's do, so that soles tilt where "
                      "one body has its ankles higher."}}),
             "What feet have in common with the motion's.");
  type.compute = [](Compute& compute) {
    const auto& motion = compute.input<Motion>("motion");
    Work& work = compute.work();
    RetargetParams params;
    params.map = compute.params().texts("map");
    params.scale = compute.params().number("scale");
    params.feet_by = compute.params().text("feet") == "soles" ? FeetBy::sole : FeetBy::direction;
    RetargetTarget target{compute.optional_input<Motion>("target"), {}, {}};
    Motion made;
    if (const auto* character = compute.optional_input<Character>("target")) {
      made = standing(*character);
      target = {&made, sole_of(*character), sole_points(*character)};
    }
    RetargetResult result = retarget(motion, target, params, work);
    const auto paired = std::count_if(result.pairs.source_of.begin(), result.pairs.source_of.end(),
                                      [](int i) { return i >= 0; });
    work.report(
        info("retargeted", fmt::format("{} of the target's {} joints follow one of the motion's {}; "
                                       "the path is scaled by {:.4f}",
                                       paired, result.motion.joints(), motion.joints(), result.scale)));
    compute.output("motion", std::move(result.motion));
  };
  return type;
}

}  // namespace kinegraph
