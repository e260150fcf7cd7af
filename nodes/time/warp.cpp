#include "nodes/time/warp.h"

#include <cmath>

#include "nodes/motion/codec.h"

namespace kinegraph {

std::size_t Warp::bytes() const {
  std::size_t sum = sizeof(Warp) + sizeof(double) * (energy.capacity() + means.capacity());
  for (const auto& path : paths) sum += sizeof(path) + sizeof(path[0]) * path.capacity();
  for (const auto& name : dofs) sum += sizeof(name) + name.capacity();
  for (const auto& frame : skipped) sum += sizeof(frame) + sizeof(double) * frame.logs.capacity();
  return sum;
}

void Warp::encode(Encoder& out) const {
  out.boolean(identity);
  out.boolean(source_warped);
  out.f64(fps);
  out.u32(source_frames);
  out.u32(reference_frames);
  encode_list(out, paths, [&](const std::vector<std::uint32_t>& path) { out.u32s(path); });
  encode_list(out, dofs, [&](const std::string& name) { out.text(name); });
  out.f64s(means);
  encode_list(out, skipped, [&](const SkippedFrame& frame) {
    out.u32(frame.frame);
    out.f64(frame.d_x);
    out.f64(frame.d_z);
    out.f64(frame.d_heading);
    out.f64(frame.height);
    out.f64s(frame.logs);
  });
  out.f64s(energy);
  out.i64(rounds);
}

ValuePtr decode_warp(Decoder& in) {
  auto warp = std::make_shared<Warp>();
  warp->identity = in.boolean();
  warp->source_warped = in.boolean();
  warp->fps = in.f64();
  warp->source_frames = in.u32();
  warp->reference_frames = in.u32();
  warp->paths = decode_list<std::vector<std::uint32_t>>(in, [&] { return in.u32s(); });
  warp->dofs = decode_list<std::string>(in, [&] { return in.text(); });
  warp->means = in.f64s();
  warp->skipped = decode_list<SkippedFrame>(in, [&] {
    SkippedFrame frame;
    frame.frame = in.u32();
    frame.d_x = in.f64();
    frame.d_z = in.f64();
    frame.d_heading = in.f64();
    frame.height = in.f64();
    frame.logs = in.f64s();
    return frame;
  });
  warp->energy = in.f64s();
  warp->rounds = static_cast<int>(in.i64());
  std::uint32_t frames = warp->source_warped ? warp->source_frames : warp->reference_frames;
  for (const auto& path : warp->paths)
    for (auto frame : path)
      if (frame >= frames) damaged("a warp names a frame that its motion lacks");
  return warp;
}

std::optional<NonFinite> Warp::non_finite() const {
  if (!std::isfinite(fps)) return NonFinite{"frames per second", "", {}};
  for (double e : energy)
    if (!std::isfinite(e)) return NonFinite{"energy", "", {}};
  for (double m : means)
    if (!std::isfinite(m)) return NonFinite{"mean", "", {}};
  for (const SkippedFrame& frame : skipped) {
    double sum = frame.d_x + frame.d_z + frame.d_heading + frame.height;
    for (double l : frame.logs) sum += l;
    if (!std::isfinite(sum)) return NonFinite{"skipped frame", "", frame.frame};
  }
  return {};
}

}  // namespace kinegraph
