#include "nodes/time/time_warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "nodes/motion/kinematics.h"
#include "nodes/node_params.h"
#include "nodes/time/features.h"
#include "nodes/time/iterative_motion_warp.h"
#include "nodes/time/unwarp_time.h"

namespace kinegraph {
namespace {

void check_has_frames(const Motion& motion, const char* port) {
  if (motion.frames() == 0) throw Failure(error("no-frames", "the motion has no frames").at_port(port));
}

// A new clock ends the file's own angles' use as a guide for writing them back.
std::shared_ptr<const SourceFacts> facts_on_another_clock(const Motion& motion) {
  auto facts = std::make_shared<SourceFacts>(motion.source());
  facts->read.reset();
  facts->read_frames = 0;
  return facts;
}

// Every frame held about equally long: the answer where nothing tells frames apart.
WarpPath even_path(std::size_t frames, std::size_t rows) {
  WarpPath path(rows);
  for (std::size_t r = 0; r < rows; ++r) path[r] = static_cast<std::uint32_t>(r * frames / rows);
  return path;
}

template <class Values>
std::vector<typename Values::value_type> gathered(const Values& values, const WarpPath& path) {
  std::vector<typename Values::value_type> rows(path.size());
  for (std::size_t r = 0; r < path.size(); ++r) rows[r] = values[path[r]];
  return rows;
}

// One path for each of all_dofs() of `motion`, and `common` for the translations of joints. `bases`: null
// where all paths are that one.
Motion on_rows(const Motion& motion, const EncodedRoot& encoded, const WarpPath& common,
               const std::vector<const WarpPath*>& paths, const std::vector<Quat>* bases, Work& work) {
  const auto joints = static_cast<std::size_t>(motion.joints());
  const std::size_t rows = common.size();
  Motion out = motion.translates(0) ? motion.empty_like(rows) : motion.with_translation(0).empty_like(rows);
  out.set_source(facts_on_another_clock(motion));

  EncodedRoot root;
  root.fps = encoded.fps;
  const std::size_t first = common.front();
  root.start = encoded.start;
  root.start_heading = encoded.start_heading;
  if (first > 0) {  // free ends: the first row stands where its frame stood
    const Pose pose = pose_at(motion, first);
    root.start = pose.positions[0];
    root.start_heading = encoded.heading[first];
  }
  for (int axis = 0; axis < root_axes; ++axis)
    root_axis(root, axis) =
        gathered(root_axis(encoded, axis), *paths[3 * joints + static_cast<std::size_t>(axis)]);
  root.rho.resize(rows);

  const Series vectors = bases ? carried_vectors(*bases, motion, encoded, work) : Series();
  work.parallel(joints, 1 + 20'000 / rows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      work.check();
      const int joint = static_cast<int>(j);
      const ConstQuatTrack from = motion.rotation(joint);
      const QuatTrack to = out.rotation(joint);
      for (std::size_t r = 0; r < rows; ++r) {
        Quat q;
        if (bases) {
          Vec3 v;
          for (std::size_t axis = 0; axis < 3; ++axis)
            v[static_cast<int>(axis)] = vectors.at(3 * j + axis, (*paths[3 * j + axis])[r]);
          q = carried_rotation(*bases, j, v);
        } else {
          const std::size_t frame = (*paths[3 * j])[r];
          q = j == 0 ? encoded.rho[frame] : from[frame];
        }
        if (j == 0)
          root.rho[r] = q;
        else
          to.set(r, q);
      }
      if (joint == 0) continue;
      make_continuous(to.x, to.y, to.z, to.w);
      if (!motion.translates(joint)) continue;
      const ConstVec3Track offset = motion.translation(joint);
      for (std::size_t r = 0; r < rows; ++r) out.translation(joint).set(r, offset[common[r]]);
    }
  });
  decode_root(root, out);
  return out;
}

struct Paths {
  std::vector<WarpPath> paths;  // shared: one; per-dof: one a feature, then that of all other DOFs
  std::vector<Dof> dofs;        // of the source, one a path but the last
  std::vector<double> energy;
  int rounds = 0;
  bool settled = true;
};

class Finder {
 public:
  Finder(const Features& features, const TimeWarpSettings& settings, bool source_warped, Work& work)
      : features_(features),
        settings_(settings),
        warped_(source_warped ? features.source : features.reference),
        clock_(source_warped ? features.reference : features.source),
        work_(work) {
    const std::size_t most =
        settings.max_step ? settings.max_step : default_max_step(warped_.frames, clock_.frames);
    search_ = {{most, settings.free_ends}, settings.scale_smoothness, settings.offset_smoothness,
               settings.iterations,        settings.tolerance,        settings.scale_and_offset};
  }

  Paths find() {
    Paths found;
    const MotionWarpResult shared = warp(warped_, clock_);
    if (settings_.per_dof && warped_.dims > 0) {
      find_each(found);
    } else {
      found.energy = shared.energy;
      found.rounds = shared.rounds;
      found.settled = shared.settled;
    }
    found.paths.push_back(shared.path);
    if (!found.settled)
      work_.report(info("not-settled", fmt::format("the warp still moved after {} rounds", found.rounds))
                       .hinting("raise iterations to go on"));
    return found;
  }

