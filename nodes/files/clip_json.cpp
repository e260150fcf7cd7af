#include "nodes/files/clip_json.h"

#include <algorithm>
#include <cmath>

#include "nodes/files/json_fields.h"

namespace kinegraph {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::size_t block = 3 << 12;  // numbers and bytes that `work` is asked after

Json series_json(std::span<const double> values, Work& work) {
  std::string text;
  text.reserve((8 * values.size() + 2) / 3 * 4);
  for (std::size_t from = 0; from < values.size(); from += block) {
    work.check();
    Encoder bytes;
    for (double value : values.subspan(from, std::min(block, values.size() - from))) bytes.f64(value);
    text += base64(bytes.take());  // no padding but in the last
  }
  return Json(std::move(text));
}
std::string bytes_of_series(const Json& json, Work& work) {
  std::string bytes, piece;
  bool good = json.is_string();
  std::string_view text;
  if (good) text = json.string();
  bytes.reserve(text.size() / 4 * 3);
  constexpr std::size_t letters = 4 * block;
  for (std::size_t from = 0; good && from < text.size(); from += letters) {
    work.check();
    const std::string_view part = text.substr(from, letters);
    const bool last = from + letters >= text.size();
    good = from_base64(part, piece) && (last || !part.ends_with('='));
    bytes += piece;
  }
  if (!good) bad_analysis(json, "a time series is a base64 text");
  return bytes;
}
void read_series(const Json& json, std::span<double> values, Work& work) {
  const std::string bytes = bytes_of_series(json, work);
  if (bytes.size() != 8 * values.size()) bad_analysis(json, "a time series has another length than its clip");
  Decoder in(bytes);
  for (double& value : values) {
    value = in.f64();
    if (!std::isfinite(value)) bad_analysis(json, "a time series holds a number that is not finite");
  }
}
std::vector<double> any_series(const Json& json, Work& work) {
  std::vector<double> values(json.is_string() ? json.string().size() / 4 * 3 / 8 : 0);
  read_series(json, values, work);
  return values;
}

int index_below(const Json& json, double least, std::size_t count, const char* what) {
  const double value = json.is_number() ? json.number() : NAN;
  if (!(value >= least && value < static_cast<double>(count)) || value != std::floor(value))
    bad_analysis(json, what);
  return static_cast<int>(value);
}
const char* name_of(UpAxis up) {
  return up == UpAxis::z ? "z" : "y";
}
UpAxis up_of(const Json& json) {
  return text_member(json, "up") == "z" ? UpAxis::z : UpAxis::y;
}
const Json& text(const Json& json) {
  if (!json.is_string()) bad_analysis(json, "a text belongs here");
  return json;
}

Json source_json(const SourceFacts& source, Work& work) {
  Json::Array bvh, ends;
  for (const BvhJoint& joint : source.bvh) {
    Json::Array channels(joint.channels.begin(), joint.channels.end());
    bvh.push_back(Json::Object{{"channels", std::move(channels)}, {"offset", json_of(joint.offset)}});
  }
  for (const Vec3& end : source.bvh_ends) ends.push_back(json_of(end));
  Json::Object out{{"format", source.format},         {"unit", source.unit},
                   {"unit_name", source.unit_name},   {"up", name_of(source.up)},
                   {"bvh", std::move(bvh)},           {"bvh_ends", std::move(ends)},
                   {"frame_time", source.frame_time}, {"frame_time_text", source.frame_time_text}};
  if (source.read) {
    out["read"] = series_json(*source.read, work);
    out["read_frames"] = source.read_frames;
    out["first_read"] = source.first_read;
  }
  return out;
}
SourceFacts source_of_json(const Json& json, Work& work) {
  SourceFacts source;
  source.format = text_member(json, "format");
  source.unit = number_member(json, "unit");
  source.unit_name = text_member(json, "unit_name");
  source.up = up_of(json);
  std::size_t channels = 0;
  for (const Json& entry : list_member(json, "bvh")) {
    BvhJoint joint;
    for (const Json& channel : list_member(entry, "channels"))
      joint.channels.push_back(text(channel).string());
    channels += joint.channels.size();
    joint.offset = vec3_of(member(entry, "offset"));
    source.bvh.push_back(std::move(joint));
  }
  for (const Json& end : list_member(json, "bvh_ends")) source.bvh_ends.push_back(vec3_of(end));
  source.frame_time = number_member(json, "frame_time");
  source.frame_time_text = text_member(json, "frame_time_text");
  if (json.find("read")) {
    auto read = any_series(member(json, "read"), work);
    source.read_frames = count_member(json, "read_frames");
    source.first_read = count_member(json, "first_read");
    if (channels == 0 || read.size() % channels != 0 || source.first_read > read.size() / channels ||
        source.read_frames > read.size() / channels - source.first_read)
      bad_analysis(member(json, "read"), "the angles as read have another length than they say");
    source.read = std::make_shared<const std::vector<double>>(std::move(read));
  }
  return source;
}

}  // namespace

