#include <fmt/format.h>

#include <algorithm>

#include "nodes/files/length_unit.h"
#include "nodes/judge/analysis_facts.h"
#include "nodes/judge/file_facts.h"
#include "nodes/judge/other_programs.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

std::string line(std::string_view label, const std::string& text) {
  return fmt::format("{:<9} {}\n", label, text);
}

std::string feet_text(const Contacts& contacts) {
  std::string text;
  for (const FootPoint& point : contacts.points) {
    const auto planted = std::count(point.planted.begin(), point.planted.end(), true);
    const std::size_t plants = runs_of(point.planted).size();
    text +=
        fmt::format("{} {} {} plant{}, {:.0f} %; ", point.foot, point.part, plants, plants == 1 ? "" : "s",
                    100.0 * static_cast<double>(planted) /
                        static_cast<double>(std::max<std::size_t>(contacts.frames, 1)));
  }
  return text + fmt::format("floor at {:.3g} m", contacts.floor);
}

std::string motion_text(const Motion& motion, const MotionFacts& facts) {
  std::string height = fmt::format("{:.3g} m in the rest pose", facts.rest_height);
  if (motion.frames() > 0)
    height += fmt::format(", {:.3g} m in frame {}", facts.first_height, facts.rest_frame ? 1 : 0);
  if (facts.leg_length > 0) height += fmt::format(", legs {:.3g} m", facts.leg_length);
  std::string out = line("height", height);
  if (motion.frames() > 1) out += line("travel", fmt::format("{:.3g} m over the ground", facts.travel));
  out += line("skeleton",
              fmt::format("{} joints, {} End Sites", motion.joints(), motion.skeleton().ends.size()));
  for (const std::string& channels : facts.channels) out += line("channels", channels);
  if (!facts.translating.empty()) out += line("stretch", "the place varies of " + some_of(facts.translating));
  if (facts.contacts)
    out += line("feet", feet_text(*facts.contacts));
  else
    out += line("feet", motion.frames() < 4 ? "too few frames to tell when they are planted" : "none found");
  return out;
}

std::string points_text(const Points& points, const PointsFacts& facts) {
  std::string out = line("height", fmt::format("{:.3g} m at most", facts.height));
  out += line("points", fmt::format("{}: {}", points.labels.size(), some_of(points.labels)));
  if (facts.missing == 0) return out + line("missing", "none");
  out +=
      line("missing", fmt::format("{} of {} samples, {} of them in gaps of up to {} frames, which Load fills",
                                  facts.missing, points.labels.size() * points.frames, facts.short_gaps,
                                  ReadOptions{}.max_gap));
  std::vector<int> worst(points.labels.size());
  for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = static_cast<int>(i);
  std::stable_sort(worst.begin(), worst.end(), [&](int a, int b) { return facts.gaps[a] > facts.gaps[b]; });
  std::vector<std::string> names;
  for (int label : worst)
    if (facts.gaps[label] > 0)
      names.push_back(
          fmt::format("{} {:.0f} %", points.labels[label],
                      100.0 * static_cast<double>(facts.gaps[label]) / static_cast<double>(points.frames)));
  out += line("", some_of(names));
  out += line("", fmt::format("longest: {}, frames {} to {}; nothing is missing in {} of {} frames",
                              points.labels[facts.longest_label], facts.longest_at,
                              facts.longest_at + facts.longest - 1, facts.whole_frames, points.frames));
  return out;
}

std::string gltf_text(const GltfInventory& gltf, bool whole_file) {
  std::vector<std::string> clips, skins, meshes;
  for (const auto& clip : gltf.clips)
    clips.push_back(
        fmt::format("{} ({} keys, {:.3g} s, {})", clip.name, clip.keys, clip.seconds, clip.interpolation));
  for (const auto& skin : gltf.skins) skins.push_back(fmt::format("{} ({} joints)", skin.name, skin.joints));
  for (const auto& mesh : gltf.meshes)
    meshes.push_back(fmt::format("{} ({} vertices, {} triangles{}{})", mesh.name, mesh.vertices,
                                 mesh.triangles, mesh.skinned ? ", skinned" : "",
                                 mesh.morphs ? fmt::format(", {} morph targets", mesh.morphs) : ""));
  auto list = [](const std::vector<std::string>& names) {
    return names.empty() ? std::string("none") : fmt::format("{}: {}", names.size(), some_of(names));
  };
  std::string out = line("skins", list(skins)) + line("meshes", list(meshes));
  if (whole_file)
    out = line("clips", list(clips)) + out +
          line("look", fmt::format("{} materials, {} images", gltf.materials, gltf.textures));
  return out;
}

