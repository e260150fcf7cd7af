#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/components/component_edit.h"
#include "nodes/components/component_ref.h"
#include "nodes/components/rebuild.h"

namespace kinegraph {
namespace {

FrameRange range_in(const Json& value) {
  if (value.is_null()) return {};
  FrameRange out{static_cast<std::int64_t>(value.array()[0].number()), {}};
  if (!value.array()[1].is_null()) out.end = static_cast<std::int64_t>(value.array()[1].number());
  return out;
}
std::int64_t whole(const Json& value) {
  return static_cast<std::int64_t>(value.number());
}

ComponentEditStep step_of(const Json& edit) {
  const auto at = [&](const char* field) -> const Json& { return *edit.find(field); };
  const std::string& op = at("op").string();
  if (op == "scale") return edits::Scale{component_ref(at("component")), at("factor").number()};
  if (op == "translate") return edits::Translate{component_ref(at("component")), at("value").number()};
  if (op == "substitute") return edits::Substitute{component_ref(at("component"))};
  if (op == "merge") {
    edits::Merge merge{at("name").string(), {}};
    for (const Json& term : at("terms").array())
      merge.terms.emplace_back(component_ref(term.array()[0]), term.array()[1].number());
    return merge;
  }
  if (op == "replace")
    return edits::Replace{component_ref(at("component")), range_in(at("frames")), range_in(at("by_frames")),
                          at("fade").number(), at("fit").string() == "repeat"};
  if (op == "copy_add")
    return edits::CopyAdd{component_ref(at("component")), at("factor").number(), whole(at("segment")),
                          range_in(at("frames"))};
  if (op == "warp") {
    edits::Warp warp{component_ref(at("component")), {}};
    for (const Json& key : at("keys").array())
      warp.keys.emplace_back(whole(key.array()[0]), key.array()[1].number());
    return warp;
  }
  edits::Transfer transfer{component_refs(at("components")), whole(at("from")),    whole(at("to")), {}, false,
                           range_in(at("frames")),           at("amount").number()};
  for (const Json& entry : at("align").array()) transfer.align.push_back(entry.string());
  transfer.keep_timing_of_from = at("keep_timing_of").string() == "from";
  return transfer;
}

void edit(Compute& node) {
  const Params& params = node.params();
  const auto& components = node.input<Components>("components");
  ComponentEditParams settings;
  for (const Json& one : params.json("edits").array()) settings.edits.push_back(step_of(one));
  if (const auto segment = params.integer("segment"); segment >= 0) settings.segment = segment;
  settings.lowpass = params.number("lowpass");
  settings.residual = params.boolean("residual");
  ComponentEditInputs inputs;
  inputs.other = node.optional_input<Components>("other");
  if (const auto edited = node.values("edited"); !edited.empty()) {
    inputs.edited_motion = std::dynamic_pointer_cast<const Motion>(edited.front());
    inputs.edited_points = std::dynamic_pointer_cast<const Points>(edited.front());
  }
  ComponentEditResult result = edit_components(components, settings, inputs, node.work());
  const WayBack way{params.boolean("limbs"), params.boolean("root")};
  const ComponentSegment& base = result.components.segments[result.segment];
  if (node.wanted("motion"))
    node.output("motion", motion_of(result.components, result.channels, base, way, node.work()));
  if (node.wanted("points"))
    node.output("points", points_of(result.components, result.channels, base, way, node.work()));
  if (node.wanted("components")) node.output("components", std::move(result.components));
}

ParamType op(const char* key, const char* help) {
  return required(choice({{key, help}})).as("op", "What is done.");
}
ParamType one() {
  return required(component_type()).as("component", "Its number from 1, or a group's name.");
}
ParamType some_frames(const char* help) {
  return range().as("frames", help).optional(Json::Array{0, nullptr});
}
ParamType segment_number(const char* name, const char* help) {
  return required(integer(0).between(0, 10000)).as(name, help);
}

ParamType edit_type() {
  const double far = 1e6;
  return either(
      {object({op("scale", "multiplies a component; 0 takes it away"), one(),
               required(number(1).between(-far, far).slider(-1, 3)).as("factor", "1 = unchanged.")}),
       object(
           {op("merge", "makes several components one, to be edited together"),
            required(text("")).as("name", "The group's name."),
            required(list(tuple({component_type(), number(1).between(-far, far)})))
                .as("terms", "Each a component and its factor; with factors 1 the motion doesn't change.")}),
       object({op("translate", "adds a number to a component"), one(),
               required(number(0).between(-far, far).slider(-3, 3)).as("value", "In standard deviations.")}),
       object({op("replace", "puts other frames of a component in place of some"), one(),
               required(range()).as("frames", "The frames that are replaced."),
               required(range()).as("by_frames", "The frames that take their place."),
               number(0.1)
                   .between(0, 100)
                   .in("s")
                   .as("fade", "Blends in and out, inside the frames.")
                   .optional(0.1),
               choice({{"stretch", "stretches them to fit"}, {"repeat", "repeats them as often as needed"}})
                   .as("fit", "What happens where they are of other length.")
                   .optional("stretch")}),
       object({op("copy_add", "adds a component of other components"), one(),
               number(1).between(-far, far).slider(-1, 3).as("factor", "How much of it.").optional(1),
               integer(0)
                   .between(0, 10000)
                   .as("segment", "Which segment of `other` gives it, from 0.")
                   .optional(0),
               some_frames("The frames it is added to.")}),
       object({op("transfer", "gives components of one segment to another"),
               required(either({component_type(), list(component_type())}))
                   .as("components", "Which are transferred."),
               segment_number("from", "The segment that gives, from 0."),
               segment_number("to", "The segment that receives."),
               list(text("joint:*"))
                   .as("align",
                       "What the time warp goes by: u1, group:NAME, joint:PATTERN, dof:JOINT.x. Empty: all "
                       "joints.")
                   .optional(Json::Array{}),
               choice({{"to", "the giving one is warped"},
                       {"from", "the receiving one is warped, its path with it"}})
                   .as("keep_timing_of", "Whose timing stays.")
                   .optional("to"),
               some_frames("The frames that receive."),
               number(1)
                   .between(-far, far)
                   .slider(0, 1)
                   .as("amount", "0 = unchanged, 1 = wholly.")
                   .optional(1)}),
       object({op("substitute", "puts in a component that other nodes have changed, from the input `edited`"),
               one()}),
       object({op("warp", "bends a component's curve through given values"), one(),
               required(list(tuple({integer(0).between(0, 1e9), number(0).between(-far, far)})))
                   .as("keys", "Each a frame and the value wanted there.")})});
}

}  // namespace

NodeType component_edit_node() {
  NodeType type;
  type.name = "ComponentEdit";
  type.category = "components";
  type.help = "Changes components, or gives those of one clip to another, and makes a motion of them again.";
  type.source = "Shapiro et al. 2006 §4, §5, eq. 4 to 7; Cao et al. 2003 §5, §6";
  type.keywords = {"style", "transfer", "scale", "ica", "edit"};
  type.input("components", {"Components"}, "What ICA found.");
  type.optional_input("other", {"Components"}, "Other components, for copy_add.");
  type.optional_input("edited", {"Motion", "Points"},
                      "A ComponentMotion that other nodes have changed, for substitute.");
  type.output("motion", "Motion", "The edited motion.");
  type.output("points", "Points", "The edited points.");
  type.output("components", "Components", "The changed components, to go on from.", "components");
  type.param("edits", list(edit_type()), "Done one after the other.");
  type.param("segment", integer(-1).between(-1, 10000),
             "The clip that is edited, from 0: its path, heading and bones are the result's. -1: the one "
             "that transfers "
             "give to, else the first.");
  type.param("limbs", boolean(true), "For points: bones keep their lengths, from the root outwards.");
  type.param("lowpass", number(6).between(0, 1000).in("Hz").slider(0, 20),
             "Smooths signals that an edit warped in time or replaced; 0 = off.");
  type.param("root", boolean(true), "Puts the clip's path and heading back; off: on the spot.");
  type.param("residual", boolean(false), "Adds what the components leave out of the clip.");
  type.code_version = 8;
  type.compute = edit;
  return type;
}

}  // namespace kinegraph
