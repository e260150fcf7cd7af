#include "nodes/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/diagnostic.h"
#include "nodes/motion/codec.h"

namespace kinegraph {

namespace {

template <class Track, class Data>
Track vec3_at(Data& data, std::size_t at, std::size_t frames) {
  auto* first = data.data() + at;
  return {{first, frames}, {first + frames, frames}, {first + 2 * frames, frames}};
}
template <class Track, class Data>
Track quat_at(Data& data, std::size_t at, std::size_t frames) {
  auto* first = data.data() + at;
  return {
      {first, frames}, {first + frames, frames}, {first + 2 * frames, frames}, {first + 3 * frames, frames}};
}

void fill(Vec3Track track, Vec3 v) {
  std::fill(track.x.begin(), track.x.end(), v.x);
  std::fill(track.y.begin(), track.y.end(), v.y);
  std::fill(track.z.begin(), track.z.end(), v.z);
}

// 0 where all are finite, else NaN; four sums so that one addition needn't wait for the last.
double zero_if_finite(const std::vector<double>& values) {
  double sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= values.size(); i += 4)
    for (int k = 0; k < 4; ++k) sums[k] += values[i + k] * 0.0;
  for (; i < values.size(); ++i) sums[0] += values[i] * 0.0;
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace

std::shared_ptr<const SourceFacts> without_read(const std::shared_ptr<const SourceFacts>& source) {
  if (!source->read) return source;
  auto facts = std::make_shared<SourceFacts>(*source);
  facts->read = nullptr;
  facts->read_frames = facts->first_read = 0;
  return facts;
}

Motion::Motion(std::shared_ptr<const Skeleton> skeleton, std::shared_ptr<const SourceFacts> source,
               double fps, std::size_t frames, std::vector<bool> translates)
    : skeleton_(std::move(skeleton)), source_(std::move(source)), fps_(fps), frames_(frames) {
  if (!source_) source_ = std::make_shared<const SourceFacts>();
  std::size_t count = skeleton_->joints.size();
  translates.resize(count);
  std::size_t tracks = static_cast<std::size_t>(std::count(translates.begin(), translates.end(), true));
  data_.resize((4 * count + 3 * tracks) * frames);
  translation_at_.assign(count, -1);
  std::size_t at = 4 * count * frames;
  for (std::size_t j = 0; j < count; ++j) {
    const Joint& joint = skeleton_->joints[j];
    auto q = rotation(static_cast<int>(j));
    std::fill(q.x.begin(), q.x.end(), joint.rest.x);
    std::fill(q.y.begin(), q.y.end(), joint.rest.y);
    std::fill(q.z.begin(), q.z.end(), joint.rest.z);
    std::fill(q.w.begin(), q.w.end(), joint.rest.w);
    if (!translates[j]) continue;
    translation_at_[j] = static_cast<std::ptrdiff_t>(at);
    at += 3 * frames;
    fill(translation(static_cast<int>(j)), joint.offset);
  }
}

void Motion::replace_frames(std::size_t frames, std::vector<double> data) {
  frames_ = frames;
  data_ = std::move(data);
  std::size_t at = 4 * skeleton_->joints.size() * frames;
  for (std::ptrdiff_t& track : translation_at_) {
    if (track < 0) continue;
    track = static_cast<std::ptrdiff_t>(at);
    at += 3 * frames;
  }
}

QuatTrack Motion::rotation(int joint) {
  return quat_at<QuatTrack>(data_, 4 * frames_ * static_cast<std::size_t>(joint), frames_);
}
ConstQuatTrack Motion::rotation(int joint) const {
  return quat_at<ConstQuatTrack>(data_, 4 * frames_ * static_cast<std::size_t>(joint), frames_);
}
std::vector<bool> Motion::translating() const {
  std::vector<bool> flags(translation_at_.size());
  for (std::size_t j = 0; j < flags.size(); ++j) flags[j] = translation_at_[j] >= 0;
  return flags;
}
Vec3Track Motion::translation(int joint) {
  return vec3_at<Vec3Track>(data_, static_cast<std::size_t>(translation_at_[joint]), frames_);
}
ConstVec3Track Motion::translation(int joint) const {
  return vec3_at<ConstVec3Track>(data_, static_cast<std::size_t>(translation_at_[joint]), frames_);
}
Vec3 Motion::local_offset(int joint, std::size_t frame) const {
  return translates(joint) ? translation(joint)[frame] : skeleton_->joints[joint].offset;
}

Motion Motion::empty_like(std::size_t frames) const {
  return Motion(skeleton_, source_, fps_, frames, translating());
}

Motion Motion::with_translation(int joint) const {
  if (translates(joint)) return *this;
  auto flags = translating();
  flags[joint] = true;
  Motion copy(skeleton_, source_, fps_, frames_, flags);
  std::size_t rotations = 4 * frames_ * skeleton_->joints.size();
  std::copy_n(data_.begin(), rotations, copy.data_.begin());
  for (int j = 0; j < joints(); ++j) {
    if (!translates(j)) continue;
    std::copy_n(data_.begin() + translation_at_[j], 3 * frames_,
                copy.data_.begin() + copy.translation_at_[j]);
  }
  return copy;
}

std::size_t Motion::bytes() const {
  // The skeleton and the angles as read are often shared with other motions; each counts them, so the limit
  // holds.
  std::size_t sum = sizeof(Motion) + sizeof(double) * data_.capacity();
  sum += skeleton_->joints.size() * (sizeof(Joint) + 64);
  if (source_->read) sum += sizeof(double) * source_->read->capacity();
  return sum;
}

void Motion::encode(Encoder& out) const {
  kinegraph::encode(out, *skeleton_);
  kinegraph::encode(out, *source_);
  out.f64(fps_);
  out.u64(frames_);
  encode_flags(out, translating());
  out.f64s(data_);
}

ValuePtr decode_motion(Decoder& in) {
  auto skeleton = std::make_shared<const Skeleton>(decode_skeleton(in));
  auto source = std::make_shared<const SourceFacts>(decode_source(in));
  double fps = in.f64();
  auto frames = in.u64();
  auto translates = decode_flags(in);
  auto data = in.f64s();
  std::size_t tracks = 4 * skeleton->joints.size() +
                       3 * static_cast<std::size_t>(std::count(translates.begin(), translates.end(), true));
  if (translates.size() != skeleton->joints.size())
    damaged("a motion has flags for other joints than it has");
  bool fits = tracks == 0 ? data.empty() : data.size() % tracks == 0 && data.size() / tracks == frames;
  if (!fits || (tracks == 0 && frames > 0)) damaged("a motion has other frames than it says");
  auto motion = std::make_shared<Motion>(skeleton, source, fps, 0, translates);
  motion->replace_frames(frames, std::move(data));
  return motion;
}

std::optional<NonFinite> Motion::non_finite() const {
  if (!std::isfinite(fps_)) return NonFinite{"frames per second", "", {}};
  if (!is_finite(skeleton_->above) || !is_finite(skeleton_->above_offset) ||
      !std::isfinite(skeleton_->above_scale))
    return NonFinite{"transform above the root", "", {}};
  for (const Joint& joint : skeleton_->joints) {
    if (!is_finite(joint.offset)) return NonFinite{"offset", joint.name, {}};
    if (!is_finite(joint.rest)) return NonFinite{"rest rotation", joint.name, {}};
  }
  for (const EndSite& end : skeleton_->ends)
    if (!is_finite(end.offset)) return NonFinite{"End Site", skeleton_->joints[end.joint].name, {}};
  if (zero_if_finite(data_) == 0) return {};
  for (std::size_t t = 0; t < frames_; ++t) {
    for (int j = 0; j < joints(); ++j) {
      const std::string& name = skeleton_->joints[j].name;
      if (!is_finite(rotation(j)[t])) return NonFinite{"rotation", name, t};
      if (translates(j) && !is_finite(translation(j)[t])) return NonFinite{"translation", name, t};
    }
  }
  return {};
}

}  // namespace kinegraph
