#include "nodes/components/alignment.h"

#include <algorithm>
#include <cmath>

#include "nodes/components/component_ref.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/joint_pattern.h"
#include "nodes/time/features.h"
#include "nodes/time/frame_times.h"
#include "nodes/time/lowpass.h"

namespace kinegraph {
namespace {

// Dimensions of both series, collected one after another.
class Pairs {
 public:
  Pairs(std::size_t a_frames, std::size_t b_frames) : a_frames_(a_frames), b_frames_(b_frames) {}
  void add(const std::vector<double>& a, const std::vector<double>& b) {
    a_.insert(a_.end(), a.begin(), a.end());
    b_.insert(b_.end(), b.begin(), b.end());
    ++dims_;
  }
  Series a() const { return series(a_, a_frames_); }
  Series b() const { return series(b_, b_frames_); }
  std::size_t dims() const { return dims_; }
  std::vector<double> all() const {
    std::vector<double> out = a_;
    out.insert(out.end(), b_.begin(), b_.end());
    return out;
  }

 private:
  Series series(const std::vector<double>& values, std::size_t frames) const {
    Series out(frames, dims_);
    out.values = values;
    return out;
  }
  std::size_t a_frames_, b_frames_, dims_ = 0;
  std::vector<double> a_, b_;
};

std::vector<double> about_mean(const double* values, std::size_t count) {
  double mean = 0;
  for (std::size_t t = 0; t < count; ++t) mean += values[t];
  mean /= static_cast<double>(count);
  std::vector<double> out(count);
  for (std::size_t t = 0; t < count; ++t) out[t] = values[t] - mean;
  return out;
}
double sum_of_squares(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v * v;
  return sum;
}

// What is no JOINT.x, JOINT.y or JOINT.z.
Failure bad_dof(std::string_view dof, std::string_view joint, std::string_view param) {
  const std::string name(joint);
  return Failure(error("bad-align", "\"" + std::string(dof) + "\" is no degree of freedom")
                     .at_param(std::string(param))
                     .at_joint(name)
                     .hinting("'" + name + "' has " + name + ".x, " + name + ".y and " + name + ".z"));
}

Failure bad_align(std::string_view entry, std::string_view param) {
  return Failure(error("bad-align", "\"" + std::string(entry) + "\" says nothing to align by")
                     .at_param(std::string(param))
                     .hinting("write u1, group:NAME, joint:PATTERN or dof:JOINT.x"));
}

// An entry of `align`, read.
struct AlignedBy {
  enum Kind { component, joints, dof } kind = joints;
  ComponentRef ref;
  std::string pattern;
};
std::vector<AlignedBy> read_entries(const Components& components, const ComponentSegment& a,
                                    const std::vector<std::string>& align_by, std::string_view param) {
  std::vector<AlignedBy> out;
  if (align_by.empty() && a.motion) out.push_back({AlignedBy::joints, {}, "*"});
  for (std::size_t i = 0; align_by.empty() && !a.motion && i < components.count(); ++i)
    out.push_back({AlignedBy::component, {static_cast<int>(i + 1), {}}, {}});
  for (const std::string& entry : align_by) {
    const auto colon = entry.find(':');
    const std::string kind = entry.substr(0, colon),
                      rest = colon == entry.npos ? "" : entry.substr(colon + 1);
    const ComponentRef ref = component_ref(Json(entry));
    if (colon == entry.npos && ref.component > 0)
      out.push_back({AlignedBy::component, ref, {}});
    else if (kind == "group" && colon != entry.npos)
      out.push_back({AlignedBy::component, {0, rest}, {}});
    else if (kind == "joint" && colon != entry.npos)
      out.push_back({AlignedBy::joints, {}, rest});
    else if (kind == "dof" && colon != entry.npos)
      out.push_back({AlignedBy::dof, {}, rest});
    else
      throw bad_align(entry, param);
  }
  return out;
}

std::shared_ptr<const Value> clip_of(const ComponentSegment& segment) {
  if (segment.motion) return segment.motion;
  return segment.points;
}

void add_component(Pairs& pairs, const Components& components, const ComponentSegment& a,
                   const ComponentSegment& b, const ComponentRef& ref, std::string_view param) {
  for (const ComponentTerm& term : terms_of(ref, components.count(), components.groups, param)) {
    const double* u = components.signals.row(term.index);
    pairs.add(about_mean(u + a.start, a.frames()), about_mean(u + b.start, b.frames()));
  }
}

class Collector {
 public:
  Collector(const Components& components, const ComponentSegment& a, const ComponentSegment& b,
            std::string_view param, Work& work)
      : components_(components), a_(a), b_(b), param_(param), work_(work), pairs_(a.frames(), b.frames()) {}

