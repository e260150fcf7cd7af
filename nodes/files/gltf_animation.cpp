#include "nodes/files/gltf_animation.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "nodes/files/decimal.h"

namespace kinegraph {

namespace {

enum class Between { step, linear, cubic };

using Times = std::shared_ptr<const std::vector<double>>;

// Key times by their accessor, which most channels of a clip share.
class KeyTimes {
 public:
  explicit KeyTimes(const GltfFile& file) : file_(file) {}
  Times operator()(int accessor) {
    Times& times = known_[accessor];
    if (!times) {
      times = std::make_shared<const std::vector<double>>(gltf_numbers(file_, accessor, 1));
      for (std::size_t i = 1; i < times->size(); ++i)
        if (!((*times)[i] > (*times)[i - 1])) bad_gltf("an animation's times don't rise");
    }
    return times;
  }

 private:
  const GltfFile& file_;
  std::map<int, Times> known_;
};

// One channel: keys and their values, `width` numbers each.
class Sampler {
 public:
  Sampler(const GltfFile& file, const tinygltf::AnimationSampler& sampler, Times times, std::size_t width,
          bool scalars)
      : width_(width), kept_(std::move(times)), times_(*kept_) {
    between_ = sampler.interpolation == "STEP"          ? Between::step
               : sampler.interpolation == "CUBICSPLINE" ? Between::cubic
                                                        : Between::linear;
    // Weights of morph targets are scalars, several a key.
    values_ = gltf_numbers(file, sampler.output, scalars ? 1 : static_cast<int>(width));
    if (times_.empty() || values_.size() != times_.size() * width * (between_ == Between::cubic ? 3 : 1))
      bad_gltf("an animation has other numbers of times and values");
  }
  // Into `out`, `width` numbers. A time within 1e-5 s of a key is the key's: keys are rounded to float32.
  void at(double time, bool turns, double* out) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), time + 1e-5);
    const std::size_t b = static_cast<std::size_t>(after - times_.begin());
    const std::size_t a = b == 0 ? 0 : b - 1;
    const bool on_key = b == 0 || b == times_.size() || time - times_[a] <= 1e-5;
    if (on_key || between_ == Between::step) {
      std::copy_n(value(a), width_, out);
      return;
    }
    const double span = times_[b] - times_[a], u = (time - times_[a]) / span;
    const double *p = value(a), *q = value(b);
    if (between_ == Between::cubic) {
      // Values stand between their in- and out-tangents.
      const double *leave = p + width_, *arrive = q - width_;
      const double uu = u * u, uuu = uu * u;
      for (std::size_t k = 0; k < width_; ++k)
        out[k] = (2 * uuu - 3 * uu + 1) * p[k] + span * (uuu - 2 * uu + u) * leave[k] +
                 (3 * uu - 2 * uuu) * q[k] + span * (uuu - uu) * arrive[k];
      return;
    }
    if (turns) {
      const Quat between =
          slerp(u, normalized(Quat{p[0], p[1], p[2], p[3]}), normalized(Quat{q[0], q[1], q[2], q[3]}));
      out[0] = between.x, out[1] = between.y, out[2] = between.z, out[3] = between.w;
      return;
    }
    for (std::size_t k = 0; k < width_; ++k) out[k] = p[k] + u * (q[k] - p[k]);
  }

 private:
  const double* value(std::size_t key) const {
    return values_.data() + width_ * (between_ == Between::cubic ? 3 * key + 1 : key);
  }
  std::size_t width_;
  Between between_ = Between::linear;
  Times kept_;
  const std::vector<double>& times_;
  std::vector<double> values_;
};

const tinygltf::Animation* chosen_clip(const tinygltf::Model& model, const std::string& wanted) {
  const auto& all = model.animations;
  if (wanted.empty()) return all.empty() ? nullptr : &all.front();
  for (const tinygltf::Animation& one : all)
    if (one.name == wanted) return &one;
  double index = -1;
  if (whole_number_text(wanted, index) && index >= 0 && index < static_cast<double>(all.size()) &&
      index == std::floor(index))
    return &all[static_cast<std::size_t>(index)];
  std::vector<std::string> names;
  for (const tinygltf::Animation& one : all) names.push_back(one.name);
  throw Failure(
      error("unknown-clip", fmt::format("there is no clip \"{}\" among the file's {}", wanted, all.size()))
          .hinting(all.empty() ? "leave clip empty" : suggestion(wanted, names))
          .at_param("clip"));
}