std::string base64(std::string_view bytes) {
  std::string out((bytes.size() + 2) / 3 * 4, '=');
  char* to = out.data();
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3, to += 4) {
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k <= count; ++k) to[k] = digits[group >> (18 - 6 * k) & 63];
  }
  return out;
}

bool from_base64(std::string_view text, std::string& bytes) {
  if (text.size() % 4 != 0) return false;
  bytes.clear();
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    unsigned group = 0, padding = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const char c = text[i + k];
      const auto digit = digits.find(c);
      if (c == '=' && i + 4 == text.size() && k >= 2)
        ++padding;
      else if (digit == digits.npos || padding > 0)
        return false;
      group = group << 6 | (c == '=' ? 0u : static_cast<unsigned>(digit));
    }
    for (std::size_t k = 0; k + padding < 3; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 255);
  }
  return true;
}

Json skeleton_json(const Skeleton& skeleton) {
  Json::Array joints, ends;
  for (const Joint& joint : skeleton.joints)
    joints.push_back(Json::Object{{"joint", joint.name},
                                  {"parent", joint.parent},
                                  {"offset", json_of(joint.offset)},
                                  {"rest", json_of(joint.rest)}});
  for (const EndSite& end : skeleton.ends)
    ends.push_back(Json::Object{{"joint", end.joint}, {"offset", json_of(end.offset)}, {"name", end.name}});
  return Json::Object{{"joints", std::move(joints)},
                      {"ends", std::move(ends)},
                      {"above", json_of(skeleton.above)},
                      {"above_offset", json_of(skeleton.above_offset)},
                      {"above_scale", skeleton.above_scale}};
}

Skeleton skeleton_of_json(const Json& json) {
  Skeleton out;
  for (const Json& entry : list_member(json, "joints")) {
    Joint joint;
    joint.name = text_member(entry, "joint");
    joint.parent = index_below(member(entry, "parent"), -1, out.joints.size(),
                               "a parent is the index of an earlier joint, or -1");
    if ((joint.parent < 0) != out.joints.empty())
      bad_analysis(member(entry, "parent"), "only the first joint has no parent");
    joint.offset = vec3_of(member(entry, "offset"));
    joint.rest = quat_of(member(entry, "rest"));
    out.joints.push_back(std::move(joint));
  }
  if (out.joints.empty()) bad_analysis(member(json, "joints"), "a skeleton has a joint");
  for (const Json& entry : list_member(json, "ends"))
    out.ends.push_back({index_below(member(entry, "joint"), 0, out.joints.size(), "there is no such joint"),
                        vec3_of(member(entry, "offset")), text_member(entry, "name")});
  out.above = quat_of(member(json, "above"));
  out.above_offset = vec3_of(member(json, "above_offset"));
  out.above_scale = number_member(json, "above_scale");
  return out;
}

Json clip_json(const Motion& motion, Work& work) {
  Json::Array tracks;
  for (int j = 0; j < motion.joints(); ++j) {
    const auto q = motion.rotation(j);
    Json::Object track{{"rotation", Json::Array{series_json(q.x, work), series_json(q.y, work),
                                                series_json(q.z, work), series_json(q.w, work)}}};
    if (motion.translates(j)) {
      const auto p = motion.translation(j);
      track["translation"] =
          Json::Array{series_json(p.x, work), series_json(p.y, work), series_json(p.z, work)};
    }
    tracks.push_back(std::move(track));
  }
  return Json::Object{{"skeleton", skeleton_json(motion.skeleton())},
                      {"source", source_json(motion.source(), work)},
                      {"fps", motion.fps()},
                      {"frames", motion.frames()},
                      {"tracks", std::move(tracks)}};
}

