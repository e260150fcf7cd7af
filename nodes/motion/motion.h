// A motion: a skeleton and, for every frame, each joint's local rotation and, where it varies, its local
// translation. Every algorithm works along time, so each channel's whole time series is contiguous.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "graph/value.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

enum class UpAxis { y, z };

// How a BVH spelled its joints; kept so that an exporter writes the same file back.
struct BvhJoint {
  std::vector<std::string> channels;  // "Xposition", "Zrotation" … in the file's order
  Vec3 offset;                        // OFFSET as written, in the file's unit and axes
};
// What a motion remembers of its source; a node's output takes them from its main input.
struct SourceFacts {
  std::string format;           // "bvh", "asf-amc", "gltf", "" = made by the program
  double unit = 1;              // metres per unit of the file
  std::string unit_name = "m";  // m, cm, mm, in, cmu or ""
  UpAxis up = UpAxis::y;
  // BVH only; one entry a joint of the skeleton, empty otherwise.
  std::vector<BvhJoint> bvh;
  std::vector<Vec3> bvh_ends;  // End Site OFFSETs as written, in the order of Skeleton::ends
  double frame_time = 0;       // as written; 0 = not a BVH
  std::string frame_time_text;
  // Channel values as read, a whole series a channel (all joints' channels in order), in the file's units and
  // degrees: so rotations go back out as what was read, or the solution nearest to it. They are this motion's
  // frames while it has `read_frames` of them, from entry `first_read` of each series on (read->size() divided
  // by the number of channels long).
  std::shared_ptr<const std::vector<double>> read;
  std::size_t read_frames = 0;
  std::size_t first_read = 0;
};

// The same facts of a motion whose frames are no longer those that were read: without the angles as read.
std::shared_ptr<const SourceFacts> without_read(const std::shared_ptr<const SourceFacts>& source);

// Three or four time series of `frames` doubles each, one after the other.
struct Vec3Track {
  std::span<double> x, y, z;
  Vec3 operator[](std::size_t t) const { return {x[t], y[t], z[t]}; }
  void set(std::size_t t, Vec3 v) const {
    x[t] = v.x;
    y[t] = v.y;
    z[t] = v.z;
  }
};
struct ConstVec3Track {
  std::span<const double> x, y, z;
  Vec3 operator[](std::size_t t) const { return {x[t], y[t], z[t]}; }
};
struct QuatTrack {
  std::span<double> x, y, z, w;
  Quat operator[](std::size_t t) const { return {x[t], y[t], z[t], w[t]}; }
  void set(std::size_t t, Quat q) const {
    x[t] = q.x;
    y[t] = q.y;
    z[t] = q.z;
    w[t] = q.w;
  }
};
struct ConstQuatTrack {
  std::span<const double> x, y, z, w;
  Quat operator[](std::size_t t) const { return {x[t], y[t], z[t], w[t]}; }
};

class Motion final : public Value {
 public:
  Motion() = default;
  // Rotations start at rest, translations at the joints' offsets. `translates[j]`: joint j has a translation
  // track.
  Motion(std::shared_ptr<const Skeleton> skeleton, std::shared_ptr<const SourceFacts> source, double fps,
         std::size_t frames, std::vector<bool> translates);

  const Skeleton& skeleton() const { return *skeleton_; }
  const std::shared_ptr<const Skeleton>& shared_skeleton() const { return skeleton_; }
  const SourceFacts& source() const { return *source_; }
  const std::shared_ptr<const SourceFacts>& shared_source() const { return source_; }
  void set_source(std::shared_ptr<const SourceFacts> source) { source_ = std::move(source); }
  double fps() const { return fps_; }  // frames per second, > 0
  std::size_t frames() const { return frames_; }
  int joints() const { return skeleton_->size(); }

  // Local rotation of a joint (it includes the rest rotation: at rest it equals Joint::rest).
  QuatTrack rotation(int joint);
  ConstQuatTrack rotation(int joint) const;
  // Local translation; only of a joint that has one.
  bool translates(int joint) const { return translation_at_[joint] >= 0; }
  std::vector<bool> translating() const;
  Vec3Track translation(int joint);
  ConstVec3Track translation(int joint) const;
  // Local translation at a frame, the rest offset where the joint has no track.
  Vec3 local_offset(int joint, std::size_t frame) const;

  // Same skeleton, source, rate and tracks with other numbers of frames or joints that translate; contents at
  // rest.
  Motion empty_like(std::size_t frames) const;
  Motion with_translation(
      int joint) const;  // a copy in which the joint has a track, filled with its rest offset

  std::string_view type() const override { return "Motion"; }
  std::size_t bytes() const override;
  void encode(Encoder& out) const override;
  std::optional<NonFinite> non_finite() const override;

 private:
  friend ValuePtr decode_motion(Decoder& in);
  // Takes the numbers of as many frames in place of its own: rotations of all joints, then translations.
  void replace_frames(std::size_t frames, std::vector<double> data);

  std::shared_ptr<const Skeleton> skeleton_ = std::make_shared<Skeleton>();
  std::shared_ptr<const SourceFacts> source_ = std::make_shared<SourceFacts>();
  double fps_ = 120;
  std::size_t frames_ = 0;
  std::vector<std::ptrdiff_t> translation_at_;  // offset into data_, -1 = none
  std::vector<double> data_;                    // rotations of all joints, then translations
};
ValuePtr decode_motion(Decoder& in);

}  // namespace kinegraph
