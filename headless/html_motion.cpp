#include "headless/html_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "headless/draws/skeleton_figure.h"
#include "nodes/files/clip_json.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/points.h"

namespace kinegraph {

namespace {

// A page should open at once: more frames, or more places in all, and every second, third, … frame is shown.
constexpr std::size_t most_frames = 3000, most_places = 400000;

struct Shown {
  std::size_t frames = 0, step = 1;
  double fps = 0;
  std::vector<std::string> names;
  std::vector<double> positions;  // metres, x y z of every point, frame by frame; NaN where missing
};

Shown sampled(std::size_t frames, std::size_t points, double fps) {
  Shown shown;
  while ((frames + shown.step - 1) / shown.step > most_frames ||
         (frames + shown.step - 1) / shown.step * points > most_places)
    ++shown.step;
  shown.frames = (frames + shown.step - 1) / shown.step;
  shown.fps = fps / static_cast<double>(shown.step);
  shown.positions.reserve(shown.frames * points * 3);
  return shown;
}

void add(Shown& shown, Vec3 at) {
  shown.positions.insert(shown.positions.end(), {at.x, at.y, at.z});
}

Json encoded(const Shown& shown, const std::string& name, std::size_t frames_of_clip) {
  double least[3], size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = axis; i < shown.positions.size(); i += 3) {
      if (!std::isfinite(shown.positions[i])) continue;
      low = std::min(low, shown.positions[i]);
      high = std::max(high, shown.positions[i]);
    }
    least[axis] = std::isfinite(low) ? low : 0;
    if (std::isfinite(low)) size = std::max(size, high - low);
  }
  constexpr double most = 65534;
  const double step = size > 0 ? size / most : 1e-3;
  std::string bytes;
  bytes.reserve(shown.positions.size() * 2);
  for (std::size_t i = 0; i < shown.positions.size(); ++i) {
    const double steps = (shown.positions[i] - least[i % 3]) / step;
    const unsigned whole =
        std::isfinite(steps) ? static_cast<unsigned>(std::clamp(std::round(steps), 0.0, most)) : 65535u;
    bytes += static_cast<char>(whole & 255);
    bytes += static_cast<char>(whole >> 8);
  }
  Json::Array names;
  for (const std::string& one : shown.names) names.push_back(one);
  return Json::Object{{"name", name},
                      {"fps", shown.fps},
                      {"frames", shown.frames},
                      {"frames_of_clip", frames_of_clip},
                      {"points", std::move(names)},
                      {"origin", Json::Array{least[0], least[1], least[2]}},
                      {"step", step},
                      {"positions", base64(bytes)}};
}

// Limbs are thinner the nearer to their tip.
class Radii {
 public:
  Radii(const Skeleton& skeleton, const Figure& figure) : figure_(figure), below_(skeleton.joints.size(), 0) {
    for (const EndSite& end : skeleton.ends)
      below_[index(end.joint)] = std::max(below_[index(end.joint)], norm(end.offset));
    for (int joint = skeleton.size() - 1; joint > 0; --joint) {
      double& parent = below_[index(skeleton.joints[index(joint)].parent)];
      parent = std::max(parent, below_[index(joint)] + skeleton.link_length(joint));
    }
  }
  double at(int joint) const {
    const double height = figure_.height();
    if (figure_.side(joint) == Side::middle) return 0.04 * height;
    return height * (0.011 + 0.03 * std::min(1.0, below_[index(joint)] / (0.5 * height)));
  }
  static std::size_t index(int joint) { return static_cast<std::size_t>(joint); }

 private:
  const Figure& figure_;
  std::vector<double> below_;
};

bool is_head(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name.ends_with("head");
}

Json of_motion(const Motion& motion, const std::string& name) {
  const Skeleton& skeleton = motion.skeleton();
  const WorldMotion world = world_motion(motion);
  const std::size_t joints = skeleton.joints.size();
  Shown shown = sampled(motion.frames(), joints + skeleton.ends.size(), motion.fps());
  for (const Joint& joint : skeleton.joints) shown.names.push_back(joint.name);
  for (const EndSite& end : skeleton.ends)
    shown.names.push_back(end.name.empty() ? skeleton.joints[Radii::index(end.joint)].name + " end"
                                           : end.name);
  for (std::size_t t = 0; t < motion.frames(); t += shown.step) {
    for (int joint = 0; joint < skeleton.size(); ++joint) add(shown, world.position(joint)[t]);
    for (const EndSite& end : skeleton.ends) add(shown, point_at(world, end.joint, end.offset, t));
  }
  Json json = encoded(shown, name, motion.frames());

  const Figure figure(skeleton);
  const Radii radii(skeleton, figure);
  Json::Array bones, sides;
  const auto bone = [&](int from, std::size_t to, double radius, double end) {
    bones.push_back(Json::Array{from, to, std::round(radius * 1e4) / 1e4, std::round(end * 1e4) / 1e4});
  };
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const Side side = figure.side(joint);
    sides.push_back(side == Side::left ? 1 : side == Side::right ? -1 : 0);
    const int parent = skeleton.joints[Radii::index(joint)].parent;
    if (parent < 0 || joint == figure.body() || !skeleton.is_below(joint, figure.body())) continue;
    // From the body to a limb (a shoulder, a hip) as thin as the limb.
    const double radius = radii.at(joint);
    bone(parent, Radii::index(joint),
         std::min(radii.at(parent), figure.side(joint) == Side::middle ? 1.0 : 1.2 * radius), radius);
  }
  for (std::size_t i = 0; i < skeleton.ends.size(); ++i) {
    const EndSite& end = skeleton.ends[i];
    const Side side = figure.side(end.joint);
    sides.push_back(side == Side::left ? 1 : side == Side::right ? -1 : 0);
    const bool head = is_head(skeleton.joints[Radii::index(end.joint)].name);
    const double radius = head ? 0.043 * figure.height() : radii.at(end.joint);
    if (norm(end.offset) > 0) bone(end.joint, joints + i, radius, head ? 1.1 * radius : 0.7 * radius);
  }
  json.object()["bones"] = std::move(bones);
  json.object()["sides"] = std::move(sides);
  json.object()["body"] = figure.body();
  return json;
}

Json of_points(const Points& points, const std::string& name) {
  Shown shown = sampled(points.frames, points.labels.size(), points.fps);
  shown.names = points.labels;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t t = 0; t < points.frames; t += shown.step)
    for (int label = 0; label < static_cast<int>(points.labels.size()); ++label)
      add(shown, points.is_missing(label, t) ? Vec3{nothing, nothing, nothing} : points.track(label)[t]);
  Json json = encoded(shown, name, points.frames);
  Json::Array bones;
  for (const auto& [from, to] : points.links) bones.push_back(Json::Array{from, to, 0.004, 0.004});
  json.object()["bones"] = std::move(bones);
  json.object()["dots"] = true;
  json.object()["body"] = 0;
  return json;
}

}  // namespace

Json motion_for_page(const Value& value, const std::string& name) {
  if (const auto* motion = dynamic_cast<const Motion*>(&value); motion && motion->frames() > 0)
    return of_motion(*motion, name);
  if (const auto* points = dynamic_cast<const Points*>(&value);
      points && points->frames > 0 && !points->labels.empty())
    return of_points(*points, name);
  return nullptr;
}

}  // namespace kinegraph
