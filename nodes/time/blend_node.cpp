#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/motion/moving_root.h"
#include "nodes/node_params.h"
#include "nodes/time/blend.h"

namespace kinegraph {

NodeType blend_node() {
  NodeType type;
  type.name = "Blend";
  type.category = "time";
  type.help =
      "Mixes two motions frame by frame. Below 0 and above 1 it goes beyond them: away from the other, or "
      "past it. Warp "
      "them in time first, so that their steps fall together.";
  type.source = "[Shapiro] §5.4";
  type.keywords = {"mix", "interpolate", "extrapolate", "cross-fade", "layer"};
  type.input("motion", {"Motion"}, "The motion that is changed; skeleton and root facts are its own.");
  type.input("other", {"Motion"}, "The motion that is mixed in.");
  type.output("motion", "Motion", "The mixture.", "motion");
  type.param("weight", number(0.5).between(-10, 10).slider(0, 1),
             "0 = motion, 1 = other; may go below 0 and above 1.");
  add_joints_param(type);
  add_range_param(type);
  add_fade_param(type);
  add_map_param(type);
  type.code_version = 2;
  type.compute = [](Compute& compute) {
    auto motion_of = compute.shared_input<Motion>("motion"), other_of = compute.shared_input<Motion>("other");
    const Params& params = compute.params();
    Work& work = compute.work();
    check_same_rate(motion_of->fps(), other_of->fps(), "motion", "other");
    auto joints = chosen_joints(params.text("joints"), motion_of->skeleton(), "joints", work);
    if (joints[0]) {
      const auto both = with_moving_roots({motion_of, other_of}, work);
      motion_of = both[0];
      other_of = both[1];
    }
    const Motion &motion = *motion_of, &other = *other_of;
    auto weights = change_weights(params, motion.frames(), motion.fps());
    for (double& w : weights) w *= params.number("weight");
    auto partner = partners(other.skeleton(), motion.skeleton(), params.texts("map"));
    warn_about_partners(other.skeleton(), motion.skeleton(), partner, work, &joints);
    compute.output("motion", blended(motion, other, partner, joints, weights));
  };
  return type;
}

}  // namespace kinegraph
