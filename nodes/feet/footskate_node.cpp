#include <fmt/core.h>

#include <algorithm>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/feet/carried_contacts.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/feet/footskate.h"
#include "nodes/node_params.h"

namespace kinegraph {
namespace {

FootskateParams footskate_params(const Params& params) {
  FootskateParams result;
  result.blend = params.number("blend");
  result.stretch = params.number("stretch");
  result.knee_damping = params.number("knee_damping");
  if (params.json("floor").is_number()) result.floor = params.json("floor").number();
  result.root_smoothing = params.number("root_smoothing");
  return result;
}

bool any_planted(const Contacts& contacts) {
  return std::any_of(contacts.points.begin(), contacts.points.end(),
                     [](const FootPoint& point) { return !runs_of(point.planted).empty(); });
}

void clean(Compute& node) {
  const auto& motion = node.input<Motion>("motion");
  std::shared_ptr<const Contacts> contacts;
  if (node.values("contacts").empty()) {
    contacts = std::make_shared<const Contacts>(detect_contacts(motion, {}, node.work()));
  } else {
    contacts = std::make_shared<const Contacts>(
        carried_contacts(node.input<Contacts>("contacts"), motion, node.work()));
  }
  node.set_output("contacts", contacts);
  if (!node.wanted("motion")) return;
  const std::vector<double> weights = change_weights(node.params(), motion.frames(), motion.fps());
  FootskateResult result =
      clean_footskate(motion, *contacts, footskate_params(node.params()), weights, node.work());
  if (any_planted(*contacts)) {
    node.work().report(info(
        "footskate", fmt::format("legs stretch by up to {:.4f}, the root moves by up to {:.1f} mm, plants "
                                 "are met within {:.2f} mm",
                                 result.largest_stretch, 1000 * result.largest_root_move,
                                 1000 * result.largest_residual)));
  } else {
    node.work().report(
        warning("no-plants", "no foot is planted, nothing is held")
            .at_port("contacts")
            .hinting("link DetectContacts of the clip as it was before its style was changed; or lower "
                     "DetectContacts' min_time, or set plants by its edits"));
  }
  node.output("motion", std::move(result.motion));
}

}  // namespace

NodeType footskate_node() {
  const FootskateParams defaults;
  NodeType type;
  type.name = "Footskate";
  type.category = "feet";
  type.help =
      "Holds planted feet on their places: the root helps a little, legs stretch a little, and nothing pops.";
  type.source = "Kovar, Schreiner, Gleicher 2002: Footskate Cleanup for Motion Capture Editing";
  type.keywords = {"feet", "slide", "skate", "plant", "foot lock"};
  type.input("motion", {"Motion"}, "The motion whose feet slide.");
  type.optional_input("contacts", {"Contacts"},
                      "When the feet are planted; open: DetectContacts' defaults on the motion.");
  type.output("motion", "Motion",
              "The motion with feet that stay; knees and ankles translate where legs stretch.", "motion");
  type.output("contacts", "Contacts", "The contacts that were held.", "contacts");
  type.param("blend", number(defaults.blend).between(0.01, 10).in("s").slider(0.05, 1),
             "How long a change takes to die away in frames without a plant.");
  type.param(
      "stretch", number(defaults.stretch).between(0, 0.9).slider(0, 0.15),
      "Most change of a leg's length while its foot is planted, as a part of it; 0 = rigid legs. As the "
      "change dies away without a jerk, a swinging leg may go a little beyond. CMU walks that drift at 0.15 "
      "m/s need 0.047.");
  type.param("knee_damping", number(defaults.knee_damping).between(0, 180).in("°").slider(0, 150),
             "Flexion from which on the knee bends freely; towards extension it keeps its angle, so that it "
             "can't pop.");
  type.param("floor",
             either({choice({{"auto", "each plant is put at the height where its contact was found"}}),
                     number(0).in("m")}),
             "Height of the floor that plants are put on.");
  type.param("root_smoothing", number(defaults.root_smoothing).between(0, 10).in("s").slider(0, 0.5),
             "Smoothness of the root's help; more leaves more to the legs.");
  add_range_param(type);
  add_fade_param(type);
  add_amount_param(type);
  type.code_version = 9;
  type.compute = clean;
  return type;
}

}  // namespace kinegraph
