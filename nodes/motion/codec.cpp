#include "nodes/motion/codec.h"

#include <cmath>

#include "graph/diagnostic.h"

namespace kinegraph {

void damaged(const char* what) {
  throw Failure(error("damaged-entry", what));
}

bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_finite(Quat q) {
  return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

void encode(Encoder& out, Vec3 v) {
  out.f64(v.x);
  out.f64(v.y);
  out.f64(v.z);
}
void encode(Encoder& out, Quat q) {
  out.f64(q.x);
  out.f64(q.y);
  out.f64(q.z);
  out.f64(q.w);
}
Vec3 decode_vec3(Decoder& in) {
  Vec3 v;
  v.x = in.f64();
  v.y = in.f64();
  v.z = in.f64();
  return v;
}
Quat decode_quat(Decoder& in) {
  Quat q;
  q.x = in.f64();
  q.y = in.f64();
  q.z = in.f64();
  q.w = in.f64();
  return q;
}

void encode_flags(Encoder& out, const std::vector<bool>& flags) {
  std::vector<std::uint8_t> packed((flags.size() + 7) / 8);
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (flags[i]) packed[i / 8] = static_cast<std::uint8_t>(packed[i / 8] | 1u << i % 8);
  out.u64(flags.size());
  out.bytes(packed);
}
std::vector<bool> decode_flags(Decoder& in) {
  auto count = in.u64();
  auto packed = in.bytes();
  if (packed.size() != count / 8 + (count % 8 != 0))
    damaged("a list of flags has another length than it says");
  std::vector<bool> flags(count);
  for (std::size_t i = 0; i < count; ++i) flags[i] = packed[i / 8] >> i % 8 & 1;
  return flags;
}

void encode(Encoder& out, const Skeleton& skeleton) {
  encode_list(out, skeleton.joints, [&](const Joint& joint) {
    out.text(joint.name);
    out.i64(joint.parent);
    encode(out, joint.offset);
    encode(out, joint.rest);
  });
  encode_list(out, skeleton.ends, [&](const EndSite& end) {
    out.i64(end.joint);
    encode(out, end.offset);
    out.text(end.name);
  });
  encode(out, skeleton.above);
  encode(out, skeleton.above_offset);
  out.f64(skeleton.above_scale);
}

Skeleton decode_skeleton(Decoder& in) {
  Skeleton skeleton;
  skeleton.joints = decode_list<Joint>(in, [&] {
    Joint joint;
    joint.name = in.text();
    joint.parent = static_cast<int>(in.i64());
    joint.offset = decode_vec3(in);
    joint.rest = decode_quat(in);
    return joint;
  });
  for (int j = 0; j < skeleton.size(); ++j) {
    int parent = skeleton.joints[j].parent;
    if (parent < -1 || parent >= j || (parent == -1 && j > 0)) damaged("a joint comes before its parent");
  }
  skeleton.ends = decode_list<EndSite>(in, [&] {
    EndSite end;
    end.joint = static_cast<int>(in.i64());
    end.offset = decode_vec3(in);
    end.name = in.text();
    if (end.joint < 0 || end.joint >= skeleton.size()) damaged("an End Site hangs on no joint");
    return end;
  });
  skeleton.above = decode_quat(in);
  skeleton.above_offset = decode_vec3(in);
  skeleton.above_scale = in.f64();
  return skeleton;
}

void encode(Encoder& out, const SourceFacts& source) {
  out.text(source.format);
  out.f64(source.unit);
  out.text(source.unit_name);
  out.u8(source.up == UpAxis::z ? 1 : 0);
  encode_list(out, source.bvh, [&](const BvhJoint& joint) {
    encode_list(out, joint.channels, [&](const std::string& channel) { out.text(channel); });
    encode(out, joint.offset);
  });
  encode_list(out, source.bvh_ends, [&](Vec3 end) { encode(out, end); });
  out.f64(source.frame_time);
  out.text(source.frame_time_text);
  out.boolean(source.read != nullptr);
  if (source.read) out.f64s(*source.read);
  out.u64(source.read_frames);
  out.u64(source.first_read);
}

SourceFacts decode_source(Decoder& in) {
  SourceFacts source;
  source.format = in.text();
  source.unit = in.f64();
  source.unit_name = in.text();
  source.up = in.u8() ? UpAxis::z : UpAxis::y;
  source.bvh = decode_list<BvhJoint>(in, [&] {
    BvhJoint joint;
    joint.channels = decode_list<std::string>(in, [&] { return in.text(); });
    joint.offset = decode_vec3(in);
    return joint;
  });
  source.bvh_ends = decode_list<Vec3>(in, [&] { return decode_vec3(in); });
  source.frame_time = in.f64();
  source.frame_time_text = in.text();
  if (in.boolean()) source.read = std::make_shared<const std::vector<double>>(in.f64s());
  source.read_frames = in.u64();
  source.first_read = in.u64();
  return source;
}

}  // namespace kinegraph
