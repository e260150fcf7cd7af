// Every op of ComponentEdit on real clips, against its equation written out here once more: plain loops over
// the matrices, and joints' places from a forward kinematics of the tests' own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "nodes/time/motion_warp.h"
#include "tests/nodes/components/clips.h"
#include "tests/nodes/components/plain_tables.h"
#include "tests/nodes/run_node.h"

namespace kinegraph {
NodeType component_edit_node();
NodeType component_motion_node();
namespace {

using namespace plain;

// Components of points have no motion to ask for.
class PointsOnly : public NodeInMemory {
 public:
  using NodeInMemory::NodeInMemory;
  bool wanted(std::string_view port) const override { return port != "motion"; }
};

struct Sort {
  const char* name;
  std::function<Components()> make, others;
  friend void PrintTo(const Sort& sort, std::ostream* out) { *out << sort.name; }
};
Components walk_and_sneak() {
  Alone work;
  return analysed({real_clip("cmu/asfamc/16_31.amc"), real_clip("cmu/asfamc/17_03.amc")},
                  Representation::points, 4, work);
}
Components slow_walk_and_sneak() {
  Alone work;
  return analysed({real_clip("cmu/asfamc/07_05.amc"), real_clip("cmu/asfamc/17_03.amc")},
                  Representation::points, 3, work);
}
Components face(int components) {
  PlainFiles files;
  Alone work;
  std::vector<std::shared_ptr<const Points>> clips;
  for (const char* name : {"points/face_eyebrows.trc", "points/face_jaw.trc"})
    clips.push_back(std::make_shared<const Points>(*read_motion_file(mocap(name), {}, files, work).points()));
  IcaParams params;
  params.components = components;
  return components_of_points(
      space_of_points(clips, Stabilise::none, std::vector<bool>(clips[0]->labels.size(), true)), clips,
      params, work);
}
const Sort sorts[] = {{"WalkAndSneak", walk_and_sneak, slow_walk_and_sneak},
                      {"Face", [] { return face(4); }, [] { return face(3); }}};

class EditsOfRealClips : public testing::TestWithParam<Sort> {
 protected:
  void SetUp() override {
    KINEGRAPH_NEEDS_MOCAP();
    c = GetParam().make();
    u = u_of(c, 0);
    frames = u[0].size();
    plain = x_of(c, u);
  }
  NodeInMemory edited(const char* edits, std::function<void(NodeInMemory&)> more = {}, double lowpass = 0) {
    PointsOnly node(component_edit_node());
    node.link("components", c).set("edits", list_of(edits)).set("limbs", false).set("root", false);
    node.set("lowpass", lowpass);
    if (more) more(node);
    return node.run();
  }
  static Json list_of(const char* text) {
    return parse_value(*component_edit_node().find_param("edits"), text);
  }
  // What came out, as channels, differs from what the equation says by less than 1e-9 of a metre.
  void expect(NodeInMemory node, const Table& x) {
    EXPECT_LT(farthest(channels_of(node.out<Points>("points"), c.space.of_motions), x), 1e-9);
    EXPECT_GT(farthest(x, plain), 0.002) << "or the edit shows nothing";
  }

