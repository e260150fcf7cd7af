#include "nodes/files/json_fields.h"
#include "nodes/judge/analysis_facts.h"
#include "nodes/judge/file_facts.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

Json json_of(const std::vector<std::string>& texts) {
  Json::Array list;
  for (const std::string& text : texts) list.push_back(text);
  return list;
}

Json json_of(const Contacts& contacts) {
  Json::Array points;
  for (const FootPoint& point : contacts.points) {
    Json::Object entry;
    entry["foot"] = point.foot;
    entry["part"] = point.part;
    Json::Array plants;
    for (const Run& run : runs_of(point.planted)) plants.push_back(Json::Array{run.start, run.end});
    entry["plants"] = std::move(plants);
    points.push_back(std::move(entry));
  }
  return Json::Object{{"floor", contacts.floor}, {"points", std::move(points)}};
}

Json json_of(const GltfInventory& gltf) {
  Json::Array clips, skins, meshes;
  for (const auto& clip : gltf.clips)
    clips.push_back(Json::Object{{"name", clip.name},
                                 {"channels", clip.channels},
                                 {"keys", clip.keys},
                                 {"seconds", clip.seconds},
                                 {"interpolation", clip.interpolation}});
  for (const auto& skin : gltf.skins)
    skins.push_back(Json::Object{{"name", skin.name}, {"joints", skin.joints}});
  for (const auto& mesh : gltf.meshes)
    meshes.push_back(Json::Object{{"name", mesh.name},
                                  {"primitives", mesh.primitives},
                                  {"vertices", mesh.vertices},
                                  {"triangles", mesh.triangles},
                                  {"morphs", mesh.morphs},
                                  {"skinned", mesh.skinned}});
  return Json::Object{{"clips", std::move(clips)},       {"skins", std::move(skins)},
                      {"meshes", std::move(meshes)},     {"materials", gltf.materials},
                      {"images", gltf.textures},         {"uneven_vertices", gltf.uneven_vertices},
                      {"uneven_most", gltf.uneven_most}, {"skinned_below", json_of(gltf.skinned_below)}};
}

void put_motion(Json::Object& out, const Motion& motion, const MotionFacts& facts) {
  out["rest_height"] = facts.rest_height;
  out["first_height"] = facts.first_height;
  out["leg_length"] = facts.leg_length;
  out["travel"] = facts.travel;
  out["rest_frame"] = facts.rest_frame;
  out["contacts"] = facts.contacts ? json_of(*facts.contacts) : Json();
  Json::Array joints, ends;
  for (int j = 0; j < motion.joints(); ++j) {
    const Joint& joint = motion.skeleton().joints[j];
    Json::Object entry;
    entry["name"] = joint.name;
    entry["parent"] = joint.parent;
    entry["offset"] = json_of(joint.offset);
    entry["translates"] = motion.translates(j);
    if (static_cast<std::size_t>(j) < facts.layout.size())
      entry["channels"] = json_of(facts.layout[static_cast<std::size_t>(j)]);
    joints.push_back(std::move(entry));
  }
  for (const EndSite& end : motion.skeleton().ends)
    ends.push_back(
        Json::Object{{"joint", motion.skeleton().joints[end.joint].name}, {"offset", json_of(end.offset)}});
  out["joints"] = std::move(joints);
  out["ends"] = std::move(ends);
}

void put_points(Json::Object& out, const Points& points, const PointsFacts& facts) {
  out["height"] = facts.height;
  out["labels"] = json_of(points.labels);
  out["missing"] = facts.missing;
  out["missing_in_short_gaps"] = facts.short_gaps;
  out["whole_frames"] = facts.whole_frames;
  if (facts.longest_label >= 0)
    out["longest_gap"] = Json::Object{{"label", points.labels[static_cast<std::size_t>(facts.longest_label)]},
                                      {"frame", facts.longest_at},
                                      {"frames", facts.longest}};
  Json::Object gaps;
  for (std::size_t i = 0; i < facts.gaps.size(); ++i)
    if (facts.gaps[i] > 0) gaps[points.labels[i]] = facts.gaps[i];
  out["missing_of"] = std::move(gaps);
}

}  // namespace

Json facts_json(const MotionFile& file, const FileFacts& facts, const std::string& shown_path) {
  Json::Object out;
  out["file"] = shown_path;
  out["format"] = facts.format;
  Json::Array contents, diagnostics, breaks;
  for (const FileContent& content : file.contents) contents.push_back(content.port);
  out["contents"] = std::move(contents);
  const Motion* motion = file.motion();
  const Points* points = file.points();
  if (motion || points) {
    out["frames"] = facts.frames;
    out["fps"] = facts.fps;
    out["seconds"] = facts.seconds;
    out["unit"] = facts.unit;
    out["unit_name"] = facts.unit_name;
    out["unit_from"] = facts.unit_from;
    out["up"] = facts.up;
    out["finite"] = facts.non_finite == 0;
  }
  if (motion) put_motion(out, *motion, *facts.motion);
  if (!motion && points) put_points(out, *points, *facts.points);
  for (const FileContent& content : file.contents)
    for (auto& [name, value] : analysis_json(*content.value)) out[name] = value;
  if (facts.gltf) out["gltf"] = json_of(*facts.gltf);
  for (const Break& one : facts.breaks)
    breaks.push_back(Json::Object{
        {"kind", name_of(one.kind)},
        {motion ? "joint" : "label",
         motion ? motion->skeleton().joints[one.joint].name : points->labels[one.joint]},
        {"frame", one.frame},
        {one.turns ? "degrees" : "metres", one.turns ? one.size * degrees_per_radian : one.size}});
  out["breaks"] = std::move(breaks);
  for (const Diagnostic& one : facts.told) diagnostics.push_back(to_json(one));
  out["diagnostics"] = std::move(diagnostics);
  return out;
}

}  // namespace kinegraph