// Of several clips only one is read, which nobody may have meant.
void tell_other_clips(const std::vector<tinygltf::Animation>& all, Work& work) {
  constexpr std::size_t shown = 8;
  std::string names;
  for (std::size_t i = 0; i < all.size() && i < shown; ++i)
    names += (i > 0 ? ", " : "") + (all[i].name.empty() ? std::to_string(i) : all[i].name);
  if (all.size() > shown) names += fmt::format(" and {} more", all.size() - shown);
  work.report(
      info("clips", fmt::format("the file has {} clips, of which the first is read: {}", all.size(), names))
          .hinting("name one by Load's clip")
          .at_param("clip"));
}

constexpr std::size_t asked_each = 4096;  // frames

// The lowest whole rate on whose frames all times lie; 0 = none.
double rate_of_keys(const std::set<double>& times, Work& work) {
  for (int rate = 24; rate <= 240; ++rate) {
    work.check();
    if (std::all_of(times.begin(), times.end(), [&](double time) {
          const double frame = time * rate;
          return std::fabs(frame - std::floor(frame + 0.5)) <= 1e-3;
        }))
      return rate;
  }
  return 0;
}

// Its values are read when they are needed: those of all channels at once would be more than the motion.
struct Channel {
  int node;
  std::string path;
  const tinygltf::AnimationSampler* keys;
  Times times;
  std::size_t width;
  Sampler sampler(const GltfFile& file) const { return {file, *keys, times, width, path == "weights"}; }
};

}  // namespace