Motion motion_of_json(const Json& json, Work& work) {
  auto skeleton = std::make_shared<const Skeleton>(skeleton_of_json(member(json, "skeleton")));
  const auto& tracks = list_member(json, "tracks");
  if (tracks.size() != skeleton->joints.size())
    bad_analysis(member(json, "tracks"), "there is a track for each joint");
  std::vector<bool> translates;
  for (const Json& track : tracks) translates.push_back(track.find("translation") != nullptr);
  // The length of a series tells the frames, so that a damaged number allocates nothing.
  const auto& first = list_member(tracks.front(), "rotation");
  const std::uint64_t frames = count_member(json, "frames");
  if (first.empty() || any_series(first[0], work).size() != frames)
    bad_analysis(member(json, "frames"), "the series have another length");
  auto source = source_of_json(member(json, "source"), work);
  if (!source.bvh.empty() && source.bvh.size() != skeleton->joints.size())
    bad_analysis(member(json, "source"), "the source has other joints");
  Motion motion(skeleton, std::make_shared<const SourceFacts>(std::move(source)), number_member(json, "fps"),
                frames, translates);
  for (int j = 0; j < motion.joints(); ++j) {
    const Json& track = tracks[static_cast<std::size_t>(j)];
    const auto read = [&](const char* key, std::initializer_list<std::span<double>> axes) {
      const auto& list = list_member(track, key);
      if (list.size() != axes.size()) bad_analysis(member(track, key), "a track has another number of axes");
      std::size_t i = 0;
      for (const std::span<double>& axis : axes) read_series(list[i++], axis, work);
    };
    const auto q = motion.rotation(j);
    read("rotation", {q.x, q.y, q.z, q.w});
    if (!motion.translates(j)) continue;
    const auto p = motion.translation(j);
    read("translation", {p.x, p.y, p.z});
  }
  return motion;
}

Json clip_json(const Points& points, Work& work) {
  Json::Array links, labels(points.labels.begin(), points.labels.end()), missing;
  for (const auto& [a, b] : points.links) links.push_back(Json::Array{a, b});
  for (std::size_t i = 0; i < points.missing.size(); ++i)
    if (points.missing[i]) missing.push_back(i);
  return Json::Object{{"labels", std::move(labels)},
                      {"links", std::move(links)},
                      {"missing", std::move(missing)},
                      {"fps", points.fps},
                      {"frames", points.frames},
                      {"unit", points.unit},
                      {"unit_name", points.unit_name},
                      {"up", name_of(points.up)},
                      {"positions", series_json(points.data, work)}};
}

Points points_of_json(const Json& json, Work& work) {
  std::vector<std::string> labels;
  for (const Json& label : list_member(json, "labels")) labels.push_back(text(label).string());
  std::vector<double> data = any_series(member(json, "positions"), work);
  const std::uint64_t frames = count_member(json, "frames");
  if (labels.empty() ? !data.empty()
                     : data.size() % (3 * labels.size()) != 0 || data.size() / (3 * labels.size()) != frames)
    bad_analysis(member(json, "frames"), "the positions have another length");
  Points points(labels, number_member(json, "fps"), labels.empty() ? 0 : frames);
  points.data = std::move(data);
  points.unit = number_member(json, "unit");
  points.unit_name = text_member(json, "unit_name");
  points.up = up_of(json);
  for (const Json& link : list_member(json, "links")) {
    if (!link.is_array() || link.array().size() != 2) bad_analysis(link, "a link is two labels' indices");
    points.links.emplace_back(index_below(link.array()[0], 0, labels.size(), "there is no such label"),
                              index_below(link.array()[1], 0, labels.size(), "there is no such label"));
  }
  for (const Json& entry : list_member(json, "missing")) {
    const int at = index_below(entry, 0, points.data.size() / 3, "there is no such sample");
    points.set_missing(at / static_cast<int>(frames), static_cast<std::size_t>(at) % frames);
  }
  return points;
}

}  // namespace kinegraph
