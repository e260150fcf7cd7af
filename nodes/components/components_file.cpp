#include "nodes/components/components.h"
#include "nodes/files/analysis_file.h"
#include "nodes/files/clip_json.h"
#include "nodes/files/decimal.h"
#include "nodes/files/json_fields.h"

namespace kinegraph {
namespace {

Json matrix_json(const Rows& rows, Work& work) {
  Json::Array out;
  for (std::size_t i = 0; i < rows.rows; ++i) {
    work.check();
    out.push_back(json_list(rows.row(i), rows.columns));
  }
  return out;
}
Rows matrix_of(const Json& json, std::size_t rows, std::size_t columns, Work& work) {
  if (!json.is_array() || json.array().size() != rows)
    bad_analysis(json, "the matrix has another number of rows");
  Rows out(rows, columns);
  for (std::size_t i = 0; i < rows; ++i) {
    work.check();
    const auto row = numbers_of(json.array()[i], columns);
    std::copy(row.begin(), row.end(), out.row(i));
  }
  return out;
}
Json texts_json(const std::vector<std::string>& all) {
  return Json::Array(all.begin(), all.end());
}
std::vector<std::string> texts_in(const Json& json, std::string_view key) {
  std::vector<std::string> out;
  for (const Json& one : list_member(json, key)) {
    if (!one.is_string()) bad_analysis(one, "a text belongs here");
    out.push_back(one.string());
  }
  return out;
}

constexpr const char* stabilisations[] = {"none", "centroid", "rigid"};

Json space_json(const ChannelSpace& space) {
  Json::Array joints(space.joints.begin(), space.joints.end()), reference, shape;
  for (const Quat& q : space.reference) reference.push_back(json_of(q));
  for (const Vec3& v : space.shape) shape.push_back(json_of(v));
  Json::Object out{{"representation", name_of(space.representation)},
                   {"heading", space.heading},
                   {"labels", texts_json(space.labels)},
                   {"channels", texts_json(space.channel_names())},
                   {"joints", std::move(joints)},
                   {"reference", std::move(reference)},
                   {"orders", texts_json(space.orders)},
                   {"map", texts_json(space.map)},
                   {"stabilise", stabilisations[static_cast<int>(space.stabilise)]},
                   {"stable", texts_json(space.stable)},
                   {"shape", std::move(shape)}};
  if (space.skeleton) out["skeleton"] = skeleton_json(*space.skeleton);
  return out;
}

ChannelSpace space_of(const Json& json) {
  ChannelSpace space;
  const std::string& representation = text_member(json, "representation");
  space.representation = representation_from(representation);
  if (name_of(space.representation) != representation)
    bad_analysis(member(json, "representation"),
                 "the representation is points, quaternions, euler or logarithm");
  space.of_motions = json.find("skeleton") != nullptr;
  space.heading = flag_member(json, "heading");
  space.labels = texts_in(json, "labels");
  space.orders = texts_in(json, "orders");
  space.map = texts_in(json, "map");
  space.stable = texts_in(json, "stable");
  for (int i = 0; i < 3; ++i)
    if (text_member(json, "stabilise") == stabilisations[i]) space.stabilise = static_cast<Stabilise>(i);
  for (const Json& v : list_member(json, "shape")) space.shape.push_back(vec3_of(v));
  for (const Json& q : list_member(json, "reference")) space.reference.push_back(quat_of(q));
  if (!space.of_motions && space.representation != Representation::points)
    bad_analysis(member(json, "representation"), "only points do without a skeleton");
  if (space.stabilise == Stabilise::rigid && space.shape.size() != space.stable.size())
    bad_analysis(member(json, "shape"), "there is a place for each stable label");
  if (!space.of_motions) return space;
  const auto skeleton = std::make_shared<const Skeleton>(skeleton_of_json(member(json, "skeleton")));
  int before = -1;
  for (const Json& joint : list_member(json, "joints")) {
    const double index = joint.is_number() ? joint.number() : -1;
    if (!(index > before && index < skeleton->size()) || index != static_cast<int>(index))
      bad_analysis(joint, "joints are rising indices into the skeleton");
    space.joints.push_back(before = static_cast<int>(index));
  }
  space.skeleton = skeleton;
  const bool needs_reference = space.representation == Representation::quaternions ||
                               space.representation == Representation::logarithm;
  if (space.joints.size() != space.labels.size() || space.orders.size() != space.labels.size() ||
      (needs_reference && space.reference.size() != space.labels.size()))
    bad_analysis(member(json, "labels"), "joints, labels, orders and reference differ in number");
  return space;
}

void read_segments(const Json& json, Components& components, Work& work) {
  std::size_t at = 0;
  for (const Json& entry : list_member(json, "segments")) {
    ComponentSegment segment;
    const Json& clip = member(entry, "clip");
    if (components.space.of_motions)
      segment.motion = std::make_shared<const Motion>(motion_of_json(clip, work));
    else
      segment.points = std::make_shared<const Points>(points_of_json(clip, work));
    segment.start = at;
    segment.end = at += segment.motion ? segment.motion->frames() : segment.points->frames;
    if (entry.find("added"))
      segment.added = matrix_of(member(entry, "added"), components.space.channels(), segment.frames(), work);
    components.segments.push_back(std::move(segment));
  }
  if (components.segments.empty()) bad_analysis(member(json, "segments"), "there is at least one segment");
}

}  // namespace

Json components_json(const Value& value, Work& work) {
  const auto& components = dynamic_cast<const Components&>(value);
  Json::Array segments, groups, unique;
  for (const ComponentSegment& segment : components.segments) {
    Json::Object entry{
        {"clip", segment.motion ? clip_json(*segment.motion, work) : clip_json(*segment.points, work)}};
    if (!segment.added.data.empty()) entry["added"] = matrix_json(segment.added, work);
    segments.push_back(std::move(entry));
  }
  for (const ComponentGroup& group : components.groups) {
    Json::Array terms;
    for (const auto& [component, factor] : group.terms) terms.push_back(Json::Array{component, factor});
    groups.push_back(Json::Object{{"name", group.name}, {"terms", std::move(terms)}});
  }
  for (bool one : components.unique) unique.push_back(one);
  return Json::Object{{"space", space_json(components.space)},
                      {"fps", components.fps},
                      {"mean", json_list(components.mean.data(), components.mean.size())},
                      {"mixing", matrix_json(components.mixing, work)},
                      {"unmixing", matrix_json(components.unmixing, work)},
                      {"signals", matrix_json(components.signals, work)},
                      {"shares", json_list(components.shares.data(), components.shares.size())},
                      {"segments", std::move(segments)},
                      {"groups", std::move(groups)},
                      {"convergence", Json::Object{{"nonlinearity", components.nonlinearity},
                                                   {"method", components.method},
                                                   {"converged", components.converged},
                                                   {"iterations", components.iterations},
                                                   {"reached", components.reached},
                                                   {"tolerance", components.tolerance},
                                                   {"negentropy", components.negentropy},
                                                   {"unique", std::move(unique)}}}};
}

ValuePtr components_of_json(const Json& json, Work& work) {
  auto out = std::make_shared<Components>();
  out->space = space_of(member(json, "space"));
  out->fps = number_member(json, "fps");
  const std::size_t channels = out->space.channels(), count = list_member(json, "signals").size();
  out->mean = numbers_of(member(json, "mean"), channels);
  out->mixing = matrix_of(member(json, "mixing"), channels, count, work);
  out->unmixing = matrix_of(member(json, "unmixing"), count, channels, work);
  out->shares = numbers_of(member(json, "shares"), count);
  read_segments(json, *out, work);
  out->signals = matrix_of(member(json, "signals"), count, out->segments.back().end, work);
  for (const Json& entry : list_member(json, "groups")) {
    ComponentGroup group{text_member(entry, "name"), {}};
    for (const Json& term : list_member(entry, "terms")) {
      const auto numbers = numbers_of(term, 2);
      if (!(numbers[0] >= 1 && numbers[0] <= static_cast<double>(count)))
        bad_analysis(term, "there is no such component");
      group.terms.emplace_back(static_cast<int>(numbers[0]), numbers[1]);
    }
    out->groups.push_back(std::move(group));
  }
  const Json& convergence = member(json, "convergence");
  out->nonlinearity = text_member(convergence, "nonlinearity");
  out->method = text_member(convergence, "method");
  out->converged = flag_member(convergence, "converged");
  out->iterations = static_cast<int>(count_member(convergence, "iterations"));
  out->reached = number_member(convergence, "reached");
  out->tolerance = number_member(convergence, "tolerance");
  out->negentropy = number_member(convergence, "negentropy");
  for (const Json& one : list_member(convergence, "unique")) {
    if (!one.is_boolean()) bad_analysis(one, "true or false belongs here");
    out->unique.push_back(one.boolean());
  }
  if (out->unique.size() != count)
    bad_analysis(member(convergence, "unique"), "there is an entry for each component");
  return out;
}

std::string components_table(const Value& value, Work& work) {
  const auto& components = dynamic_cast<const Components&>(value);
  std::string out = "frame,segment";
  for (std::size_t i = 0; i < components.count(); ++i) out += ",u" + std::to_string(i + 1);
  out += '\n';
  for (std::size_t s = 0; s < components.segments.size(); ++s) {
    const ComponentSegment& segment = components.segments[s];
    for (std::size_t t = segment.start; t < segment.end; ++t) {
      if (t % 256 == 0) work.check();
      out += std::to_string(t - segment.start) + ',' + std::to_string(s);
      for (std::size_t i = 0; i < components.count(); ++i) {
        out += ',';
        append_shortest(out, components.signals(i, t));
      }
      out += '\n';
    }
  }
  return out;
}

}  // namespace kinegraph