GltfClip gltf_clip(const GltfFile& file, const GltfNodes& nodes, const SourceFacts& facts,
                   const ReadOptions& options, double rate, Work& work) {
  const tinygltf::Model& model = *file.model;
  const tinygltf::Animation* clip = chosen_clip(model, options.clip);
  if (options.clip.empty() && model.animations.size() > 1) tell_other_clips(model.animations, work);
  const auto source = std::make_shared<const SourceFacts>(facts);
  std::vector<Channel> channels;
  KeyTimes key_times(file);
  std::set<double> times;
  if (clip) {
    for (const tinygltf::AnimationChannel& channel : clip->channels) {
      work.check();
      if (channel.target_node < 0 || channel.target_node >= static_cast<int>(model.nodes.size())) continue;
      if (channel.sampler < 0 || channel.sampler >= static_cast<int>(clip->samplers.size()))
        bad_gltf("an animation's channel has no sampler");
      std::size_t width = channel.target_path == "rotation" ? 4 : 3;
      if (channel.target_path == "weights") {
        const int mesh = model.nodes[channel.target_node].mesh;
        if (mesh < 0 || mesh >= static_cast<int>(model.meshes.size()) ||
            model.meshes[mesh].primitives.empty())
          continue;
        width = model.meshes[mesh].primitives.front().targets.size();
        if (width == 0) continue;
      }
      const tinygltf::AnimationSampler& keys = clip->samplers[channel.sampler];
      const Times its_times = key_times(keys.input);
      const bool known = std::any_of(channels.begin(), channels.end(),
                                     [&](const Channel& other) { return other.times == its_times; });
      channels.push_back({channel.target_node, channel.target_path, &keys, its_times, width});
      for (std::size_t i = 0; !known && i < its_times->size(); ++i) {
        if (i % asked_each == 0) work.check();
        times.insert(times.end(), (*its_times)[i]);  // they rise
      }
    }
  } else {
    work.report(info("no-clip", "the file has no animation; the motion is one frame at rest"));
  }
  const bool cut = options.range.start != 0 || options.range.end || options.drop_rest_frame;
  double fps = options.fps > 0 && !cut ? options.fps : rate > 0 ? rate : rate_of_keys(times, work);
  if (fps == 0) {
    fps = 60;
    work.report(info("resampled", "the keys lie on no whole frame rate; the clip is sampled at 60"));
  }
  const double last = times.empty() ? 0 : *times.rbegin();
  if (!(last * fps < 1e8)) bad_gltf("the animation is too long");
  const std::size_t whole = static_cast<std::size_t>(std::floor(std::max(last, 0.0) * fps + 1e-3)) + 1;
  // A single stray key would be hours of frames; whoever means them can say which.
  if (whole > 1'000'000 && whole / 100 > times.size() && !cut)
    throw Failure(
        error("too-long", fmt::format("the clip's {} keys last until {:g} s, {} frames at {:g} a second",
                                      times.size(), last, whole, fps))
            .hinting("set range to the frames that are meant, or fps to fewer a second")
            .at_param("range"));
  const FrameWindow window = frames_to_keep(options, whole);
  const std::size_t frames = window.last - window.first;
  auto time_of = [&](std::size_t t) { return static_cast<double>(window.first + t) / fps; };

  const Skeleton& skeleton = *nodes.skeleton;
  std::vector<bool> translates(skeleton.joints.size());
  if (!translates.empty()) translates[0] = true;
  std::vector<double> value(4);
  for (const Channel& channel : channels) {
    const int joint = nodes.joint_of_node[channel.node];
    if (joint < 0 || channel.path != "translation") continue;
    work.check();
    const Vec3 rest = skeleton.joints[joint].offset;
    const Sampler sampler = channel.sampler(file);
    for (std::size_t t = 0; t < frames && !translates[joint]; ++t) {
      if (t % asked_each == 0) work.check();
      sampler.at(time_of(t), false, value.data());
      const Vec3 place = nodes.scale_of_parent[joint] * Vec3{value[0], value[1], value[2]};
      translates[joint] = norm(place - rest) > 1e-7 + 1e-5 * norm(rest);
    }
  }
  GltfClip out{Motion(nodes.skeleton, source, fps, frames, translates), {}};
  std::string scaled;
  for (const Channel& channel : channels) {
    work.check();
    const int joint = nodes.joint_of_node[channel.node];
    const Sampler sampler = channel.sampler(file);
    if (channel.path == "weights") {
      const std::size_t targets =
          model.meshes[model.nodes[channel.node].mesh].primitives.front().targets.size();
      std::vector<double> weights(targets);
      const std::size_t first = out.morphs.size();
      for (std::size_t k = 0; k < targets; ++k)
        out.morphs.push_back({channel.node, static_cast<int>(k), std::vector<double>(frames)});
      for (std::size_t t = 0; t < frames; ++t) {
        if (t % 64 == 0) work.check();  // a face has hundreds of targets
        sampler.at(time_of(t), false, weights.data());
        for (std::size_t k = 0; k < targets; ++k) out.morphs[first + k].weights[t] = weights[k];
      }
      continue;
    }
    if (joint < 0) continue;
    for (std::size_t t = 0; t < frames; ++t) {
      if (t % asked_each == 0) work.check();
      sampler.at(time_of(t), channel.path == "rotation", value.data());
      if (channel.path == "rotation") {
        out.motion.rotation(joint).set(t, normalized(Quat{value[0], value[1], value[2], value[3]}));
      } else if (channel.path == "translation" && translates[joint]) {
        out.motion.translation(joint).set(t,
                                          nodes.scale_of_parent[joint] * Vec3{value[0], value[1], value[2]});
      } else if (channel.path == "scale" && scaled.empty()) {
        const Vec3 rest = nodes.local[channel.node].scale;
        if (norm(Vec3{value[0], value[1], value[2]} - rest) > 1e-3 * norm(rest))
          scaled = skeleton.joints[joint].name;
      }
    }
    if (channel.path == "rotation") {
      const auto track = out.motion.rotation(joint);
      make_continuous(track.x, track.y, track.z, track.w);
    }
  }
  if (!scaled.empty())
    work.report(warning("scale-animation", "scales that vary over time are left out, first of " + scaled)
                    .at_joint(scaled));
  return out;
}

}  // namespace kinegraph