  void component(const ComponentRef& ref) { add_component(pairs_, components_, a_, b_, ref, param_); }
  // `dof`: a single one, named JOINT.axis.
  void joints(std::string_view pattern, bool dof) {
    if (a_.motion)
      of_motions(pattern, dof);
    else
      of_points(pattern, dof);
  }
  const Pairs& pairs() const { return pairs_; }

 private:
  void of_motions(std::string_view pattern, bool dof) {
    const Skeleton& skeleton = a_.motion->skeleton();
    std::vector<bool> chosen;
    if (dof) {
      const auto dot = pattern.rfind('.');
      const std::string joint(pattern.substr(0, dot));
      const auto dofs = all_dofs(skeleton);
      if (pattern != "root" && pattern.find(',') == pattern.npos &&
          std::none_of(dofs.begin(), dofs.end(),
                       [&](const Dof& one) { return name_of(one, skeleton) == pattern; })) {
        if (skeleton.find(joint) < 0) chosen_joints(joint, skeleton, param_, work_);  // throws, with its hint
        throw bad_dof(pattern, joint, param_);
      }
      chosen = chosen_dofs(pattern, skeleton, param_, work_);
    } else {
      for (bool joint : chosen_joints(pattern, skeleton, param_, work_))
        chosen.insert(chosen.end(), 3, joint);
      chosen.insert(chosen.end(), root_axes, false);
    }
    const auto partner = joints_of_b();
    const EncodedRoot root_a = encode_root(*a_.motion, work_), root_b = encode_root(*b_.motion, work_);
    const Features features =
        features_of(rotation_vectors(*a_.motion, root_a, work_), root_a,
                    rotation_vectors(*b_.motion, root_b, work_), root_b, partner, chosen, work_);
    for (std::size_t d = 0; d < features.dofs.size(); ++d) {
      const auto s = features.source.dim(d), r = features.reference.dim(d);
      pairs_.add({s.begin(), s.end()}, {r.begin(), r.end()});
    }
  }
  // For each joint of a's motion that of b's: by name, and as the components' map says.
  std::vector<int> joints_of_b() const {
    const Skeleton &a = a_.motion->skeleton(), &b = b_.motion->skeleton();
    std::vector<int> partner = partners(b, a, {});
    const auto in_a = joints_of(components_.space, a), in_b = joints_of(components_.space, b);
    for (std::size_t s = 0; s < in_a.size(); ++s)
      if (in_a[s] >= 0 && in_b[s] >= 0) partner[static_cast<std::size_t>(in_a[s])] = in_b[s];
    return partner;
  }
  void of_points(std::string_view pattern, bool dof) {
    int only = -1;
    if (dof) {
      const auto dot = pattern.rfind('.');
      const std::string label(pattern.substr(0, dot));
      chosen_names(label, components_.space.labels, param_,
                   work_);  // throws where there is none, with its hint
      if (dot == pattern.npos || dot + 2 != pattern.size()) throw bad_dof(pattern, label, param_);
      only = pattern.back() - 'x';
      if (only < 0 || only > 2) throw bad_dof(pattern, label, param_);
      pattern.remove_suffix(2);
    }
    const auto chosen = chosen_names(pattern, components_.space.labels, param_, work_);
    const Rows a = channels_of(components_.space, *a_.points, work_),
               b = channels_of(components_.space, *b_.points, work_);
    for (std::size_t d = 0; d < a.rows; ++d) {
      if (!chosen[d / 3] || (only >= 0 && static_cast<int>(d % 3) != only)) continue;
      auto from = about_mean(a.row(d), a.columns), to = about_mean(b.row(d), b.columns);
      const double spread =
          std::sqrt((sum_of_squares(from) + sum_of_squares(to)) / static_cast<double>(a.columns + b.columns));
      if (spread < 1e-6) continue;
      for (double& x : from) x /= spread;
      for (double& x : to) x /= spread;
      pairs_.add(from, to);
    }
  }

