#include "nodes/motion/contacts.h"

#include <cmath>

#include "nodes/motion/codec.h"

namespace kinegraph {

std::size_t Contacts::bytes() const {
  return sizeof(Contacts) + points.size() * (sizeof(FootPoint) + 64 + frames / 8);
}

void Contacts::encode(Encoder& out) const {
  out.f64(fps);
  out.u64(frames);
  out.f64(floor);
  out.f64(leg);
  encode_list(out, points, [&](const FootPoint& point) {
    out.text(point.foot);
    out.boolean(point.left);
    out.text(point.part);
    out.i64(point.joint);
    out.text(point.joint_name);
    kinegraph::encode(out, point.local);
    encode_flags(out, point.planted);
    out.f64s(point.heights);
  });
}

ValuePtr decode_contacts(Decoder& in) {
  auto contacts = std::make_shared<Contacts>();
  contacts->fps = in.f64();
  contacts->frames = in.u64();
  contacts->floor = in.f64();
  contacts->leg = in.f64();
  contacts->points = decode_list<FootPoint>(in, [&] {
    FootPoint point;
    point.foot = in.text();
    point.left = in.boolean();
    point.part = in.text();
    point.joint = static_cast<int>(in.i64());
    point.joint_name = in.text();
    point.local = decode_vec3(in);
    point.planted = decode_flags(in);
    if (point.planted.size() != contacts->frames)
      damaged("a foot has flags for other frames than the contacts");
    point.heights = in.f64s();
    return point;
  });
  return contacts;
}

std::optional<NonFinite> Contacts::non_finite() const {
  if (!std::isfinite(fps)) return NonFinite{"frames per second", "", {}};
  if (!std::isfinite(floor)) return NonFinite{"floor", "", {}};
  if (!std::isfinite(leg)) return NonFinite{"leg", "", {}};
  for (const FootPoint& point : points)
    if (!is_finite(point.local)) return NonFinite{"foot point", point.joint_name, {}};
  for (const FootPoint& point : points)
    for (double height : point.heights)
      if (!std::isfinite(height)) return NonFinite{"height of a plant", point.joint_name, {}};
  return {};
}

std::vector<Run> runs_of(const std::vector<bool>& flags) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (!flags[i]) continue;
    if (runs.empty() || runs.back().end != i) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

}  // namespace kinegraph