 private:
  MotionWarpResult warp(const Series& warped, const Series& clock) {
    MotionWarpResult result = iterative_motion_warp(warped, clock, search_, work_);
    if (warped.dims == 0) result.path = even_path(warped.frames, clock.frames);
    return result;
  }

  static Series one_dim(const Series& all, std::size_t d) {
    Series one(all.frames, 1);
    std::copy(all.dim(d).begin(), all.dim(d).end(), one.values.begin());
    return one;
  }

  void find_each(Paths& found) {
    std::vector<MotionWarpResult> results(warped_.dims);
    work_.parallel(warped_.dims, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t d = begin; d < end; ++d) results[d] = warp(one_dim(warped_, d), one_dim(clock_, d));
    });
    std::size_t steps = 0;
    for (const MotionWarpResult& result : results) steps = std::max(steps, result.energy.size());
    found.energy.assign(steps, 0.0);
    for (std::size_t d = 0; d < results.size(); ++d) {
      for (std::size_t i = 0; i < steps; ++i)
        found.energy[i] += results[d].energy[std::min(i, results[d].energy.size() - 1)];
      found.rounds = std::max(found.rounds, results[d].rounds);
      found.settled = found.settled && results[d].settled;
      found.paths.push_back(std::move(results[d].path));
    }
    found.dofs = features_.dofs;
  }

  const Features& features_;
  const TimeWarpSettings& settings_;
  const Series& warped_;
  const Series& clock_;
  Work& work_;
  MotionWarpSettings search_;
};

}  // namespace

TimeWarpResult time_warp(const Motion& source, const Motion& reference, const TimeWarpSettings& settings,
                         Work& work) {
  check_has_frames(source, "source");
  check_has_frames(reference, "reference");
  const std::vector<int> partner = partners(reference.skeleton(), source.skeleton(), settings.map);
  warn_about_partners(reference.skeleton(), source.skeleton(), partner, work);
  const std::vector<bool> chosen = chosen_dofs(settings.features, source.skeleton(), "features", work);

  TimeWarpResult result;
  Warp& warp = result.warp;
  warp.identity = false;
  warp.source_warped = source.frames() < reference.frames();
  warp.fps = source.fps();
  warp.source_frames = static_cast<std::uint32_t>(source.frames());
  warp.reference_frames = static_cast<std::uint32_t>(reference.frames());

  const std::size_t numbers =
      (source.frames() + reference.frames()) * 3 * static_cast<std::size_t>(source.joints());
  const auto reserved = numbers > (1u << 20) ? work.reserve(6 * sizeof(double) * numbers) : nullptr;
  const EncodedRoot source_root = encode_root(source, work), reference_root = encode_root(reference, work);
  RotationVectors source_vectors = rotation_vectors(source, source_root, work);
  RotationVectors reference_vectors = rotation_vectors(reference, reference_root, work);
  Paths found;
  {
    const Features features =
        features_of(source_vectors, source_root, reference_vectors, reference_root, partner, chosen, work);
    if (std::find(chosen.begin(), chosen.end(), true) == chosen.end())
      throw Failure(error("no-features", "the pattern chooses nothing to compare").at_param("features"));
    if (features.dofs.empty())
      work.report(
          warning("nothing-moves", "none of the features moves in either motion: frames are spread evenly")
              .at_param("features"));
    if (!settings.per_dof) source_vectors = reference_vectors = {};
    found = Finder(features, settings, warp.source_warped, work).find();
  }
  warp.paths = std::move(found.paths);
  warp.energy = std::move(found.energy);
  warp.rounds = found.rounds;

  const bool per_dof = warp.paths.size() > 1;
  if (per_dof) {
    for (const Dof& dof : found.dofs) warp.dofs.push_back(name_of(dof, source.skeleton()));
    warp.dofs.push_back("*");
    for (const Quat& mean : bases_of(source_vectors, source.skeleton()))
      warp.means.insert(warp.means.end(), {mean.x, mean.y, mean.z, mean.w});
  }

  // Which path each DOF of the motion that moves follows; the reference's joints by their partners.
  const Motion& moved = warp.source_warped ? source : reference;
  const auto dofs = all_dofs(moved.skeleton());
  std::vector<const WarpPath*> paths(dofs.size(), &warp.paths.back());
  for (std::size_t k = 0; k < found.dofs.size() && per_dof; ++k) {
    const Dof dof = found.dofs[k];
    const int joint = warp.source_warped || dof.joint < 0 ? dof.joint : partner[dof.joint];
    const int at = joint < 0 ? 3 * moved.joints() + dof.axis : 3 * joint + dof.axis;
    paths[static_cast<std::size_t>(at)] = &warp.paths[k];
  }
  std::vector<Quat> bases;
  if (per_dof) bases = bases_of(warp.source_warped ? source_vectors : reference_vectors, moved.skeleton());
  if (warp.source_warped) {
    result.warped = on_rows(source, source_root, warp.paths.back(), paths, per_dof ? &bases : nullptr, work);
    warp.skipped = skipped_frames(source, source_root, *result.warped, warp, work);
  } else {
    result.reference =
        on_rows(reference, reference_root, warp.paths.back(), paths, per_dof ? &bases : nullptr, work);
  }
  return result;
}

}  // namespace kinegraph
