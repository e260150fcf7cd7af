#include "nodes/all_nodes.h"

#include "graph/builtin_nodes.h"
#include "nodes/components/components.h"
#include "nodes/motion/character.h"
#include "nodes/motion/contacts.h"
#include "nodes/motion/metrics.h"
#include "nodes/motion/motion.h"
#include "nodes/motion/points.h"
#include "nodes/style/stats.h"
#include "nodes/time/warp.h"

namespace kinegraph {

// One line a type: the function is defined in NAME_node.cpp of its family's folder.
NodeType gait_node();
NodeType burst_node();
NodeType marker_mesh_node();
NodeType ica_node();
NodeType component_edit_node();
NodeType component_meaning_node();
NodeType component_motion_node();
NodeType component_project_node();
NodeType detect_contacts_node();
NodeType footskate_node();
NodeType quat_stats_node();
NodeType style_transfer_node();
NodeType metrics_node();
NodeType check_node();
NodeType motion_warp_node();
NodeType segment_node();
NodeType time_warp_node();
NodeType unwarp_time_node();
NodeType load_node();
NodeType export_node();
NodeType blend_node();
NodeType concatenate_node();
NodeType filter_node();
NodeType mirror_node();
NodeType resample_node();
NodeType retarget_node();
NodeType trim_node();
NodeType exaggerate_node();
NodeType rubber_joints_node();
NodeType pin_node();
NodeType cartoon_filter_node();

Registry all_nodes() {
  Registry registry;
  registry.add(ValueType{.name = "Motion", .help = "a skeleton that moves", .decode = decode_motion});
  registry.add(ValueType{.name = "Points",
                         .help = "labelled points over time",
                         .decode = decode_points,
                         .convert_from = "Motion",
                         .convert = points_of_motion});
  registry.add(
      ValueType{.name = "Character", .help = "a skinned mesh on a skeleton", .decode = decode_character});
  registry.add(ValueType{.name = "Warp", .help = "a time warp between two motions", .decode = decode_warp});
  registry.add(ValueType{
      .name = "Stats", .help = "the statistics that carry a motion's style", .decode = decode_stats});
  registry.add(ValueType{
      .name = "Contacts", .help = "when which part of a foot is planted", .decode = decode_contacts});
  registry.add(ValueType{.name = "Metrics", .help = "named numbers", .decode = decode_metrics});
  registry.add(ValueType{.name = "Components",
                         .help = "independent components of one or several clips",
                         .decode = decode_components});
  registry.add(gait_node());
  registry.add(burst_node());
  registry.add(marker_mesh_node());
  registry.add(ica_node());
  registry.add(component_edit_node());
  registry.add(component_meaning_node());
  registry.add(component_motion_node());
  registry.add(component_project_node());
  registry.add(detect_contacts_node());
  registry.add(footskate_node());
  registry.add(quat_stats_node());
  registry.add(style_transfer_node());
  registry.add(metrics_node());
  registry.add(check_node());
  registry.add(motion_warp_node());
  registry.add(segment_node());
  registry.add(time_warp_node());
  registry.add(unwarp_time_node());
  registry.add(load_node());
  registry.add(export_node());
  registry.add(exaggerate_node());
  registry.add(rubber_joints_node());
  registry.add(pin_node());
  registry.add(cartoon_filter_node());
  registry.add(switch_node());
  registry.add(dot_node());
  registry.add(graph_node());
  registry.add(blend_node());
  registry.add(concatenate_node());
  registry.add(filter_node());
  registry.add(mirror_node());
  registry.add(resample_node());
  registry.add(retarget_node());
  registry.add(trim_node());
  return registry;
}

}  // namespace kinegraph
