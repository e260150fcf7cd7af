#include "nodes/motion/points.h"

#include <algorithm>
#include <cmath>

#include "nodes/motion/codec.h"
#include "nodes/motion/kinematics.h"

namespace kinegraph {

Points::Points(std::vector<std::string> names, double rate, std::size_t frame_count)
    : labels(std::move(names)), fps(rate), frames(frame_count), data(3 * labels.size() * frame_count) {}

ConstVec3Track Points::track(int label) const {
  const double* at = data.data() + 3 * frames * static_cast<std::size_t>(label);
  return {{at, frames}, {at + frames, frames}, {at + 2 * frames, frames}};
}
Vec3Track Points::track(int label) {
  double* at = data.data() + 3 * frames * static_cast<std::size_t>(label);
  return {{at, frames}, {at + frames, frames}, {at + 2 * frames, frames}};
}

void Points::set_missing(int label, std::size_t frame) {
  if (missing.empty()) missing.resize(labels.size() * frames);
  missing[static_cast<std::size_t>(label) * frames + frame] = true;
  track(label).set(frame, {});
}

std::size_t Points::bytes() const {
  return sizeof(Points) + sizeof(double) * data.capacity() + missing.capacity() / 8 + 64 * labels.size() +
         sizeof(links[0]) * links.capacity();
}

void Points::encode(Encoder& out) const {
  encode_list(out, labels, [&](const std::string& label) { out.text(label); });
  out.f64(fps);
  out.u64(frames);
  out.f64(unit);
  out.text(unit_name);
  out.u8(up == UpAxis::z ? 1 : 0);
  encode_list(out, links, [&](const std::pair<int, int>& link) {
    out.i64(link.first);
    out.i64(link.second);
  });
  out.f64s(data);
  encode_flags(out, missing);
}

ValuePtr decode_points(Decoder& in) {
  auto points = std::make_shared<Points>();
  points->labels = decode_list<std::string>(in, [&] { return in.text(); });
  points->fps = in.f64();
  points->frames = in.u64();
  points->unit = in.f64();
  points->unit_name = in.text();
  points->up = in.u8() ? UpAxis::z : UpAxis::y;
  points->links = decode_list<std::pair<int, int>>(in, [&] {
    int from = static_cast<int>(in.i64());
    int to = static_cast<int>(in.i64());
    int count = static_cast<int>(points->labels.size());
    if (from < 0 || to < 0 || from >= count || to >= count) damaged("a link joins no label");
    return std::pair{from, to};
  });
  points->data = in.f64s();
  points->missing = decode_flags(in);
  std::size_t labels = points->labels.size();
  if (labels == 0
          ? !points->data.empty()
          : points->data.size() % (3 * labels) != 0 || points->data.size() / (3 * labels) != points->frames)
    damaged("points have other frames than they say");
  if (!points->missing.empty() && points->missing.size() != points->data.size() / 3)
    damaged("points have a mask of another size");
  return points;
}

std::optional<NonFinite> Points::non_finite() const {
  if (!std::isfinite(fps) || !std::isfinite(unit)) return NonFinite{"frames per second or unit", "", {}};
  for (std::size_t label = 0; label < labels.size(); ++label) {
    auto series = track(static_cast<int>(label));
    for (std::size_t t = 0; t < frames; ++t)
      if (!is_finite(series[t])) return NonFinite{"position", labels[label], t};
  }
  return {};
}

ValuePtr points_of_motion(const Value& value) {
  const auto& motion = dynamic_cast<const Motion&>(value);
  const Skeleton& skeleton = motion.skeleton();
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  auto points = std::make_shared<Points>(std::move(names), motion.fps(), motion.frames());
  points->unit = motion.source().unit;
  points->unit_name = motion.source().unit_name;
  points->up = motion.source().up;
  WorldMotion world = world_motion(motion);
  for (int j = 0; j < skeleton.size(); ++j) {
    auto from = world.position(j);
    auto to = points->track(j);
    std::copy(from.x.begin(), from.x.end(), to.x.begin());
    std::copy(from.y.begin(), from.y.end(), to.y.begin());
    std::copy(from.z.begin(), from.z.end(), to.z.begin());
    if (skeleton.joints[j].parent >= 0) points->links.emplace_back(j, skeleton.joints[j].parent);
  }
  return points;
}

}  // namespace kinegraph
