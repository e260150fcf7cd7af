#include "nodes/style/stats.h"

#include <cmath>

#include "nodes/motion/codec.h"

namespace kinegraph {

std::size_t Stats::bytes() const {
  return sizeof(Stats) + joints.size() * (sizeof(JointStats) + 32) +
         parents.size() * (sizeof(int) + sizeof(Vec3) + sizeof(Quat));
}

void Stats::encode(Encoder& out) const {
  out.text(space);
  out.text(mean_kind);
  encode_list(out, joints, [&](const JointStats& joint) {
    out.text(joint.joint);
    out.boolean(joint.chosen);
    kinegraph::encode(out, joint.mean);
    out.f64(joint.spread);
    out.text(joint.order);
    for (double v : joint.euler_mean) out.f64(v);
    for (double v : joint.euler_spread) out.f64(v);
  });
  encode_list(out, parents, [&](int parent) { out.i64(parent); });
  encode_list(out, offsets, [&](Vec3 offset) { kinegraph::encode(out, offset); });
  encode_list(out, rests, [&](Quat rest) { kinegraph::encode(out, rest); });
  for (double v : root_mean) out.f64(v);
  for (double v : root_spread) out.f64(v);
  out.f64(leg_length);
  out.f64(fps);
  out.u64(frames);
}

ValuePtr decode_stats(Decoder& in) {
  auto stats = std::make_shared<Stats>();
  stats->space = in.text();
  stats->mean_kind = in.text();
  stats->joints = decode_list<JointStats>(in, [&] {
    JointStats joint;
    joint.joint = in.text();
    joint.chosen = in.boolean();
    joint.mean = decode_quat(in);
    joint.spread = in.f64();
    joint.order = in.text();
    for (double& v : joint.euler_mean) v = in.f64();
    for (double& v : joint.euler_spread) v = in.f64();
    return joint;
  });
  stats->parents = decode_list<int>(in, [&] { return static_cast<int>(in.i64()); });
  stats->offsets = decode_list<Vec3>(in, [&] { return decode_vec3(in); });
  stats->rests = decode_list<Quat>(in, [&] { return decode_quat(in); });
  for (double& v : stats->root_mean) v = in.f64();
  for (double& v : stats->root_spread) v = in.f64();
  stats->leg_length = in.f64();
  stats->fps = in.f64();
  stats->frames = in.u64();
  for (auto size : {stats->parents.size(), stats->offsets.size(), stats->rests.size()})
    if (size != stats->joints.size()) damaged("stats describe other joints than they measured");
  for (int j = 0; j < static_cast<int>(stats->parents.size()); ++j)
    if (stats->parents[j] < -1 || stats->parents[j] >= j) damaged("a joint comes before its parent");
  return stats;
}

std::optional<NonFinite> Stats::non_finite() const {
  for (const JointStats& joint : joints) {
    if (!is_finite(joint.mean)) return NonFinite{"mean", joint.joint, {}};
    if (!std::isfinite(joint.spread)) return NonFinite{"spread", joint.joint, {}};
    for (int k = 0; k < 3; ++k) {
      if (!std::isfinite(joint.euler_mean[k])) return NonFinite{"Euler mean", joint.joint, {}};
      if (!std::isfinite(joint.euler_spread[k])) return NonFinite{"Euler spread", joint.joint, {}};
    }
  }
  for (std::size_t j = 0; j < offsets.size() && j < rests.size(); ++j)
    if (!is_finite(offsets[j]) || !is_finite(rests[j])) return NonFinite{"rest pose", joints[j].joint, {}};
  for (double v : root_mean)
    if (!std::isfinite(v)) return NonFinite{"root mean", "", {}};
  for (double v : root_spread)
    if (!std::isfinite(v)) return NonFinite{"root spread", "", {}};
  if (!std::isfinite(leg_length)) return NonFinite{"leg length", "", {}};
  if (!std::isfinite(fps)) return NonFinite{"frames per second", "", {}};
  return {};
}

}  // namespace kinegraph