  Components c;
  Table u, plain;
  std::size_t frames = 0;
};
INSTANTIATE_TEST_SUITE_P(Of, EditsOfRealClips, testing::ValuesIn(sorts),
                         [](const auto& sort) { return std::string(sort.param.name); });

TEST_P(EditsOfRealClips, Scale) {
  for (double& value : u[0]) value *= -1.5;
  expect(edited(R"([{"op":"scale","component":"u1","factor":-1.5}])"), x_of(c, u));
}

TEST_P(EditsOfRealClips, Translate) {
  for (double& value : u[1]) value += 1.7;
  expect(edited(R"([{"op":"translate","component":2,"value":1.7}])"), x_of(c, u));
}

TEST_P(EditsOfRealClips, MergeWithFactorsOneChangesNothing) {
  NodeInMemory merged = edited(R"([{"op":"merge","name":"two","terms":[[1,1],[3,1]]}])"), none = edited("[]");
  EXPECT_EQ(merged.out<Points>("points").data, none.out<Points>("points").data);
}

// x = E{x} + PA(... + s(α₁u₁e₁ + α₃u₃e₃) + v(α₁e₁ + α₃e₃)) for a group scaled by s and shifted by v.
TEST_P(EditsOfRealClips, MergeWithFactorsAndEditsOfTheGroup) {
  const double alpha[] = {2, 0, -0.5, 0};
  for (std::size_t i : {0, 2})
    for (double& value : u[i]) value = 1.5 * alpha[i] * value + 0.4 * alpha[i];
  NodeInMemory node = edited(R"([{"op":"merge","name":"two","terms":[[1,2],["u3",-0.5]]},
                                 {"op":"scale","component":"two","factor":1.5},
                                 {"op":"translate","component":"two","value":0.4}])");
  expect(node, x_of(c, u));
  // And to look at, the group alone.
  PointsOnly shown(component_motion_node());
  shown.link("components", node.out<Components>("components")).set("component", "two").run();
  Table alone = u;
  for (std::size_t i : {1, 3}) std::fill(alone[i].begin(), alone[i].end(), 0.0);
  const Table x = x_of(c, alone), is = channels_of(shown.out<Points>("points"), c.space.of_motions);
  if (!c.space.of_motions) {
    EXPECT_LT(farthest(is, x), 1e-9);
    return;
  }
  // A motion is shown with whole bones on its clip's path: the same directions, turned by its heading.
  const auto psi = independent::heading_of(*c.segments[0].motion).psi;
  for (int j = 1; j < c.space.skeleton->size(); ++j) {
    const auto at = 3 * static_cast<std::size_t>(j),
               from = 3 * static_cast<std::size_t>(c.space.skeleton->joints[j].parent);
    if (c.space.skeleton->link_length(j) < 1e-9) continue;
    for (std::size_t t = 0; t < frames; ++t) {
      const Vec3 wanted{x[at][t] - x[from][t], x[at + 1][t] - x[from + 1][t], x[at + 2][t] - x[from + 2][t]},
          link{is[at][t] - is[from][t], is[at + 1][t] - is[from + 1][t], is[at + 2][t] - is[from + 2][t]};
      ASSERT_LT(norm(normalized(link) - rotate(about_y(psi[t]), normalized(wanted))), 1e-9);
    }
  }
}

TEST_P(EditsOfRealClips, ReplaceStretched) {
  const auto before = u[0];
  for (std::size_t t = 40; t < 160; ++t)
    u[0][t] = linear(before, 200 + static_cast<double>(t - 40) * (259 - 200) / 119.0);
  expect(edited(R"([{"op":"replace","component":1,"frames":[40,160],"by_frames":[200,260],"fade":0}])"),
         x_of(c, u));
}

TEST_P(EditsOfRealClips, ReplaceRepeated) {
  const auto before = u[1];
  for (std::size_t t = 40; t < 240; ++t) u[1][t] = before[10 + (t - 40) % 25];
  expect(edited(R"([{"op":"replace","component":2,"frames":[40,240],"by_frames":[10,35],"fade":0,
                     "fit":"repeat"}])"),
         x_of(c, u));
}

// Blended over 24 frames at each end, by 3w² - 2w³.
TEST_P(EditsOfRealClips, ReplaceFaded) {
  const auto before = u[0];
  const double fade = 24;
  for (std::size_t t = 40; t < 160; ++t) {
    const double w =
        std::min({1.0, static_cast<double>(t - 39) / (fade + 1), static_cast<double>(160 - t) / (fade + 1)});
    u[0][t] += w * w * (3 - 2 * w) * (before[t + 160] - before[t]);
  }
  const std::string edit =
      fmt::format(R"([{{"op":"replace","component":1,"frames":[40,160],"by_frames":[200,320],"fade":{}}}])",
                  fade / c.fps);
  expect(edited(edit.c_str()), x_of(c, u));
}

