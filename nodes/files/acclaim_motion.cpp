#include "nodes/files/acclaim_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "nodes/files/acclaim_values.h"
#include "nodes/files/channel_rotations.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/rest_frame.h"
#include "nodes/files/up_axis.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// Joints at the bones' starts; lengths times `scale`.
std::shared_ptr<Skeleton> skeleton_of(const AcclaimSkeleton& file, double scale, UpAxis up) {
  auto skeleton = std::make_shared<Skeleton>();
  std::vector<bool> is_parent(file.bones.size());
  for (const AcclaimBone& bone : file.bones) {
    const Vec3 start = bone.parent < 0 ? file.root_position : file.bones[bone.parent].tip;
    skeleton->joints.push_back({bone.name, bone.parent, scale * y_up(start, up), {}});
    if (bone.parent >= 0) is_parent[bone.parent] = true;
  }
  for (std::size_t b = 0; b < file.bones.size(); ++b)
    if (!is_parent[b])
      skeleton->ends.push_back({static_cast<int>(b), scale * y_up(file.bones[b].tip, up), {}});
  return skeleton;
}

LengthUnit find_unit(const AcclaimSkeleton& file, UpAxis up, const ReadOptions& options, Work& work) {
  if (names_a_unit(options.unit)) return unit_from_param(options.unit, {});
  if (file.metres > 0) return unit_of_metres(file.metres);
  const double height = rest_height(*skeleton_of(file, 1, up));
  const LengthUnit unit = unit_by_height(height);
  work.report(
      info("unit-found", fmt::format("unit {}: the .asf says none, and the rest pose is {:.4g} units high",
                                     to_text(unit), height))
          .hinting("where that is wrong, tell it by Load's unit or convert's --unit")
          .at_param("unit"));
  return unit;
}

void read_joint(const AcclaimBone& bone, Vec3 offset, const AcclaimValues& values, const double* series,
                double scale, UpAxis up, int joint, Motion& motion) {
  std::string axes;
  std::vector<const double*> angles;
  std::array<const double*, 3> moves{};
  for (std::size_t i = 0; i < bone.dof.size(); ++i) {
    const double* value = series + i * values.frames;
    if (bone.dof[i][0] == 't') moves[bone.dof[i][1] - 'x'] = value;
    if (bone.dof[i][0] != 'r') continue;
    // Turned about first stands last in the product.
    axes.insert(axes.begin(), static_cast<char>(bone.dof[i][1] - 32));
    angles.insert(angles.begin(), value);
  }
  std::vector<std::vector<double>> converted;
  if (!values.degrees)
    for (const double*& angle : angles) {
      converted.emplace_back(angle, angle + values.frames);
      for (double& value : converted.back()) value *= degrees_per_radian;
      angle = converted.back().data();
    }
  auto q = motion.rotation(joint);
  if (!axes.empty()) {
    rotations_from_degrees(axes, angles, q);
    conjugate_by(bone.axis, q);
    make_track_continuous(q);
    if (up == UpAxis::z)
      for (std::size_t t = 0; t < values.frames; ++t) q.set(t, y_up(q[t], up));
  }
  if (!motion.translates(joint)) return;
  auto place = motion.translation(joint);
  for (std::size_t t = 0; t < values.frames; ++t) {
    Vec3 move;
    for (int axis = 0; axis < 3; ++axis)
      if (moves[axis]) move[axis] = moves[axis][t];
    if (joint > 0) move = rotate(bone.axis, move);
    place.set(t, scale * y_up(offset + move, up));
  }
}

}  // namespace

Motion acclaim_motion(const AcclaimSkeleton& file, std::string_view amc, const ReadOptions& options,
                      Work& work) {
  const UpAxis up = options.up == "z" ? UpAxis::z : UpAxis::y;
  const LengthUnit unit = find_unit(file, up, options, work);
  auto skeleton = skeleton_of(file, unit.metres, up);
  auto facts = std::make_shared<SourceFacts>();
  facts->format = "asf-amc";
  facts->unit = unit.metres;
  facts->unit_name = unit.name;
  facts->up = up;

  AcclaimValues values;
  if (!amc.empty()) values = read_amc_values(amc, file, options, work);
  std::vector<bool> translates;
  std::string stretching;
  for (const AcclaimBone& bone : file.bones) {
    translates.push_back(
        std::any_of(bone.dof.begin(), bone.dof.end(), [](const std::string& dof) { return dof[0] == 't'; }));
    if (std::find(bone.dof.begin(), bone.dof.end(), "l") != bone.dof.end())
      stretching += (stretching.empty() ? "" : ", ") + bone.name;
  }
  if (!stretching.empty())
    work.report(warning("bone-lengths-left-out", "lengths that vary (dof l) are left out: " + stretching));

  Motion motion(skeleton, facts, options.rate, values.frames, translates);
  const double* series = values.series.data();
  for (std::size_t b = 0; b < file.bones.size() && values.frames > 0; ++b) {
    const AcclaimBone& bone = file.bones[b];
    const Vec3 offset = bone.parent < 0 ? file.root_position : file.bones[bone.parent].tip;
    read_joint(bone, offset, values, series, unit.metres, up, static_cast<int>(b), motion);
    series += bone.dof.size() * values.frames;
    work.check();
  }
  if (values.frames == 0) work.report(warning("no-frames", "the file has a skeleton and no frames"));
  warn_about_rest_frame(motion, values.first, work);
  return motion;
}

std::string find_asf(const std::string& amc_path, FileAccess& files) {
  const auto slash = amc_path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "." : amc_path.substr(0, slash);
  const std::string file = slash == std::string::npos ? amc_path : amc_path.substr(slash + 1);
  const std::string stem = file.substr(0, file.find_last_of('.'));
  std::vector<std::string> names = {stem + ".asf"};
  if (auto cut = stem.find_last_of('_'); cut != std::string::npos)
    names.push_back(stem.substr(0, cut) + ".asf");
  for (const std::string& name : names)
    if (files.exists(folder + "/" + name)) return folder + "/" + name;
  std::vector<std::string> in_folder;
  for (const std::string& name : files.list(folder))
    if (name.size() > 4 && (name.substr(name.size() - 4) == ".asf" || name.substr(name.size() - 4) == ".ASF"))
      in_folder.push_back(name);
  if (in_folder.size() == 1) return folder + "/" + in_folder[0];
  std::string tried;
  for (const std::string& name : names) tried += name + ", ";
  throw Failure(error("missing-skeleton",
                      fmt::format("no .asf for {}: tried {}and the folder's only .asf, but it has {}", file,
                                  tried, in_folder.empty() ? "none" : fmt::format("{}", in_folder.size())))
                    .hinting("put the .asf beside it, or name it by Load's skeleton")
                    .at_param("skeleton"));
}

}  // namespace kinegraph
