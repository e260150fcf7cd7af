#include "nodes/judge/file_facts.h"

#include <fmt/format.h>

#include <algorithm>

#include "nodes/feet/detect_contacts.h"
#include "nodes/files/acclaim_skeleton.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/rest_frame.h"
#include "nodes/judge/other_programs.h"
#include "nodes/motion/body.h"
#include "nodes/motion/character.h"
#include "nodes/motion/fill_gaps.h"
#include "nodes/motion/kinematics.h"
#include "nodes/time/trim.h"

namespace kinegraph {

namespace {

std::vector<std::vector<std::string>> layout_of(const MotionFile& file, const std::string& path,
                                                FileAccess& files) {
  std::vector<std::vector<std::string>> layout;
  if (file.format == "asf-amc") {
    Alone quiet;
    const FileBytes asf = files.read(file.companions.empty() ? path : file.companions.front());
    for (const AcclaimBone& bone : read_asf(*asf, quiet).bones) layout.push_back(bone.dof);
  } else {
    for (const BvhJoint& joint : file.motion()->source().bvh) layout.push_back(joint.channels);
  }
  return layout;
}

std::vector<std::string> channels_together(const Motion& motion,
                                           const std::vector<std::vector<std::string>>& of_joints) {
  struct Layout {
    std::string channels;
    std::vector<std::string> joints;
  };
  std::vector<Layout> layouts;
  for (std::size_t j = 0; j < of_joints.size(); ++j) {
    const auto& channels = of_joints[j];
    std::string text = fmt::format("{}", channels.size());
    for (const std::string& channel : channels) text += ' ' + channel;
    auto same =
        std::find_if(layouts.begin(), layouts.end(), [&](const Layout& one) { return one.channels == text; });
    if (same == layouts.end()) same = layouts.insert(layouts.end(), {text, {}});
    same->joints.push_back(motion.skeleton().joints[j].name);
  }
  std::vector<std::string> texts;
  for (const Layout& layout : layouts)
    texts.push_back(
        layout.channels + ": " +
        (layout.joints.size() > 4 ? fmt::format("{} joints", layout.joints.size()) : some_of(layout.joints)));
  return texts;
}

std::string unit_from(const std::string& format, const Diagnostics& told) {
  for (const Diagnostic& one : told)
    if (one.code == "unit-found") return "found by the figure's height, as the file doesn't say";
  if (format == "asf-amc") return "as :units says";
  if (format == "gltf") return "as glTF has it";
  if (format == "c3d") return "as POINT:UNITS says";
  if (format == "trc") return "as Units says";
  if (format == "fbx") return "as UnitScaleFactor says";
  if (format == "csv") return "taken as metres, as a table doesn't say";
  return "";
}

double height_in(const Motion& motion, std::size_t frame) {
  if (frame >= motion.frames()) return 0;
  const Pose pose = pose_at(motion, frame);
  double low = 1e300, high = -1e300;
  auto see = [&](Vec3 p) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  };
  for (Vec3 p : pose.positions) see(p);
  for (const EndSite& end : motion.skeleton().ends)
    see(pose.positions[end.joint] +
        rotate(pose.orientations[end.joint], motion.skeleton().above_scale * end.offset));
  return high > low ? high - low : 0;
}

// Of the hips: some rigs keep their root where it is.
double travel_of(const Motion& motion, std::size_t first) {
  const WorldMotion world = world_motion(motion);
  const int joint = std::max(0, find_body(motion.skeleton()).pelvis);
  double sum = 0;
  for (std::size_t t = first + 1; t < motion.frames() && world.joints() > 0; ++t) {
    Vec3 step = world.position(joint)[t] - world.position(joint)[t - 1];
    step.y = 0;
    sum += norm(step);
  }
  return sum;
}

MotionFacts motion_facts(const Motion& motion, Work& work) {
  MotionFacts facts;
  facts.rest_height = rest_height(motion.skeleton());
  facts.leg_length = leg_length(motion.skeleton());
  facts.rest_frame = starts_with_rest_frame(motion);
  const std::size_t first = facts.rest_frame ? 1 : 0;
  facts.first_height = height_in(motion, first);
  facts.travel = travel_of(motion, first);
  for (int j = 1; j < motion.joints(); ++j)
    if (motion.translates(j)) facts.translating.push_back(motion.skeleton().joints[j].name);
  if (motion.frames() < first + 4) return facts;
  try {
    Alone quiet;
    facts.contacts = detect_contacts(first ? trimmed(motion, {first, motion.frames()}) : motion, {}, quiet);
  } catch (const Failure& failure) {
    if (failure.diagnostic().code != "no-feet") throw;
  }
  work.check();
  return facts;
}

PointsFacts points_facts(const Points& points) {
  PointsFacts facts;
  facts.gaps.resize(points.labels.size());
  const auto filled = static_cast<std::size_t>(ReadOptions{}.max_gap);
  for (int label = 0; label < static_cast<int>(points.labels.size()); ++label)
    for (const Gap& gap : gaps_of(points, label)) {
      const std::size_t length = gap.last - gap.first;
      facts.gaps[label] += length;
      facts.missing += length;
      if (length <= filled && gap.first > 0 && gap.last < points.frames) facts.short_gaps += length;
      if (length <= facts.longest) continue;
      facts.longest = length;
      facts.longest_at = gap.first;
      facts.longest_label = label;
    }
  for (std::size_t t = 0; t < points.frames; ++t) {
    double low = 0, high = 0;
    bool any = false, whole = true;
    for (int label = 0; label < static_cast<int>(points.labels.size()); ++label) {
      if (points.is_missing(label, t)) {
        whole = false;
        continue;
      }
      const double y = points.track(label)[t].y;
      low = any ? std::min(low, y) : y;
      high = any ? std::max(high, y) : y;
      any = true;
    }
    facts.height = std::max(facts.height, high - low);
    facts.whole_frames += whole;
  }
  return facts;
}

GltfInventory inventory_of(const Character& character) {
  GltfInventory out;
  for (const Skin& skin : character.skins)
    out.skins.push_back(
        {skin.name.empty() ? fmt::format("{}", out.skins.size()) : skin.name, skin.joints.size()});
  for (const MeshPart& part : character.parts)
    out.meshes.push_back(
        {part.name, 1, part.vertices(), part.triangles.size() / 3, part.morphs.size(), part.skin >= 0});
  return out;
}

// Of a figure with legs that is no person's size in the unit that its file says.
std::optional<Diagnostic> odd_size(const FileFacts& facts) {
  const double height = std::max(facts.motion->rest_height, facts.motion->first_height);
  const bool odd = height > 4 || (height > 0 && height < 0.4);
  const bool lies = std::any_of(facts.told.begin(), facts.told.end(),
                                [](const Diagnostic& one) { return one.code == "up-axis"; });
  if (facts.motion->leg_length <= 0 || !odd || lies) return {};
  const LengthUnit other = unit_by_height(height / facts.unit);
  if (other.metres == facts.unit) return {};
  return info("odd-size", fmt::format("the figure is {:.3g} m high, which is no person's size; taken as {} "
                                      "it would be {:.3g} m",
                                      height, to_text(other), height / facts.unit * other.metres))
      .hinting("where it is a person, tell it by Load's unit or convert's --unit")
      .at_param("unit");
}

Diagnostics of_gltf(const GltfInventory& gltf) {
  Diagnostics found;
  if (gltf.uneven_vertices)
    found.push_back(warning("uneven-weights", fmt::format("the weights of {} vertices don't sum to 1, by up "
                                                          "to {:.2g}: Khronos' validator refuses them",
                                                          gltf.uneven_vertices, gltf.uneven_most))
                        .hinting("Export's repair mends them"));
  if (!gltf.skinned_below.empty())
    found.push_back(warning("skinned-below",
                            "skinned meshes hang below other nodes, whose place programs "
                            "must ignore and some don't: " +
                                some_of(gltf.skinned_below))
                        .hinting("Export's repair puts them at the root"));
  return found;
}

}  // namespace

