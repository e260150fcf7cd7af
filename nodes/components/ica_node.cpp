#include <fmt/format.h>

#include <algorithm>

#include "graph/compute.h"
#include "graph/node_type.h"
#include "nodes/components/ica.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/motion/moving_root.h"
#include "nodes/node_params.h"

namespace kinegraph {
namespace {

IcaParams ica_params(const Params& params) {
  IcaParams out;
  out.components = static_cast<int>(params.integer("components"));
  out.variance = params.number("variance");
  out.rotate = params.text("method") != "pca";
  out.fast_ica.symmetric = params.text("method") != "deflation";
  const std::string& g = params.text("nonlinearity");
  out.fast_ica.nonlinearity = g == "pow3"    ? Nonlinearity::pow3
                              : g == "gauss" ? Nonlinearity::gauss
                                             : Nonlinearity::logcosh;
  out.fast_ica.tolerance = params.number("tolerance");
  out.fast_ica.iterations = static_cast<int>(params.integer("iterations"));
  out.seed = static_cast<std::uint64_t>(params.integer("seed"));
  out.starts = static_cast<int>(params.integer("starts"));
  return out;
}

template <class T>
std::vector<std::shared_ptr<const T>> all_as(std::span<const ValuePtr> values) {
  std::vector<std::shared_ptr<const T>> out;
  for (const ValuePtr& value : values)
    if (auto one = std::dynamic_pointer_cast<const T>(value)) out.push_back(std::move(one));
  return out;
}

// Inputs after the first that are other skeletons: rest poses that differ are told, where rotations count. A
// joint that translates has no place at rest. `given`: as they came, before their roots were moved.
void compare_skeletons(const ChannelSpace& space, const std::vector<std::shared_ptr<const Motion>>& given,
                       Work& work) {
  if (space.representation == Representation::points) return;
  const Skeleton& first = given.front()->skeleton();
  for (const auto& motion : given) {
    if (motion->shared_skeleton() == given.front()->shared_skeleton()) continue;
    const auto partner = joints_of(space, motion->skeleton());
    std::vector<bool> still;
    for (int j = 0; j < first.size(); ++j)
      still.push_back(!given.front()->translates(j) && (partner[j] < 0 || !motion->translates(partner[j])));
    warn_about_partners(motion->skeleton(), first, partner, work, &still);
  }
}

// Names the clip that differs from the first.
void check_rates(const std::vector<double>& fps, bool of_points) {
  for (std::size_t i = 1; i < fps.size(); ++i) {
    try {
      check_same_rate(fps.front(), fps[i], "clip 0", "clip " + std::to_string(i));
    } catch (const Failure& failure) {
      Diagnostic told = Diagnostic(failure.diagnostic()).at_port("motions");
      if (of_points)
        told.hint =
            fmt::format("Resample takes motions only; set `fps` of clip {}'s Load to {:.6g}", i, fps.front());
      throw Failure(std::move(told));
    }
  }
}

void decompose_inputs(Compute& node) {
  const Params& params = node.params();
  const auto values = node.values("motions");
  auto motions = all_as<Motion>(values);
  const auto points = all_as<Points>(values);
  if (!motions.empty() && !points.empty())
    throw Failure(error("mixed-inputs", "some inputs are motions, others points")
                      .at_port("motions")
                      .hinting("link clips of one kind"));
  if (!motions.empty()) {
    const auto given = motions;
    std::vector<double> fps;
    for (const auto& motion : motions) fps.push_back(motion->fps());
    check_rates(fps, false);
    for (auto& motion : motions) motion = with_moving_root(motion, node.work());
    const auto chosen =
        chosen_joints(params.text("joints"), motions.front()->skeleton(), "joints", node.work());
    ChannelSpace space = space_of_motions(representation_from(params.text("representation")), motions, chosen,
                                          params.boolean("heading"), params.texts("map"), node.work());
    compare_skeletons(space, given, node.work());
    node.output("components",
                components_of_motions(std::move(space), motions, ica_params(params), node.work()));
    return;
  }
  std::vector<double> fps;
  for (const auto& one : points) fps.push_back(one->fps);
  check_rates(fps, true);
  const std::string& how = params.text("stabilise");
  const auto chosen = chosen_names(params.text("joints"), points.front()->labels, "joints", node.work());
  ChannelSpace space = space_of_points(points,
                                       how == "centroid" ? Stabilise::centroid
                                       : how == "rigid"  ? Stabilise::rigid
                                                         : Stabilise::none,
                                       chosen);
  node.output("components", components_of_points(std::move(space), points, ica_params(params), node.work()));
}

}  // namespace

NodeType ica_node() {
  NodeType type;
  type.name = "ICA";
  type.category = "components";
  type.code_version = 6;
  type.help =
      "Splits one or several clips, joined, into independent components: signals over time, each moving the "
      "whole body in its own way.";
  type.source = "Shapiro et al. 2006 §3; Cao et al. 2003 §3, eq. 2; Hyvärinen 1999";
  type.keywords = {"independent", "component", "analysis", "pca", "decompose", "style"};
  type.list_input("motions", {"Motion", "Points"}, "Clips, joined frame after frame.");
  type.output("components", "Components", "Mean, mixing matrix and signals of the components.");
  type.param("representation",
             choice({{"points", "joint positions, relative to the root"},
                     {"quaternions", "joint rotations as unit quaternions"},
                     {"euler", "joint rotations as Euler angles in the file's order"},
                     {"logarithm", "joint rotations as rotation vectors from their mean"}}),
             "Numbers that stand for a pose. Ignored for Points.");
  type.param("components", integer(0).between(0, 1000),
             "How many; 0 = enough for `variance`. The papers use 3 to 5.");
  type.param("variance", number(0.95).between(0.01, 1).slider(0.8, 1),
             "Part of the variance to keep where `components` is 0.");
  type.param("nonlinearity",
             choice({{"logcosh", "tanh: a good start for all"},
                     {"pow3", "kurtosis: fast, minds outliers"},
                     {"gauss", "for signals that are mostly at rest"}}),
             "What is taken as a measure of independence.");
  type.param("method",
             choice({{"symmetric", "all components together"},
                     {"deflation", "one after the other"},
                     {"pca", "principal components, for comparison"}}),
             "How the components are found.");
  type.param("seed", integer(0).between(0, 9007199254740991.0),
             "0 = a fixed sequence of first guesses; others make their own.");
  type.param("starts", integer(8).between(1, 1000),
             "First guesses tried; the most independent result is kept.");
  type.param("tolerance", number(1e-4).between(1e-15, 0.5), "Change of a component below which it is found.");
  type.param("iterations", integer(200).between(1, 100000), "Most rounds of one start.");
  type.param("heading", boolean(true), "Takes the walking direction out, and puts it back later.");
  type.param("stabilise",
             choice({{"none", "points as they are"},
                     {"centroid", "the mean of `joints` is taken out"},
                     {"rigid", "the rigid motion of `joints` is taken out"}}),
             "For Points: what is taken out of every frame before, and put back later.");
  add_joints_param(type);
  add_map_param(type);
  type.compute = decompose_inputs;
  return type;
}

}  // namespace kinegraph
