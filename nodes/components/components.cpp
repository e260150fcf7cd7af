#include "nodes/components/components.h"

#include <cmath>

#include "nodes/motion/codec.h"

namespace kinegraph {
namespace {

void encode_rows(Encoder& out, const Rows& rows) {
  out.u64(rows.rows);
  out.u64(rows.columns);
  out.f64s(rows.data);
}
Rows decode_rows(Decoder& in) {
  Rows rows;
  rows.rows = in.u64();
  rows.columns = in.u64();
  rows.data = in.f64s();
  if (rows.data.size() != rows.rows * rows.columns) damaged("a matrix has another size than it says");
  return rows;
}
void encode_texts(Encoder& out, const std::vector<std::string>& all) {
  encode_list(out, all, [&](const std::string& one) { out.text(one); });
}
std::vector<std::string> decode_texts(Decoder& in) {
  return decode_list<std::string>(in, [&] { return in.text(); });
}

void encode_space(Encoder& out, const ChannelSpace& space) {
  out.text(name_of(space.representation));
  out.boolean(space.of_motions);
  out.boolean(space.heading);
  out.boolean(space.skeleton != nullptr);
  if (space.skeleton) encode(out, *space.skeleton);
  encode_list(out, space.joints, [&](int joint) { out.i64(joint); });
  encode_texts(out, space.labels);
  encode_list(out, space.reference, [&](Quat q) { encode(out, q); });
  encode_texts(out, space.orders);
  encode_texts(out, space.map);
  out.i64(static_cast<int>(space.stabilise));
  encode_texts(out, space.stable);
  encode_list(out, space.shape, [&](Vec3 v) { encode(out, v); });
}
ChannelSpace decode_space(Decoder& in) {
  ChannelSpace space;
  space.representation = representation_from(in.text());
  space.of_motions = in.boolean();
  space.heading = in.boolean();
  if (in.boolean()) space.skeleton = std::make_shared<Skeleton>(decode_skeleton(in));
  space.joints = decode_list<int>(in, [&] { return static_cast<int>(in.i64()); });
  space.labels = decode_texts(in);
  space.reference = decode_list<Quat>(in, [&] { return decode_quat(in); });
  space.orders = decode_texts(in);
  space.map = decode_texts(in);
  space.stabilise = static_cast<Stabilise>(in.i64());
  space.stable = decode_texts(in);
  space.shape = decode_list<Vec3>(in, [&] { return decode_vec3(in); });
  return space;
}

std::optional<NonFinite> non_finite_in(const Rows& rows, const char* what, bool by_frame) {
  for (std::size_t i = 0; i < rows.data.size(); ++i)
    if (!std::isfinite(rows.data[i]))
      return NonFinite{by_frame ? what + std::to_string(i / rows.columns + 1) : what,
                       {},
                       by_frame ? std::optional<std::int64_t>(i % rows.columns) : std::nullopt};
  return std::nullopt;
}

}  // namespace

std::size_t Components::bytes() const {
  std::size_t sum =
      sizeof(*this) + 8 * (mixing.data.size() + unmixing.data.size() + signals.data.size() + mean.size());
  for (const ComponentSegment& segment : segments)
    sum +=
        (segment.motion ? segment.motion->bytes() : segment.points->bytes()) + 8 * segment.added.data.size();
  return sum;
}

void Components::encode(Encoder& out) const {
  encode_space(out, space);
  out.f64(fps);
  out.f64s(mean);
  encode_rows(out, mixing);
  encode_rows(out, unmixing);
  encode_rows(out, signals);
  out.f64s(shares);
  encode_list(out, segments, [&](const ComponentSegment& segment) {
    out.u64(segment.start);
    out.u64(segment.end);
    if (segment.motion)
      segment.motion->encode(out);
    else
      segment.points->encode(out);
    encode_rows(out, segment.added);
  });
  encode_list(out, groups, [&](const ComponentGroup& group) {
    out.text(group.name);
    encode_list(out, group.terms, [&](const std::pair<int, double>& term) {
      out.i64(term.first);
      out.f64(term.second);
    });
  });
  out.text(nonlinearity);
  out.text(method);
  out.boolean(converged);
  out.i64(iterations);
  out.f64(reached);
  out.f64(tolerance);
  out.f64(negentropy);
  encode_flags(out, unique);
}

ValuePtr decode_components(Decoder& in) {
  auto value = std::make_shared<Components>();
  value->space = decode_space(in);
  value->fps = in.f64();
  value->mean = in.f64s();
  value->mixing = decode_rows(in);
  value->unmixing = decode_rows(in);
  value->signals = decode_rows(in);
  value->shares = in.f64s();
  value->segments = decode_list<ComponentSegment>(in, [&] {
    ComponentSegment segment;
    segment.start = in.u64();
    segment.end = in.u64();
    if (value->space.of_motions)
      segment.motion = std::dynamic_pointer_cast<const Motion>(decode_motion(in));
    else
      segment.points = std::dynamic_pointer_cast<const Points>(decode_points(in));
    segment.added = decode_rows(in);
    return segment;
  });
  value->groups = decode_list<ComponentGroup>(in, [&] {
    ComponentGroup group;
    group.name = in.text();
    group.terms = decode_list<std::pair<int, double>>(in, [&] {
      const int component = static_cast<int>(in.i64());
      return std::pair<int, double>(component, in.f64());
    });
    return group;
  });
  value->nonlinearity = in.text();
  value->method = in.text();
  value->converged = in.boolean();
  value->iterations = static_cast<int>(in.i64());
  value->reached = in.f64();
  value->tolerance = in.f64();
  value->negentropy = in.f64();
  value->unique = decode_flags(in);
  return value;
}

std::optional<NonFinite> Components::non_finite() const {
  if (auto found = non_finite_in(signals, "u", true)) return found;
  return non_finite_in(mixing, "mixing matrix", false);
}

}  // namespace kinegraph