// x + factor (PA)₂ v, v resampled to this segment.
TEST_P(EditsOfRealClips, CopyAdd) {
  const Components other = GetParam().others();
  const auto v = u_of(other, 0)[1];
  Table x = plain;
  for (std::size_t t = 40; t < 240; ++t) {
    const double time =
        static_cast<double>(t) * static_cast<double>(v.size() - 1) / static_cast<double>(frames - 1);
    for (std::size_t d = 0; d < x.size(); ++d) x[d][t] += 0.7 * other.mixing(d, 1) * linear(v, time);
  }
  expect(edited(R"([{"op":"copy_add","component":2,"factor":0.7,"segment":0,"frames":[40,240]}])",
                [&](NodeInMemory& node) { node.link("other", other); }),
         x);
}

// Through the values wanted at frames 90 and 200, by the cubic spline of their differences with level ends.
TEST_P(EditsOfRealClips, Warp) {
  const double knots[] = {0, 90, 200, static_cast<double>(frames - 1)};
  const double values[] = {0, 2.5 - u[0][90], -1.5 - u[0][200], 0};
  // Slopes m from the spline's equations at the two inner knots, by elimination.
  const double h[] = {knots[1] - knots[0], knots[2] - knots[1], knots[3] - knots[2]};
  const double rise[] = {(values[1] - values[0]) / h[0], (values[2] - values[1]) / h[1],
                         (values[3] - values[2]) / h[2]};
  const double a = 2 * (1 / h[0] + 1 / h[1]), b = 1 / h[1], d = 2 * (1 / h[1] + 1 / h[2]);
  const double r = 3 * (rise[0] / h[0] + rise[1] / h[1]), s = 3 * (rise[1] / h[1] + rise[2] / h[2]);
  const double slopes[] = {0, (r * d - b * s) / (a * d - b * b), (a * s - b * r) / (a * d - b * b), 0};
  for (std::size_t t = 0; t < frames; ++t) {
    const std::size_t k = t < 90 ? 0 : t < 200 ? 1 : 2;
    const double x = (static_cast<double>(t) - knots[k]) / h[k];
    u[0][t] += (1 + 2 * x) * (1 - x) * (1 - x) * values[k] + x * (1 - x) * (1 - x) * h[k] * slopes[k] +
               x * x * (3 - 2 * x) * values[k + 1] + x * x * (x - 1) * h[k] * slopes[k + 1];
  }
  expect(edited(R"([{"op":"warp","component":1,"keys":[[90,2.5],[200,-1.5]]}])"), x_of(c, u));
}

// x + (x_edited - x₁): the component as ComponentMotion shows it, and as a node has changed it.
TEST_P(EditsOfRealClips, Substitute) {
  Table x = plain;
  if (c.space.of_motions) {
    NodeInMemory shown(component_motion_node());
    shown.link("components", c).set("component", 1).run();
    const Motion& alone = shown.out<Motion>("motion");
    const int arm = alone.skeleton().find("rhumerus");
    Alone work;
    const Motion changed = motion_warp(
        alone, {{120, "rhumerus", alone.rotation(arm)[120] * axis_angle({1, 0, 0}, 0.8), {}}}, work);
    const Table was = channels_of(alone), is = channels_of(changed);
    for (std::size_t d = 0; d < x.size(); ++d)
      for (std::size_t t = 0; t < frames; ++t) x[d][t] += is[d][t] - was[d][t];
    expect(edited(R"([{"op":"substitute","component":1}])",
                  [&](NodeInMemory& node) { node.link("edited", changed); }),
           x);
  } else {
    Table one = u;
    for (std::size_t i = 1; i < u.size(); ++i) std::fill(one[i].begin(), one[i].end(), 0.0);
    const Table alone = x_of(c, one);
    Points changed(c.space.labels, c.fps, frames);
    for (std::size_t d = 0; d < x.size(); ++d)
      for (std::size_t t = 0; t < frames; ++t) {
        const double bend = 0.01 * std::sin(0.05 * static_cast<double>(t + 7 * d));
        changed.data[d * frames + t] = alone[d][t] + bend;
        x[d][t] += bend;
      }
    expect(edited(R"([{"op":"substitute","component":1}])",
                  [&](NodeInMemory& node) { node.link("edited", changed); }),
           x);
  }
}