std::string breaks_text(const FileFacts& facts, const std::vector<std::string>& names) {
  constexpr std::size_t shown = 8;
  if (facts.breaks.empty()) return line("breaks", "no flips, jumps or spikes");
  std::size_t of[3] = {};
  for (const Break& one : facts.breaks) ++of[static_cast<int>(one.kind)];
  std::string out =
      line("breaks", fmt::format("{} flip{}, {} jump{}, {} spike{}", of[0], of[0] == 1 ? "" : "s", of[1],
                                 of[1] == 1 ? "" : "s", of[2], of[2] == 1 ? "" : "s"));
  for (std::size_t i = 0; i < facts.breaks.size() && i < shown; ++i) {
    const Break& one = facts.breaks[i];
    out += line("", fmt::format("{} of {} at frame {}: {}", name_of(one.kind), names[one.joint], one.frame,
                                one.turns ? fmt::format("{:.0f}°", one.size * degrees_per_radian)
                                          : fmt::format("{:.3g} m", one.size)));
  }
  if (facts.breaks.size() > shown) out += line("", fmt::format("and {} more", facts.breaks.size() - shown));
  return out;
}

}  // namespace

std::string skeleton_tree(const Skeleton& skeleton) {
  std::vector<std::vector<int>> children(skeleton.joints.size());
  for (int j = skeleton.size() - 1; j > 0; --j) children[skeleton.joints[j].parent].push_back(j);
  struct Open {
    int joint;
    std::size_t depth;
  };
  std::vector<Open> open;
  if (skeleton.size() > 0) open.push_back({0, 0});
  std::string text;
  while (!open.empty()) {
    const Open top = open.back();
    open.pop_back();
    const Joint& joint = skeleton.joints[top.joint];
    // A chain of ten thousand would be a hundred megabytes of blanks.
    text += fmt::format("{}{}  {:.3f} {:.3f} {:.3f}\n",
                        std::string(2 * std::min<std::size_t>(top.depth, 64), ' '), joint.name,
                        joint.offset.x, joint.offset.y, joint.offset.z);
    for (int child : children[top.joint]) open.push_back({child, top.depth + 1});
  }
  return text;
}

std::string facts_text(const MotionFile& file, const FileFacts& facts, const std::string& shown_path) {
  std::string out = fmt::format("{}: {}, {}\n", shown_path, facts.format, facts.ports);
  const Motion* motion = file.motion();
  const Points* points = file.points();
  std::vector<std::string> names;
  if (motion || points) {
    out += line("frames",
                fmt::format("{} at {:.6g} a second, {:.3g} s", facts.frames, facts.fps, facts.seconds));
    out += line("unit", to_text(LengthUnit{facts.unit, facts.unit_name}) +
                            (facts.unit_from.empty() ? "" : ", " + facts.unit_from));
    out += line("up", facts.up);
  }
  if (motion) {
    out += motion_text(*motion, *facts.motion);
    for (const Joint& joint : motion->skeleton().joints) names.push_back(joint.name);
  } else if (points) {
    out += points_text(*points, *facts.points);
    names = points->labels;
  }
  for (const FileContent& content : file.contents)
    for (const auto& [label, text] : analysis_lines(*content.value)) out += line(label, text);
  if (facts.gltf) out += gltf_text(*facts.gltf, facts.format == "gltf");
  if (motion || points) {
    out += line("numbers", facts.non_finite == 0 ? "all finite" : "some not finite");
    out += breaks_text(facts, names);
  }
  if (motion) out += '\n' + skeleton_tree(motion->skeleton());
  if (!facts.told.empty()) out += '\n';
  for (const Diagnostic& one : facts.told) out += to_text(one) + '\n';
  return out;
}

}  // namespace kinegraph
