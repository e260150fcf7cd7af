#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/motion/moving_root.h"
#include "nodes/node_params.h"
#include "nodes/style/style_transfer.h"

namespace kinegraph {

namespace {

// Chosen on the CMU clips. Thumbs and fingers that are near-rigid in a walk (σ about 0.03) would be magnified
// 6 to 30 times by a reference that uses its hands, and their strays of 35 to 40° from the mean would fold
// over; at 4 they reach 160° and stay quiet. The joints that carry a style have gains up to 3.3 in the pairs
// of Wu's Table 1 but for neck and head, which hardly move; between two walks the bound costs 1.5 % of the
// change in style.
constexpr double default_max_gain = 4;

StyleTransferParams settings_of(const Params& params, const Motion& motion, Work& work) {
  StyleTransferParams settings;
  settings.space = params.text("space") == "euler" ? StyleSpace::euler : StyleSpace::quaternion;
  const std::string& part = params.text("transfer");
  settings.transfer = part == "mean"     ? TransferredPart::mean
                      : part == "spread" ? TransferredPart::spread
                                         : TransferredPart::both;
  const std::string& root = params.text("root");
  settings.root = root == "travel"   ? TransferredRoot::travel
                  : root == "height" ? TransferredRoot::height
                  : root == "none"   ? TransferredRoot::none
                                     : TransferredRoot::both;
  settings.travel = params.text("travel") == "printed" ? TravelKind::printed : TravelKind::feet;
  settings.heading = params.text("heading") == "transfer" ? HeadingKind::transfer : HeadingKind::keep;
  settings.max_gain = params.number("max_gain");
  settings.joints = chosen_joints(params.text("joints"), motion.skeleton(), "joints", work);
  settings.weights = change_weights(params, motion.frames(), motion.fps());
  settings.map = params.texts("map");
  return settings;
}

}  // namespace

NodeType style_transfer_node() {
  NodeType type;
  type.name = "StyleTransfer";
  type.category = "style";
  type.help =
      "Gives a motion the style measured from another: every joint's mean and spread, the root's travel and "
      "height.";
  type.source = "Wu, On-line Motion Style Transfer, §5, eq. 4, 5 and 7";
  type.keywords = {"style", "transfer", "statistics", "mood", "walk", "Wu"};
  type.input("motion", {"Motion"}, "the motion that gets the style and keeps its content");
  type.input("style", {"Stats"}, "the style: QuatStats of the reference");
  type.optional_input("own", {"Stats"},
                      "the motion's own statistics; open: measured here with style's settings");
  type.output("motion", "Motion", "the motion in the new style", "motion");
  type.param("space",
             choice({{"quaternion", "eq. 7: rotations on the sphere"},
                     {"euler",
                      "eq. 5: each Euler angle by itself, for comparison; it jerks where angles turn fast"}}),
             "how rotations are transferred; the statistics must be of the same space");
  type.param("transfer",
             choice({{"both", "mean and spread"},
                     {"mean", "the mean pose only"},
                     {"spread", "the size of movement only"}}),
             "what of the style is taken");
  type.param("root",
             choice({{"both", "speed of travel and height"},
                     {"travel", "speed of travel only"},
                     {"height", "height only"},
                     {"none", "the path stays as it is"}}),
             "what the root's path takes; it follows the root joint in joints");
  type.param(
      "travel",
      choice({{"feet", "the motion's own travel times the one factor that lets planted feet slide least"},
              {"printed", "eq. 4 as it stands: the reference's speed and sideways drift"}}),
      "how fast the result travels");
  type.param("heading",
             choice({{"keep", "the motion's own"}, {"transfer", "eq. 4 on the change of heading"}}),
             "where the result faces");
  type.param("max_gain", number(default_max_gain).between(0, 1e6).slider(0, 10),
             "bound of reference spread / own spread of a joint; 0 = none. Joints that hardly move in the "
             "motion would "
             "otherwise be magnified until they fold over");
  add_joints_param(type);
  add_range_param(type);
  add_fade_param(type);
  add_amount_param(type);
  add_map_param(type);
  type.code_version = 7;
  type.compute = [](Compute& compute) {
    const auto told = with_moving_root(compute.shared_input<Motion>("motion"), compute.work());
    const Motion& motion = *told;
    const StyleTransferParams settings = settings_of(compute.params(), motion, compute.work());
    StyleTransferResult result =
        style_transfer(motion, compute.input<Stats>("style"), compute.optional_input<Stats>("own"), settings,
                       compute.work());
    compute.output("motion", std::move(result.motion));
  };
  return type;
}

}  // namespace kinegraph