FileFacts facts_of(const MotionFile& file, const std::string& path, FileAccess& files, Diagnostics told,
                   Work& work) {
  FileFacts facts;
  facts.format = file.format;
  facts.ports = file.ports();
  // Told here in another way: all gaps, all clips.
  std::erase_if(told, [&](const Diagnostic& one) {
    return one.code == "long-gap" || (one.code == "clips" && file.format == "gltf");
  });
  facts.told = std::move(told);
  if (const Motion* motion = file.motion()) {
    facts.frames = motion->frames();
    facts.fps = motion->fps();
    facts.unit = motion->source().unit;
    facts.unit_name = motion->source().unit_name;
    facts.up = motion->source().up == UpAxis::y ? "Y" : "Z";
    facts.motion = motion_facts(*motion, work);
    facts.motion->layout = layout_of(file, path, files);
    facts.motion->channels = channels_together(*motion, facts.motion->layout);
    facts.breaks = breaks_of(*motion, facts.motion->rest_frame ? 1 : 0, work);
    for (Diagnostic& one : for_other_programs(*motion)) facts.told.push_back(std::move(one));
  } else if (const Points* points = file.points()) {
    facts.frames = points->frames;
    facts.fps = points->fps;
    facts.unit = points->unit;
    facts.unit_name = points->unit_name;
    facts.up = points->up == UpAxis::y ? "Y" : "Z";
    facts.points = points_facts(*points);
    facts.breaks = breaks_of(*points, work);
    for (Diagnostic& one : for_other_programs(*points)) facts.told.push_back(std::move(one));
  }
  if (facts.motion)
    if (auto odd = odd_size(facts)) facts.told.push_back(std::move(*odd));
  if (facts.fps > 0) facts.seconds = static_cast<double>(facts.frames) / facts.fps;
  facts.unit_from = unit_from(file.format, facts.told);
  for (const FileContent& content : file.contents)
    if (const auto bad = content.value->non_finite()) {
      Diagnostic problem = warning("not-finite", bad->what + " holds numbers that are not finite");
      problem.joint = bad->joint;
      problem.frame = bad->frame;
      facts.told.push_back(std::move(problem));
      ++facts.non_finite;
    }
  if (const auto* character = dynamic_cast<const Character*>(file.find("character"))) {
    facts.gltf = inventory_of(*character);
    for (Diagnostic& one : for_other_programs(*character)) facts.told.push_back(std::move(one));
  }
  if (file.format == "gltf") {
    facts.gltf = gltf_inventory(*files.read(path), path, files);
    for (Diagnostic& one : of_gltf(*facts.gltf)) facts.told.push_back(std::move(one));
  }
  return facts;
}

}  // namespace kinegraph
