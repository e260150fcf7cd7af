#include <array>

#include "nodes/files/analysis_file.h"
#include "nodes/files/decimal.h"
#include "nodes/files/json_fields.h"
#include "nodes/style/stats.h"

namespace kinegraph {

namespace {

constexpr const char* root_channels[] = {"root.d_x", "root.d_z", "root.height", "root.d_heading"};

void copy_to(const std::vector<double>& from, double* to) {
  std::copy(from.begin(), from.end(), to);
}

}  // namespace

Json stats_json(const Value& value, Work&) {
  const auto& stats = dynamic_cast<const Stats&>(value);
  Json::Array joints;
  for (std::size_t j = 0; j < stats.joints.size(); ++j) {
    const JointStats& joint = stats.joints[j];
    Json::Object entry;
    entry["joint"] = joint.joint;
    entry["chosen"] = joint.chosen;
    entry["mean"] = json_of(joint.mean);
    entry["spread"] = joint.spread;
    if (!joint.order.empty()) {
      entry["order"] = joint.order;
      entry["euler_mean"] = json_list(joint.euler_mean.data(), 3);
      entry["euler_spread"] = json_list(joint.euler_spread.data(), 3);
    }
    if (j < stats.parents.size()) entry["parent"] = stats.parents[j];
    if (j < stats.offsets.size()) entry["offset"] = json_of(stats.offsets[j]);
    if (j < stats.rests.size()) entry["rest"] = json_of(stats.rests[j]);
    joints.push_back(std::move(entry));
  }
  Json::Object out;
  out["space"] = stats.space;
  out["mean_kind"] = stats.mean_kind;
  out["joints"] = std::move(joints);
  out["root_mean"] = json_list(stats.root_mean.data(), 4);
  out["root_spread"] = json_list(stats.root_spread.data(), 4);
  out["leg_length"] = stats.leg_length;
  out["fps"] = stats.fps;
  out["frames"] = static_cast<double>(stats.frames);
  return out;
}

ValuePtr stats_of_json(const Json& json, Work&) {
  auto stats = std::make_shared<Stats>();
  stats->space = text_member(json, "space");
  if (stats->space != "quaternion" && stats->space != "euler")
    bad_analysis(member(json, "space"), "\"space\" is quaternion or euler");
  stats->mean_kind = text_member(json, "mean_kind");
  for (const Json& entry : list_member(json, "joints")) {
    JointStats joint;
    joint.joint = text_member(entry, "joint");
    joint.chosen = flag_member(entry, "chosen");
    joint.mean = quat_of(member(entry, "mean"));
    joint.spread = number_member(entry, "spread");
    if (entry.find("order")) {
      joint.order = text_member(entry, "order");
      copy_to(numbers_of(member(entry, "euler_mean"), 3), joint.euler_mean.data());
      copy_to(numbers_of(member(entry, "euler_spread"), 3), joint.euler_spread.data());
    }
    if (entry.find("parent")) {
      const double parent = number_member(entry, "parent");
      const auto index = static_cast<double>(stats->joints.size());
      if (!(parent >= -1 && parent < index) || parent != static_cast<int>(parent))
        bad_analysis(member(entry, "parent"), "a parent is the index of an earlier joint, or -1");
      stats->parents.push_back(static_cast<int>(parent));
    }
    if (entry.find("offset")) stats->offsets.push_back(vec3_of(member(entry, "offset")));
    if (entry.find("rest")) stats->rests.push_back(quat_of(member(entry, "rest")));
    stats->joints.push_back(std::move(joint));
  }
  auto all_or_none = [&](std::size_t count, const char* what) {
    if (count != 0 && count != stats->joints.size())
      bad_analysis(member(json, "joints"), std::string("some joints lack \"") + what + '"');
  };
  all_or_none(stats->parents.size(), "parent");
  all_or_none(stats->offsets.size(), "offset");
  all_or_none(stats->rests.size(), "rest");
  copy_to(numbers_of(member(json, "root_mean"), 4), stats->root_mean.data());
  copy_to(numbers_of(member(json, "root_spread"), 4), stats->root_spread.data());
  stats->leg_length = number_member(json, "leg_length");
  stats->fps = number_member(json, "fps");
  stats->frames = count_member(json, "frames");
  return stats;
}

std::string stats_table(const Value& value, Work&) {
  const auto& stats = dynamic_cast<const Stats&>(value);
  const bool euler = stats.space == "euler";
  std::string out = euler ? "name,order,mean.1,mean.2,mean.3,spread.1,spread.2,spread.3\n"
                          : "name,mean.x,mean.y,mean.z,mean.w,spread\n";
  auto cell = [&](double number) {
    out += ',';
    append_shortest(out, number);
  };
  for (const JointStats& joint : stats.joints) {
    if (!joint.chosen) continue;
    out += csv_cell(joint.joint);
    if (euler) {
      out += ',' + joint.order;
      for (double mean : joint.euler_mean) cell(mean);
      for (double spread : joint.euler_spread) cell(spread);
    } else {
      for (double part : {joint.mean.x, joint.mean.y, joint.mean.z, joint.mean.w, joint.spread}) cell(part);
    }
    out += '\n';
  }
  // Numbers of one axis stand in the first column of the means.
  for (int c = 0; c < 4; ++c) {
    out += root_channels[c];
    if (euler) out += ',';
    cell(stats.root_mean[c]);
    out += euler ? ",," : ",,,";
    cell(stats.root_spread[c]);
    if (euler) out += ",,";
    out += '\n';
  }
  return out;
}

}  // namespace kinegraph