// x + (x_base - P A (P A)⁺ (x_base - E{x}) - E{x}): what the components leave out comes back.
TEST_P(EditsOfRealClips, Residual) {
  Table base;
  if (c.space.of_motions)
    base = channels_of(*c.segments[0].motion);
  else
    base = channels_of(*c.segments[0].points, false);
  for (double& value : u[0]) value *= 2;
  Table x = x_of(c, u);
  for (std::size_t d = 0; d < x.size(); ++d)
    for (std::size_t t = 0; t < frames; ++t) x[d][t] += base[d][t] - plain[d][t];
  expect(edited(R"([{"op":"scale","component":1,"factor":2}])",
                [](NodeInMemory& node) { node.set("residual", true); }),
         x);
}

std::vector<double> centred(std::vector<double> x) {
  double mean = 0;
  for (double value : x) mean += value / static_cast<double>(x.size());
  for (double& value : x) value -= mean;
  return x;
}
// 2 log(q̄⁻¹ q) of joints of both clips over their common spread.
void add_joint(const Motion& a, const Motion& b, const std::string& name, const std::vector<int>& axes,
               Table& of_a, Table& of_b) {
  Table vectors[2];
  double square = 0;
  for (const Motion* motion : {&a, &b}) {
    const int joint = motion->skeleton().find(name);
    std::vector<Quat> rotations;
    for (std::size_t t = 0; t < motion->frames(); ++t) rotations.push_back(motion->rotation(joint)[t]);
    const Quat mean = independent::spread_of(rotations).mean;
    Table v(3);
    for (Quat q : rotations) {
      Quat d = inverse(mean) * q;
      if (d.w < 0) d = {-d.x, -d.y, -d.z, -d.w};
      const double s = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), angle = 2 * std::atan2(s, d.w);
      const double k = s > 1e-15 ? angle / s : 2;
      v[0].push_back(k * d.x), v[1].push_back(k * d.y), v[2].push_back(k * d.z);
      square += angle * angle;
    }
    vectors[motion == &b] = v;
  }
  const double spread =
      std::max(0.05, 0.5 * std::sqrt(square / static_cast<double>(a.frames() + b.frames())));
  for (int axis : axes) {
    Table both;
    double largest = 0;
    for (int side : {0, 1}) {
      both.push_back(vectors[side][static_cast<std::size_t>(axis)]);
      for (double& value : both.back()) value /= spread, largest = std::max(largest, std::fabs(value));
    }
    if (largest < 1e-7) continue;  // doesn't move
    of_a.push_back(both[0]), of_b.push_back(both[1]);
  }
}

class TransfersOfRealClips : public EditsOfRealClips {
 protected:
  void SetUp() override {
    EditsOfRealClips::SetUp();
    if (IsSkipped()) return;
    b = u_of(c, 1);
  }
  // u + amount (b(s) - u) of components 1 and 3 in frames 50 to 300, where s is what these features give.
  void expect_transfer(const std::string& align, const Table& of_a, const Table& of_b) {
    const auto s = clock_map(path_between(of_a, of_b), frames, b[0].size(), true);
    for (std::size_t i : {0, 2})
      for (std::size_t t = 50; t < 300; ++t) u[i][t] += 0.6 * (linear(b[i], s[t]) - u[i][t]);
    const std::string merge =
        align.find("group:") == 0 ? R"({"op":"merge","name":"swing","terms":[[2,1],[4,1]]},)" : "";
    const std::string edit = fmt::format(
        R"([{}{{"op":"transfer","components":[1,"u3"],"from":1,"to":0,"align":["{}"],"frames":[50,300],
             "amount":0.6}}])",
        merge, align);
    expect(edited(edit.c_str()), x_of(c, u));
  }
  // Places of a point without their mean, over their common spread.
  void add_point(const char* label, const std::vector<int>& axes, Table& of_a, Table& of_b) {
    const int at = static_cast<int>(std::find(c.space.labels.begin(), c.space.labels.end(), label) -
                                    c.space.labels.begin());
    for (int axis : axes) {
      Table both;
      double square = 0, count = 0;
      for (std::size_t segment : {0, 1}) {
        std::vector<double> x;
        for (std::size_t t = 0; t < c.segments[segment].frames(); ++t)
          x.push_back(c.segments[segment].points->track(at)[t][axis]);
        both.push_back(centred(x));
        for (double value : both.back()) square += value * value, count += 1;
      }
      for (auto& x : both)
        for (double& value : x) value /= std::sqrt(square / count);
      of_a.push_back(both[0]), of_b.push_back(both[1]);
    }
  }
  Table b;
};
INSTANTIATE_TEST_SUITE_P(Of, TransfersOfRealClips, testing::ValuesIn(sorts),
                         [](const auto& sort) { return std::string(sort.param.name); });

