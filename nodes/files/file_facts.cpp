#include "nodes/files/file_facts.h"

#include <fmt/format.h>

#include <algorithm>

#include "nodes/files/json_fields.h"
#include "nodes/files/length_unit.h"
#include "nodes/files/rest_frame.h"

namespace kinegraph {

namespace {

// The first few names, and how many more there are.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 4;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < shown; ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

bool has_positions(const BvhJoint& joint) {
  return std::any_of(joint.channels.begin(), joint.channels.end(), [](const auto& c) { return c[1] == 'p'; });
}

std::vector<std::string> channel_layouts(const Motion& motion) {
  struct Layout {
    std::string channels;
    std::vector<std::string> joints;
  };
  std::vector<Layout> layouts;
  for (std::size_t j = 0; j < motion.source().bvh.size(); ++j) {
    const auto& channels = motion.source().bvh[j].channels;
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

Diagnostics for_other_programs(const Motion& motion) {
  Diagnostics found;
  std::vector<std::string> adds, blanks, bare;
  std::vector<bool> has_end(motion.skeleton().joints.size()), has_child(has_end.size());
  for (const EndSite& end : motion.skeleton().ends) has_end[end.joint] = true;
  for (const Joint& joint : motion.skeleton().joints)
    if (joint.parent >= 0) has_child[joint.parent] = true;
  for (std::size_t j = 0; j < has_end.size(); ++j) {
    const std::string& name = motion.skeleton().joints[j].name;
    if (name.find_first_of(" \t") != std::string::npos) blanks.push_back(name);
    if (j >= motion.source().bvh.size()) continue;
    if (has_positions(motion.source().bvh[j]) && motion.source().bvh[j].offset != Vec3{})
      adds.push_back(name);
    if (!has_end[j] && !has_child[j]) bare.push_back(name);
  }
  if (!adds.empty())
    found.push_back(warning("three-adds-offset",
                            "three.js adds OFFSET and position channels where Blender, MotionBuilder "
                            "and Kinegraph take the channels alone: " +
                                some_of(adds)));
  if (!blanks.empty())
    found.push_back(warning("assimp-names", "Assimp doesn't read BVH names with blanks: " + some_of(blanks)));
  if (!bare.empty())
    found.push_back(info(
        "no-end-site",
        "joints at the end of a chain have no End Site, so programs guess their bone: " + some_of(bare)));
  return found;
}

}  // namespace

MotionFacts facts_of(const Motion& motion) {
  MotionFacts facts;
  facts.frames = motion.frames();
  facts.fps = motion.fps();
  facts.seconds = static_cast<double>(motion.frames()) / motion.fps();
  facts.unit = to_text(LengthUnit{motion.source().unit, motion.source().unit_name});
  facts.up = motion.source().up == UpAxis::y ? "Y" : "Z";
  facts.rest_height = rest_height(motion.skeleton());
  facts.leg_length = leg_length(motion.skeleton());
  facts.joints = motion.joints();
  facts.ends = static_cast<int>(motion.skeleton().ends.size());
  facts.rest_frame = starts_with_rest_frame(motion);
  facts.channels = channel_layouts(motion);
  facts.for_others = for_other_programs(motion);
  return facts;
}

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
    text += fmt::format("{}{}  {:.3f} {:.3f} {:.3f}\n", std::string(2 * top.depth, ' '), joint.name,
                        joint.offset.x, joint.offset.y, joint.offset.z);
    for (int child : children[top.joint]) open.push_back({child, top.depth + 1});
  }
  return text;
}

Json facts_json(const MotionFile& file, const std::string& shown_path, const Diagnostics& told) {
  Json::Object out;
  out["file"] = shown_path;
  out["format"] = file.format;
  Json::Array contents, diagnostics;
  for (const FileContent& content : file.contents) contents.push_back(content.port);
  out["contents"] = std::move(contents);
  for (const Diagnostic& one : told) diagnostics.push_back(to_json(one));
  if (const Motion* motion = file.motion()) {
    const MotionFacts facts = facts_of(*motion);
    out["frames"] = facts.frames;
    out["fps"] = facts.fps;
    out["seconds"] = facts.seconds;
    out["unit"] = motion->source().unit;
    out["unit_name"] = motion->source().unit_name;
    out["up"] = facts.up;
    out["rest_height"] = facts.rest_height;
    out["leg_length"] = facts.leg_length;
    out["rest_frame"] = facts.rest_frame;
    Json::Array joints, ends;
    for (int j = 0; j < motion->joints(); ++j) {
      const Joint& joint = motion->skeleton().joints[j];
      Json::Object entry;
      entry["name"] = joint.name;
      entry["parent"] = joint.parent;
      entry["offset"] = json_of(joint.offset);
      entry["translates"] = motion->translates(j);
      if (static_cast<std::size_t>(j) < motion->source().bvh.size()) {
        Json::Array channels;
        for (const std::string& channel : motion->source().bvh[j].channels) channels.push_back(channel);
        entry["channels"] = std::move(channels);
      }
      joints.push_back(std::move(entry));
    }
    for (const EndSite& end : motion->skeleton().ends) {
      Json::Object entry;
      entry["joint"] = motion->skeleton().joints[end.joint].name;
      entry["offset"] = json_of(end.offset);
      ends.push_back(std::move(entry));
    }
    out["joints"] = std::move(joints);
    out["ends"] = std::move(ends);
    for (const Diagnostic& one : facts.for_others) diagnostics.push_back(to_json(one));
  } else if (const Points* points = file.points()) {
    out["frames"] = points->frames;
    out["fps"] = points->fps;
    out["unit"] = points->unit;
    out["unit_name"] = points->unit_name;
    Json::Array labels;
    for (const std::string& label : points->labels) labels.push_back(label);
    out["labels"] = std::move(labels);
    out["missing"] = static_cast<double>(std::count(points->missing.begin(), points->missing.end(), true));
  }
  out["diagnostics"] = std::move(diagnostics);
  return out;
}

std::string facts_text(const MotionFile& file, const std::string& shown_path, const Diagnostics& told) {
  std::string out = fmt::format("{}: {}, {}\n", shown_path, file.format, file.ports());
  Diagnostics all = told;
  if (const Motion* motion = file.motion()) {
    const MotionFacts facts = facts_of(*motion);
    out += fmt::format("frames    {} at {:.6g} a second, {:.3g} s\n", facts.frames, facts.fps, facts.seconds);
    out += fmt::format("unit      {}, {} up\n", facts.unit, facts.up);
    out += fmt::format("height    {:.3g} m in the rest pose", facts.rest_height);
    if (facts.leg_length > 0) out += fmt::format(", legs {:.3g} m", facts.leg_length);
    out += fmt::format("\nskeleton  {} joints, {} End Sites\n", facts.joints, facts.ends);
    for (const std::string& channels : facts.channels) out += "channels  " + channels + '\n';
    out += '\n' + skeleton_tree(motion->skeleton());
    all.insert(all.end(), facts.for_others.begin(), facts.for_others.end());
  } else if (const Points* points = file.points()) {
    out += fmt::format("frames    {} at {:.6g} a second\n", points->frames, points->fps);
    out += fmt::format("unit      {}\n", to_text(LengthUnit{points->unit, points->unit_name}));
    out += fmt::format("points    {}: {}\n", points->labels.size(), some_of(points->labels));
    if (auto missing = std::count(points->missing.begin(), points->missing.end(), true))
      out += fmt::format("missing   {} of {} samples\n", missing, points->missing.size());
  }
  if (!all.empty()) out += '\n';
  for (const Diagnostic& one : all) out += to_text(one) + '\n';
  return out;
}

}  // namespace kinegraph
