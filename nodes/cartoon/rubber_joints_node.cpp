#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/cartoon/rubber_joints.h"
#include "nodes/cartoon/rubber_skin.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/motion/elementary.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/node_params.h"
#include "nodes/quiet_work.h"

namespace kinegraph {
namespace {

// 17 rad/s, 2.8 Hz: a hand that stops swings on once visibly and is still after half a second. With this drag
// slow moves trail by drag/hook = 40 ms.
constexpr double default_hook = 300, default_link = 600, default_drag = 12;

RubberParams settings_of(const Params& params) {
  RubberParams settings;
  for (const auto& [pattern, count] : params.json("sub_joints").object())
    settings.sub_joints.counts.emplace_back(pattern, static_cast<int>(count.number()));
  for (const Json& chain : params.json("groups").array())
    settings.sub_joints.groups.emplace_back(chain.find("from")->string(), chain.find("to")->string());
  settings.sub_joints.prune = params.text("prune");
  settings.simulate = params.boolean("simulate");
  settings.springs.hook = params.number("hook");
  settings.springs.link = params.number("link");
  settings.springs.drag = params.number("drag");
  settings.springs.drag_in_root = params.text("drag_in") == "root";
  settings.springs.substeps = static_cast<int>(params.integer("substeps"));
  settings.blend = params.number("blend");
  return settings;
}

// Where no contacts are linked the feet's own; a skeleton without feet has none.
std::optional<Contacts> found_contacts(const Motion& motion, Work& work) {
  try {
    QuietWork quiet(work);
    Contacts found = detect_contacts(motion, {}, quiet);
    if (std::all_of(found.points.begin(), found.points.end(),
                    [](const FootPoint& point) { return runs_of(point.planted).empty(); }))
      work.report(info("no-contacts", "no foot rests anywhere, so feet swing with their limbs")
                      .at_port("contacts")
                      .hinting("exaggerated feet seldom rest: link the contacts of the clip before that"));
    return found;
  } catch (const Failure& failure) {
    if (failure.diagnostic().code != "no-feet") throw;
    return {};
  }
}

// Which chains became limbs of rubber, and into how many sub-joints each was cut.
void tell_of_limbs(const Skeleton& skeleton, const SubJoints& sub, Work& work) {
  std::vector<std::string> limbs;
  for (const auto& group : sub.groups) {
    int count = 0;
    for (int joint : group) count += sub.all[sub.first[joint]].count;
    if (count > static_cast<int>(group.size()))
      limbs.push_back(fmt::format("{}…{} {}", skeleton.joints[group.front()].name,
                                  skeleton.joints[group.back()].name, count));
  }
  work.report(
      info("sub-joints", fmt::format("{} joints were cut into {} sub-joints; limbs: {}", skeleton.size(),
                                     sub.all.size(), limbs.empty() ? "none" : listed(limbs))));
}

// The mesh goes with the motion where both have the same body: joints by name, links at rest alike.
void check_body(const Skeleton& motion, const Skeleton& character, Work& work) {
  constexpr double most_turn = 5 / degrees_per_radian, most_length = 0.05;
  std::vector<std::string> alone, other;
  for (int j = 0; j < character.size(); ++j) {
    const Joint& joint = character.joints[j];
    const int partner = motion.find(joint.name);
    if (partner < 0) {
      alone.push_back(joint.name);
      continue;
    }
    const double mine = character.link_length(j) * character.above_scale,
                 theirs = motion.link_length(partner) * motion.above_scale;
    if (j == 0 || std::max(mine, theirs) < 1e-3 * rest_height(character)) continue;
    if (std::fabs(mine - theirs) > most_length * std::max(mine, theirs) ||
        turn(smallest_turn(joint.offset, motion.joints[partner].offset)) > most_turn)
      other.push_back(joint.name);
  }
  if (alone.size() == character.joints.size())
    throw Failure(error("no-common-joint", "the motion and the character have no joint of the same name")
                      .at_port("character")
                      .hinting("link the character of the motion's own file, or put a Retarget node with the "
                               "character as its target before motion"));
  if (!alone.empty())
    work.report(
        warning("no-partner", fmt::format("{} of the character's {} joints aren't in the motion and stay "
                                          "as they are at rest: {}",
                                          alone.size(), character.size(), listed(alone)))
            .at_port("character"));
  if (!other.empty())
    work.report(
        warning("rest-pose-differs",
                fmt::format("the motion's body is not the character's: {} of {} links are longer, shorter "
                            "or turned at rest: {}",
                            other.size(), character.size(), listed(other)))
            .at_port("character")
            .hinting("put a Retarget node with the character as its target before motion"));
}

}  // namespace

NodeType rubber_joints_node() {
  NodeType type;
  type.name = "RubberJoints";
  type.code_version = 15;
  type.category = "cartoon";
  type.help =
      "Turns limbs into rubber: cuts links into sub-joints, bends them along curves and lets them follow "
      "through on "
      "springs.";
  type.source = "Kwon & Lee, Exaggerating Character Motions Using Sub-Joint Hierarchy, §5";
  type.keywords = {"cartoon", "rubber", "hose", "follow", "overlap", "spring", "jiggle", "Kwon"};
  type.input("motion", {"Motion"}, "the motion whose limbs become rubber");
  type.optional_input("character", {"Character"}, "a skinned mesh that gets the same sub-joints");
  type.optional_input("contacts", {"Contacts"},
                      "planted points, which don't swing, best those of the clip before it was exaggerated; "
                      "open: found as DetectContacts does");
  type.output("motion", "Motion", "the motion on the sub-joint skeleton", "motion");
  type.output("character", "Character",
              "the mesh on the sub-joint skeleton, its weights shared out; with a character in", "character");
  type.param(
      "sub_joints", table(integer(1).between(1, 100)),
      "joint pattern to number of sub-joints of its link; by length where nothing is said. Hard shells, as a "
      "mannequin's, need 12 or so not to gape where links stretch");
  type.param("groups",
             list(object({required(text("")).as("from", "the chain's joint nearest to the root"),
                          required(text("")).as("to", "its last joint")})),
             "chains that bend as one curve; empty: every limb below its last branching");
  type.param(
      "prune", pattern("").checked_by(check_pattern),
      "joints that don't count as branches; empty: fingers, thumbs, toe ends and twist bones by their names");
  type.param("simulate", boolean(true), "let sub-joints follow through on springs");
  type.param("hook", number(default_hook).between(0, 1e6).in("s⁻²").slider(50, 2000),
             "stiffness of the spring from each sub-joint to its place");
  type.param("link", number(default_link).between(0, 1e6).in("s⁻²").slider(0, 5000),
             "stiffness of the springs between neighbours");
  type.param("drag", number(default_drag).between(0, 1e4).in("s⁻¹").slider(0, 60),
             "how fast swinging dies away; slow moves trail by drag / hook seconds");
  type.param("drag_in",
             choice({{"root", "against the root's own motion, so that steady travel doesn't trail"},
                     {"world", "against the world, as printed"}}),
             "what the drag holds still against");
  type.param("blend", number(0.7).between(0, 1).slider(0, 1), "0 is the curve exactly, 1 all springs");
  type.param("substeps", integer(0).between(0, 1000),
             "steps of the simulation a frame, at least; 0 = by frame rate and stiffness");
  type.compute = [](Compute& compute) {
    const auto motion = compute.shared_input<Motion>("motion");
    Work& work = compute.work();
    const RubberParams settings = settings_of(compute.params());
    const Contacts* contacts = compute.optional_input<Contacts>("contacts");
    std::optional<Contacts> found;
    if (!contacts && settings.simulate && settings.blend > 0 && motion->frames() > 1) {
      found = found_contacts(*motion, work);
      if (found) contacts = &*found;
    }
    const auto* character = compute.optional_input<Character>("character");
    if (character) check_body(motion->skeleton(), *character->skeleton, work);
    RubberResult rubber = rubber_joints(*motion, settings, contacts, work);
    tell_of_limbs(motion->skeleton(), rubber.sub_joints, work);
    if (character) {
      if (compute.wanted("character"))
        compute.output("character",
                       rubber_character(*character, *motion, rubber.sub_joints, settings.sub_joints, work));
    }
    compute.output("motion", std::move(rubber.motion));
  };
  return type;
}

}  // namespace kinegraph
