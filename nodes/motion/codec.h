// How vectors, rotations, skeletons and source facts are written for the disk cache and read back.
#pragma once
#include "graph/value.h"
#include "nodes/motion/motion.h"

namespace kinegraph {

void encode(Encoder& out, Vec3 v);
void encode(Encoder& out, Quat q);
void encode(Encoder& out, const Skeleton& skeleton);
void encode(Encoder& out, const SourceFacts& source);
Vec3 decode_vec3(Decoder& in);
Quat decode_quat(Decoder& in);
Skeleton decode_skeleton(Decoder& in);
SourceFacts decode_source(Decoder& in);

// A list: its length, then each element by `put`; and back, element after element, so that a damaged length
// throws where the bytes end and never allocates first.
template <class T, class Put>
void encode_list(Encoder& out, const std::vector<T>& all, Put put) {
  out.u64(all.size());
  for (const T& one : all) put(one);
}
template <class T, class Get>
std::vector<T> decode_list(Decoder& in, Get get) {
  std::vector<T> all;
  for (auto count = in.u64(); count > 0; --count) all.push_back(get());
  return all;
}
void encode_flags(Encoder& out, const std::vector<bool>& flags);
std::vector<bool> decode_flags(Decoder& in);

bool is_finite(Vec3 v);
bool is_finite(Quat q);
// Throws Failure ("damaged-entry"): an encoded value contradicts itself.
[[noreturn]] void damaged(const char* what);

}  // namespace kinegraph