  const Components& components_;
  const ComponentSegment &a_, &b_;
  std::string_view param_;
  Work& work_;
  Pairs pairs_;
};

// The other way round: knots (at[i], i) joined by straight lines, at whole numbers; the ends held.
std::vector<double> inverted(const std::vector<double>& at, std::size_t count) {
  std::vector<double> out(count);
  std::size_t i = 0;
  for (std::size_t t = 0; t < count; ++t) {
    const auto x = static_cast<double>(t);
    while (i + 1 < at.size() && at[i + 1] < x) ++i;
    if (x <= at.front())
      out[t] = 0;
    else if (i + 1 >= at.size())
      out[t] = static_cast<double>(at.size() - 1);
    else
      out[t] = static_cast<double>(i) + (at[i + 1] > at[i] ? (x - at[i]) / (at[i + 1] - at[i]) : 0);
  }
  return out;
}

// Times stay in order and inside the clip.
void smooth_times(std::vector<double>& times, std::size_t frames, double fps, double cutoff) {
  if (cutoff > 0 && times.size() > 1) times = lowpass(times, fps, cutoff);
  double least = 0;
  for (double& time : times) {
    time = std::min(std::max(time, least), static_cast<double>(frames - 1));
    least = time;
  }
}

struct Between {
  std::size_t low, high;
  double part;
};
Between between(double time, std::size_t frames) {
  const auto low = std::min(static_cast<std::size_t>(std::max(time, 0.0)), frames - 1);
  const auto high = std::min(low + 1, frames - 1);
  return {low, high, std::clamp(time - static_cast<double>(low), 0.0, 1.0)};
}

}  // namespace

Correspondence aligned_segments(const Components& components, const ComponentSegment& a,
                                const ComponentSegment& b, const std::vector<std::string>& align_by,
                                std::string_view param, Work& work) {
  if (a.frames() == 0 || b.frames() == 0)
    throw Failure(
        error("no-frames", "a segment without frames can't be aligned").at_param(std::string(param)));
  const std::vector<AlignedBy> entries = read_entries(components, a, align_by, param);
  AlignmentKey key{{clip_of(a)}, {clip_of(b)}, align_by, std::string(param), {}};
  Pairs signals(a.frames(), b.frames());
  for (const AlignedBy& entry : entries)
    if (entry.kind == AlignedBy::component) add_component(signals, components, a, b, entry.ref, param);
  key.signals = signals.all();
  const auto find = [&](Work& part) {
    Collector collector(components, a, b, param, part);
    for (const AlignedBy& entry : entries) {
      if (entry.kind == AlignedBy::component)
        collector.component(entry.ref);
      else
        collector.joints(entry.pattern, entry.kind == AlignedBy::dof);
    }
    if (collector.pairs().dims() == 0)
      throw Failure(
          error("no-features", "nothing that moves is chosen to align by").at_param(std::string(param)));
    return align(collector.pairs().a(), collector.pairs().b(), 0, false, part);
  };
  return *components.memory->alignments.get(key, find, work);
}

ClockMaps clock_maps(const Correspondence& path, std::size_t a_frames, std::size_t b_frames, double fps,
                     double lowpass_cutoff) {
  std::vector<std::uint32_t> shown;  // of the shorter one, at every frame of the longer
  for (const auto& [a, b] : path.pairs) shown.push_back(path.a_is_clock ? b : a);
  const FrameTimes times = frame_times(shown, path.a_is_clock ? b_frames : a_frames);
  ClockMaps maps;
  maps.a_of_b = path.a_is_clock ? times.row : inverted(times.row, b_frames);
  maps.b_of_a = path.a_is_clock ? inverted(times.row, a_frames) : times.row;
  smooth_times(maps.a_of_b, a_frames, fps, lowpass_cutoff);
  smooth_times(maps.b_of_a, b_frames, fps, lowpass_cutoff);
  return maps;
}

Rows at_times(const Rows& rows, const std::vector<double>& times) {
  Rows out(rows.rows, times.size());
  for (std::size_t t = 0; t < times.size(); ++t) {
    const Between at = between(times[t], rows.columns);
    for (std::size_t i = 0; i < rows.rows; ++i)
      out(i, t) = rows(i, at.low) + at.part * (rows(i, at.high) - rows(i, at.low));
  }
  return out;
}

Motion at_times(const Motion& motion, const std::vector<double>& times) {
  Motion out = motion.empty_like(times.size());
  out.set_source(without_read(motion.shared_source()));  // those angles belong to the old clock
  for (int j = 0; j < motion.joints(); ++j) {
    const auto from = motion.rotation(j);
    const auto to = out.rotation(j);
    for (std::size_t t = 0; t < times.size(); ++t) {
      const Between at = between(times[t], motion.frames());
      to.set(t, slerp(at.part, from[at.low], from[at.high]));
      if (!motion.translates(j)) continue;
      const auto place = motion.translation(j);
      out.translation(j).set(t, place[at.low] + at.part * (place[at.high] - place[at.low]));
    }
    make_continuous(to.x, to.y, to.z, to.w);
  }
  return out;
}

Points at_times(const Points& points, const std::vector<double>& times) {
  Points out(points.labels, points.fps, times.size());
  out.unit = points.unit;
  out.unit_name = points.unit_name;
  out.up = points.up;
  out.links = points.links;
  for (int i = 0; i < static_cast<int>(points.labels.size()); ++i) {
    const auto from = points.track(i);
    for (std::size_t t = 0; t < times.size(); ++t) {
      const Between at = between(times[t], points.frames);
      out.track(i).set(t, from[at.low] + at.part * (from[at.high] - from[at.low]));
      if (points.is_missing(i, at.low) || points.is_missing(i, at.high)) out.set_missing(i, t);
    }
  }
  return out;
}

}  // namespace kinegraph
