#include <fmt/format.h>

#include "nodes/files/analysis_file.h"
#include "nodes/files/decimal.h"
#include "nodes/files/json_fields.h"
#include "nodes/files/reserve_like.h"
#include "nodes/motion/contacts.h"

namespace kinegraph {

Json contacts_json(const Value& value, Work&) {
  const auto& contacts = dynamic_cast<const Contacts&>(value);
  Json::Array points;
  for (const FootPoint& point : contacts.points) {
    Json::Object entry;
    entry["foot"] = point.foot;
    entry["left"] = point.left;
    entry["part"] = point.part;
    entry["joint"] = point.joint;
    entry["joint_name"] = point.joint_name;
    entry["local"] = json_of(point.local);
    Json::Array planted;  // [start, end) of each plant
    for (const Run& run : runs_of(point.planted)) planted.push_back(Json::Array{run.start, run.end});
    entry["planted"] = std::move(planted);
    Json::Array heights;  // of the ground under each plant, m
    for (double height : point.heights) heights.push_back(height);
    if (!heights.empty()) entry["heights"] = std::move(heights);
    points.push_back(std::move(entry));
  }
  Json::Object out;
  out["fps"] = contacts.fps;
  out["frames"] = contacts.frames;
  out["floor"] = contacts.floor;
  if (contacts.leg > 0) out["leg"] = contacts.leg;
  out["points"] = std::move(points);
  return out;
}

ValuePtr contacts_of_json(const Json& json, Work&) {
  auto contacts = std::make_shared<Contacts>();
  contacts->fps = number_member(json, "fps");
  if (!(contacts->fps > 0)) bad_analysis(member(json, "fps"), "\"fps\" must be over 0");
  contacts->frames = count_member(json, "frames");
  if (contacts->frames > 100'000'000) bad_analysis(member(json, "frames"), "over 100 million frames");
  contacts->floor = number_member(json, "floor");
  if (json.find("leg")) contacts->leg = number_member(json, "leg");
  for (const Json& entry : list_member(json, "points")) {
    if (contacts->points.size() >= 1000) bad_analysis(entry, "over 1000 foot points");
    FootPoint point;
    point.foot = text_member(entry, "foot");
    point.left = flag_member(entry, "left");
    point.part = text_member(entry, "part");
    point.joint = static_cast<int>(count_member(entry, "joint"));
    point.joint_name = text_member(entry, "joint_name");
    point.local = vec3_of(member(entry, "local"));
    point.planted.assign(contacts->frames, false);
    for (const Json& run : list_member(entry, "planted")) {
      const auto ends = counts_of(run);
      if (ends.size() != 2 || ends[0] >= ends[1] || ends[1] > contacts->frames)
        bad_analysis(run, fmt::format("a plant is [start, end) within {} frames", contacts->frames));
      std::fill(point.planted.begin() + ends[0], point.planted.begin() + ends[1], true);
    }
    if (const Json* heights = entry.find("heights")) {
      for (const Json& height : list_member(entry, "heights")) {
        if (!height.is_number()) bad_analysis(height, "a height is a number of metres");
        point.heights.push_back(height.number());
      }
      if (point.heights.size() != runs_of(point.planted).size())
        bad_analysis(*heights, "\"heights\" has another length than \"planted\"");
    }
    contacts->points.push_back(std::move(point));
  }
  return contacts;
}

std::string contacts_table(const Value& value, Work& work) {
  const auto& contacts = dynamic_cast<const Contacts&>(value);
  std::string out = "frame,time";
  for (const FootPoint& point : contacts.points) out += ',' + csv_cell(point.foot + "." + point.part);
  out += '\n';
  for (std::size_t t = 0; t < contacts.frames; ++t) {
    if (t % 1024 == 0) work.check();
    if (t == 1024) reserve_like(out, t, contacts.frames);
    out += std::to_string(t) + ',';
    append_shortest(out, static_cast<double>(t) / contacts.fps);
    for (const FootPoint& point : contacts.points) out += point.planted[t] ? ",1" : ",0";
    out += '\n';
  }
  return out;
}

}  // namespace kinegraph
