#include <fmt/format.h>

#include "nodes/files/analysis_file.h"
#include "nodes/files/json_fields.h"
#include "nodes/time/warp.h"

namespace kinegraph {

Json warp_json(const Value& value, Work&) {
  const auto& warp = dynamic_cast<const Warp&>(value);
  Json::Object out;
  out["identity"] = warp.identity;
  out["source_warped"] = warp.source_warped;
  out["fps"] = warp.fps;
  out["source_frames"] = static_cast<double>(warp.source_frames);
  out["reference_frames"] = static_cast<double>(warp.reference_frames);
  Json::Array paths, dofs, skipped;
  for (const auto& path : warp.paths) {
    Json::Array frames;
    for (std::uint32_t frame : path) frames.push_back(static_cast<double>(frame));
    paths.push_back(std::move(frames));
  }
  for (const std::string& dof : warp.dofs) dofs.push_back(dof);
  for (const SkippedFrame& frame : warp.skipped) {
    Json::Object entry;
    entry["frame"] = static_cast<double>(frame.frame);
    entry["d_x"] = frame.d_x;
    entry["d_z"] = frame.d_z;
    entry["d_heading"] = frame.d_heading;
    entry["height"] = frame.height;
    entry["logs"] = json_list(frame.logs.data(), frame.logs.size());
    skipped.push_back(std::move(entry));
  }
  out["paths"] = std::move(paths);
  out["dofs"] = std::move(dofs);
  out["means"] = json_list(warp.means.data(), warp.means.size());
  out["skipped"] = std::move(skipped);
  out["energy"] = json_list(warp.energy.data(), warp.energy.size());
  out["rounds"] = warp.rounds;
  return out;
}

ValuePtr warp_of_json(const Json& json, Work&) {
  auto warp = std::make_shared<Warp>();
  warp->identity = flag_member(json, "identity");
  warp->source_warped = flag_member(json, "source_warped");
  warp->fps = number_member(json, "fps");
  if (!(warp->fps > 0)) bad_analysis(member(json, "fps"), "\"fps\" must be over 0");
  auto frames = [&](const char* key) {
    const auto count = count_member(json, key);
    if (count > 0xFFFFFFFFu) bad_analysis(member(json, key), "too many frames");
    return static_cast<std::uint32_t>(count);
  };
  warp->source_frames = frames("source_frames");
  warp->reference_frames = frames("reference_frames");
  const std::uint32_t shown = warp->source_warped ? warp->source_frames : warp->reference_frames;
  for (const Json& list : list_member(json, "paths")) {
    auto path = counts_of(list);
    for (std::size_t row = 0; row < path.size(); ++row)
      if (path[row] >= shown || (row > 0 && path[row] < path[row - 1]))
        bad_analysis(list, fmt::format("row {} of a path names frame {}; frames go up and stay below {}", row,
                                       path[row], shown));
    if (!warp->paths.empty() && path.size() != warp->paths[0].size())
      bad_analysis(list, "paths of different lengths");
    warp->paths.push_back(std::move(path));
  }
  for (const Json& dof : list_member(json, "dofs")) {
    if (!dof.is_string()) bad_analysis(dof, "a name is wanted");
    warp->dofs.push_back(dof.string());
  }
  if (!warp->dofs.empty() && warp->dofs.size() != warp->paths.size())
    bad_analysis(member(json, "dofs"), "every path needs its name");
  if (!warp->identity && warp->paths.empty()) bad_analysis(member(json, "paths"), "a warp needs a path");
  warp->means = numbers_of(member(json, "means"));
  for (const Json& entry : list_member(json, "skipped")) {
    SkippedFrame frame;
    const auto number = count_member(entry, "frame");
    if (number >= shown) bad_analysis(entry, fmt::format("skipped frame {} is none of {}", number, shown));
    frame.frame = static_cast<std::uint32_t>(number);
    frame.d_x = number_member(entry, "d_x");
    frame.d_z = number_member(entry, "d_z");
    frame.d_heading = number_member(entry, "d_heading");
    frame.height = number_member(entry, "height");
    frame.logs = numbers_of(member(entry, "logs"));
    warp->skipped.push_back(std::move(frame));
  }
  warp->energy = numbers_of(member(json, "energy"));
  warp->rounds = static_cast<int>(count_member(json, "rounds"));
  return warp;
}

std::string warp_table(const Value& value, Work& work) {
  const auto& warp = dynamic_cast<const Warp&>(value);
  std::string out = "row";
  if (warp.dofs.empty()) {
    out += ",frame";
  } else {
    for (const std::string& dof : warp.dofs) out += ',' + csv_cell(dof);
  }
  out += '\n';
  const std::size_t rows = warp.paths.empty() ? 0 : warp.paths[0].size();
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % 1024 == 0) work.check();
    out += std::to_string(row);
    for (const auto& path : warp.paths) out += ',' + std::to_string(path[row]);
    out += '\n';
  }
  return out;
}

}  // namespace kinegraph