TEST_P(TransfersOfRealClips, AlignedByAComponent) {
  expect_transfer("u2", {centred(u[1])}, {centred(b[1])});
}

TEST_P(TransfersOfRealClips, AlignedByAGroup) {
  expect_transfer("group:swing", {centred(u[1]), centred(u[3])}, {centred(b[1]), centred(b[3])});
}

TEST_P(TransfersOfRealClips, AlignedByJoints) {
  Table of_a, of_b;
  if (c.space.of_motions) {
    for (const char* joint : {"lfemur", "rfemur", "lhumerus"})
      add_joint(*c.segments[0].motion, *c.segments[1].motion, joint, {0, 1, 2}, of_a, of_b);
    expect_transfer("joint:lfemur,rfemur,lhumerus", of_a, of_b);
  } else {
    add_point("Chin", {0, 1, 2}, of_a, of_b);
    expect_transfer("joint:Chin", of_a, of_b);
  }
}

TEST_P(TransfersOfRealClips, AlignedByADegreeOfFreedom) {
  Table of_a, of_b;
  if (c.space.of_motions) {
    add_joint(*c.segments[0].motion, *c.segments[1].motion, "ltibia", {0}, of_a, of_b);
    expect_transfer("dof:ltibia.x", of_a, of_b);
  } else {
    add_point("Leyebrow_M", {1}, of_a, of_b);
    expect_transfer("dof:Leyebrow_M.y", of_a, of_b);
  }
}

// The base in the giver's timing: its own signals u(s), of which 1 and 3 go 0.6 of the way to the giver's.
TEST_P(TransfersOfRealClips, InTheGiversTiming) {
  const auto s = clock_map(path_between({centred(u[1])}, {centred(b[1])}), frames, b[0].size(), false);
  Table now = b;
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t t = 0; t < s.size(); ++t) {
      const double own = linear(u[i], s[t]);
      now[i][t] = i == 0 || i == 2 ? own + 0.6 * (b[i][t] - own) : own;
    }
  NodeInMemory node = edited(R"([{"op":"transfer","components":[1,3],"from":1,"to":0,"align":["u2"],
                                  "keep_timing_of":"from","amount":0.6}])");
  EXPECT_LT(farthest(channels_of(node.out<Points>("points"), c.space.of_motions), x_of(c, now)), 1e-9);
}

// What an edit warps in time is smoothed at 6 Hz, nothing else is.
TEST_P(TransfersOfRealClips, SmoothsOnlyWhatIsWarped) {
  NodeInMemory node = edited(R"([{"op":"transfer","components":1,"from":1,"to":0,"align":["u2"]}])", {}, 6);
  const Table now = u_of(node.out<Components>("components"), 0);
  for (std::size_t i : {1, 2, 3}) EXPECT_EQ(now[i], u[i]);
  const auto jerk = [](const std::vector<double>& x) {
    double sum = 0;
    for (std::size_t t = 3; t < x.size(); ++t)
      sum += std::fabs(x[t] - 3 * x[t - 1] + 3 * x[t - 2] - x[t - 3]);
    return sum;
  };
  NodeInMemory rough = edited(R"([{"op":"transfer","components":1,"from":1,"to":0,"align":["u2"]}])");
  EXPECT_LT(jerk(now[0]), 0.5 * jerk(u_of(rough.out<Components>("components"), 0)[0]));
}

}  // namespace
}  // namespace kinegraph
