#include "nodes/cartoon/exaggerate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "nodes/cartoon/link_flips.h"
#include "nodes/cartoon/link_turns.h"
#include "nodes/cartoon/world_to_local.h"
#include "nodes/motion/elementary.h"
#include "nodes/node_params.h"
#include "nodes/time/gaussian.h"

namespace kinegraph {
namespace {

constexpr double longest_told = 3, shortest_told = 1.0 / 3;  // |w| / |v| beyond which a link is warned about
constexpr double least_told = 1.005;       // below it no link is named: it has "1.00 times its length"
constexpr double soft_seconds = 1 / 60.0;  // a flip's turn starts and ends in about that
constexpr double most_turn_a_second = 30 * 120 / degrees_per_radian;  // of a link, if the input's turns less
constexpr double least_sigma = 1e-3;  // of a frame: below it the average is the joint

// How far each joint is ahead of its average, j − a; the exaggerated joint is j + (ω − 1)(j − a).
WorldMotion ahead_of_average(const Motion& motion, const WorldMotion& world, double sigma, bool keep_root,
                             Work& work) {
  WorldMotion ahead(world.joints(), world.frames(), world.scale());
  const double in_frames = sigma * motion.fps();
  if (!(in_frames > least_sigma)) return ahead;
  const Gaussian gaussian(in_frames, world.frames());
  const auto root = world.position(0);
  work.parallel(static_cast<std::size_t>(world.joints()), 4, [&](std::size_t begin, std::size_t end) {
    std::vector<double> series(world.frames());
    for (std::size_t j = begin; j < end; ++j) {
      const auto at = world.position(static_cast<int>(j));
      const auto out = ahead.position(static_cast<int>(j));
      const auto one = [&](std::span<const double> from, std::span<const double> base, std::span<double> to) {
        work.check();
        for (std::size_t t = 0; t < from.size(); ++t) to[t] = keep_root ? from[t] - base[t] : from[t];
        std::copy(to.begin(), to.end(), series.begin());
        gaussian.apply(series);
        for (std::size_t t = 0; t < from.size(); ++t) to[t] -= series[t];
      };
      one(at.x, root.x, out.x);
      one(at.y, root.y, out.y);
      one(at.z, root.z, out.z);
    }
  });
  return ahead;
}

double weight_of(const ExaggerateParams& params, int joint) {
  return params.weights.empty() ? 1 : params.weights[joint];
}

// e = j + (ω_k − 1)(j − a): the same as ω j + (1 − ω) a.
void exaggerate_positions(const Skeleton& skeleton, const std::vector<bool>& on, const WorldMotion& world,
                          const WorldMotion& ahead, const ExaggerateParams& params, double omega,
                          WorldMotion& out) {
  for (int j = 0; j < skeleton.size(); ++j) {
    const auto e = out.position(j);
    if (on[j]) {
      const auto parent = std::as_const(out).position(skeleton.joints[j].parent);
      for (std::size_t t = 0; t < world.frames(); ++t) e.set(t, parent[t]);
      continue;
    }
    const auto at = world.position(j), lead = ahead.position(j);
    const double gain = weight_of(params, j) * (omega - 1);
    for (std::size_t t = 0; t < world.frames(); ++t) e.x[t] = at.x[t] + gain * lead.x[t];
    for (std::size_t t = 0; t < world.frames(); ++t) e.y[t] = at.y[t] + gain * lead.y[t];
    for (std::size_t t = 0; t < world.frames(); ++t) e.z[t] = at.z[t] + gain * lead.z[t];
  }
}

// The 99th percentile of |w| / |v| over all links and frames.
double usual_stretch(const Skeleton& skeleton, const std::vector<double>& lengths, const WorldMotion& moved) {
  std::vector<double> ratios;
  for (int j = 1; j < skeleton.size(); ++j) {
    const auto child = moved.position(j), parent = moved.position(skeleton.joints[j].parent);
    const double* v = lengths.data() + static_cast<std::size_t>(j) * moved.frames();
    for (std::size_t t = 0; t < moved.frames(); ++t)
      if (v[t] > 0) ratios.push_back(norm(parent[t] - child[t]) / v[t]);
  }
  if (ratios.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(ratios.size() - 1));
  std::nth_element(ratios.begin(), ratios.begin() + rank, ratios.end());
  return ratios[static_cast<std::size_t>(rank)];
}

// Every |w|² is a parabola in ω whose slope at 1 is not negative, as an average of turning links is shorter
// than they are; so the stretch grows with ω.
double omega_for(double wish, const std::function<double(double)>& stretch_at) {
  double low = 1, high = 2;
  while (stretch_at(high) < wish) {
    low = high;
    high = 2 * high;
    if (high > 1e4) return 0;
  }
  for (int round = 0; round < 40 && high - low > 1e-6 * high; ++round) {
    const double middle = 0.5 * (low + high);
    (stretch_at(middle) < wish ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void tell(const Motion& motion, const ExaggerateParams& params, const ExaggerateResult& result,
          bool corrected, Work& work) {
  const auto name = [&](int joint) { return motion.skeleton().joints[joint].name; };
  const LinkStretch& stretch = result.stretch;
  if (stretch.largest_joint < 0) return;
  std::string text = fmt::format("omega {:.4g}, sigma {:.4g} s; ", result.omega, result.sigma);
  if (corrected)
    text +=
        fmt::format("{} iterations brought the error of the links from {:.4f} to {:.4f}; ",
                    result.correction.iterations, result.correction.error_before, result.correction.error);
  text += fmt::format("the longest link has {:.2f} times its length", stretch.largest);
  Diagnostic done = info("exaggerated", std::move(text));
  if (stretch.largest >= least_told) {
    done.joint = name(stretch.largest_joint);
    done.frame = static_cast<std::int64_t>(stretch.largest_frame);
  }
  work.report(std::move(done));
  if (corrected && !result.correction.met)
    work.report(warning("correction-unfinished",
                        fmt::format("after {} iterations the error is {:.4f} and the longest link has {:.2f} "
                                    "times its length",
                                    result.correction.iterations, result.correction.error, stretch.largest))
                    .at_joint(name(stretch.largest_joint))
                    .at_frame(static_cast<std::int64_t>(stretch.largest_frame))
                    .hinting(params.correction.max_link > 0
                                 ? "raise max_link, error or iterations, or lower omega"
                                 : "raise error or iterations, or lower omega"));
}

// A warning for each link that is too long or too short anywhere, at its worst frame.
void tell_of_stretched(const Skeleton& skeleton, const std::vector<double>& lengths, const WorldMotion& moved,
                       Work& work) {
  for (int j = 1; j < skeleton.size(); ++j) {
    const LinkStretch stretch = link_stretch(skeleton, lengths, moved, j);
    const auto tell_of = [&](std::string text, std::size_t frame, const char* hint) {
      work.report(warning("stretched-link", std::move(text))
                      .at_joint(skeleton.joints[j].name)
                      .at_frame(static_cast<std::int64_t>(frame))
                      .hinting(hint));
    };
    if (stretch.largest > longest_told)
      tell_of(fmt::format("the link to the joint has {:.2f} times its length", stretch.largest),
              stretch.largest_frame, "set max_link, or lower omega or error");
    if (stretch.smallest < shortest_told)
      tell_of(fmt::format("the link to the joint has only {:.2f} of its length", stretch.smallest),
              stretch.smallest_frame, "lower omega or error");
  }
}

}  // namespace

double dominant_period(const WorldMotion& world, double fps) {
  const std::size_t frames = world.frames();
  if (frames < 4) return static_cast<double>(frames) / fps;
  const std::size_t lags = frames / 2;
  std::vector<double> sum(lags + 1), speed(frames - 1);
  const auto root = world.position(0);
  for (int j = 1; j < world.joints(); ++j) {
    const auto at = world.position(j);
    double mean = 0;
    for (std::size_t t = 0; t + 1 < frames; ++t) {
      speed[t] = norm((at[t + 1] - root[t + 1]) - (at[t] - root[t]));
      mean += speed[t] / static_cast<double>(frames - 1);
    }
    for (double& s : speed) s -= mean;
    for (std::size_t lag = 0; lag <= lags; ++lag) {
      const std::size_t pairs = speed.size() - lag;
      double total = 0;
      for (std::size_t t = 0; t < pairs; ++t) total += speed[t] * speed[t + lag];
      sum[lag] += total / static_cast<double>(pairs);
    }
  }
  // The highest peak after the correlation has first fallen below zero.
  std::size_t lag = 0;
  while (lag <= lags && sum[lag] > 0) ++lag;
  std::size_t best = 0;
  for (; lag < lags; ++lag)
    if (sum[lag] > 0 && sum[lag] >= sum[lag - 1] && sum[lag] >= sum[lag + 1] &&
        (best == 0 || sum[lag] > sum[best]))
      best = lag;
  return static_cast<double>(best > 0 ? best : frames) / fps;
}

ExaggerateResult exaggerate(const Motion& motion, const ExaggerateParams& params, Work& work,
                            const MotionPart* part) {
  ExaggerateResult result;
  result.sigma = params.sigma;
  result.omega = params.omega;
  const bool wished = params.wished_stretch > 0;
  if (motion.frames() < 2 || (!wished && params.omega == 1)) {
    result.motion = motion;
    return result;
  }
  const Skeleton& skeleton = motion.skeleton();
  const std::vector<bool> on = on_parent(motion);
  const WorldMotion world = world_motion(motion, work);
  const std::vector<double> lengths = link_lengths(skeleton, on, world);
  if (wished) result.sigma = 0.25 * dominant_period(world, motion.fps());
  work.progress(0.1);
  const WorldMotion ahead = ahead_of_average(motion, world, result.sigma, params.keep_root, work);
  work.progress(0.3);
  WorldMotion moved = world;
  if (wished) {
    result.omega = omega_for(params.wished_stretch, [&](double omega) {
      work.check();
      exaggerate_positions(skeleton, on, world, ahead, params, omega, moved);
      return usual_stretch(skeleton, lengths, moved);
    });
    if (result.omega == 0) {
      work.report(warning("wish-unreached", fmt::format("no omega stretches links {:.3g} times; the motion "
                                                        "is passed on as it is",
                                                        params.wished_stretch))
                      .at_param("auto")
                      .hinting("it hardly turns, or weights leave nothing to exaggerate"));
      result.omega = 1;
      result.motion = motion;
      return result;
    }
  }
  exaggerate_positions(skeleton, on, world, ahead, params, result.omega, moved);
  work.progress(0.5);

  const bool corrected = params.correct && (!wished || params.correction.max_link > 0);
  if (corrected) {
    LinkCorrectionParams correction = params.correction;
    if (wished) correction.error = std::numeric_limits<double>::infinity();
    result.correction = correct_links(skeleton, on, lengths, correction, moved, work);
    const double times_input = std::max(result.omega, 1.0);  // RubberJoints may double it
    const double frames = soft_seconds * motion.fps();
    hold_link_flips(skeleton, lengths, world,
                    {most_turn_a_second / motion.fps(), times_input, 0.2,
                     static_cast<int>(std::min(2 * frames * frames + 0.5, 64.0))},
                    moved, work);
  }
  work.progress(0.8);
  aim_links(skeleton, links_below(motion), world, turn_limits(motion.fps()), moved, work);
  result.motion = motion_from_world(motion.shared_skeleton(), motion.shared_source(), motion.fps(),
                                    motion.translating(), moved, work);
  if (part) {
    result.motion = blended_change(motion, result.motion, part->joints, part->weights);
    moved = world_motion(result.motion, work);
  }
  result.stretch = link_stretch(skeleton, lengths, moved);
  tell(motion, params, result, corrected, work);
  tell_of_stretched(skeleton, lengths, moved, work);
  return result;
}

}  // namespace kinegraph
