#include "gui/viewer/shown_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gui/viewer/marker_links.h"
#include "headless/draws/skeleton_figure.h"
#include "nodes/feet/detect_contacts.h"
#include "nodes/motion/body.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/points.h"

namespace kinegraph {
namespace {

using Point3 = ShownMotion::Point3;

Point3 narrowed(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Thickness of the bone that ends at each joint: more where more hangs below, as in a body.
std::vector<double> reaches(const Skeleton& skeleton) {
  std::vector<double> below(static_cast<std::size_t>(skeleton.size()), 0.0);
  for (const EndSite& end : skeleton.ends)
    below[static_cast<std::size_t>(end.joint)] =
        std::max(below[static_cast<std::size_t>(end.joint)], norm(end.offset));
  for (int joint = skeleton.size() - 1; joint > 0; --joint) {
    const int parent = skeleton.joints[static_cast<std::size_t>(joint)].parent;
    if (parent < 0) continue;
    double& way = below[static_cast<std::size_t>(parent)];
    way = std::max(way, below[static_cast<std::size_t>(joint)] + skeleton.link_length(joint));
  }
  return below;
}

void find_bones(ShownMotion& shown, const Skeleton& skeleton, const Figure& figure) {
  const std::vector<double> below = reaches(skeleton);
  const double height = figure.height();
  const auto side_of = [&](int joint) {
    switch (figure.side(joint)) {
      case Side::left:
        return ShownMotion::Side::left;
      case Side::right:
        return ShownMotion::Side::right;
      default:
        return ShownMotion::Side::middle;
    }
  };
  const auto radius = [&](double way) {
    return static_cast<float>(height * (0.009 + 0.026 * std::min(1.0, way / (0.55 * height))));
  };
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const Joint& one = skeleton.joints[static_cast<std::size_t>(joint)];
    shown.names.push_back(one.name);
    shown.parents.push_back(one.parent);
    shown.sides.push_back(side_of(joint));
    // What stands above the body (a root left at the world's origin) isn't part of it.
    if (joint == figure.body() || !skeleton.is_below(joint, figure.body())) continue;
    const double length = skeleton.link_length(joint) * skeleton.above_scale;
    if (length < 0.003 * height) continue;
    shown.bones.push_back({one.parent, joint,
                           std::min(radius(below[static_cast<std::size_t>(joint)] + 0.6 * length),
                                    static_cast<float>(0.45 * length)),
                           side_of(joint), static_cast<float>(length), joint});
  }
  for (const EndSite& end : skeleton.ends) {
    const int point = static_cast<int>(shown.names.size());
    shown.names.emplace_back();
    shown.parents.push_back(end.joint);
    shown.sides.push_back(side_of(end.joint));
    const double length = norm(end.offset) * skeleton.above_scale;
    if (length < 0.003 * height || !skeleton.is_below(end.joint, figure.body())) continue;
    const bool head =
        skeleton.joints[static_cast<std::size_t>(end.joint)].name.find("ead") != std::string::npos;
    const float thick = static_cast<float>((head ? 0.042 : 0.011) * height);
    shown.bones.push_back({end.joint, point,
                           head ? thick : std::min(thick, static_cast<float>(0.45 * length)),
                           side_of(end.joint), static_cast<float>(length), -1, head});
  }
}

// A skeleton may end where the head begins: then the head stands on its last joint, in line with the neck.
void find_head(ShownMotion& shown, const Skeleton& skeleton, const Figure& figure) {
  for (const ShownMotion::Bone& bone : shown.bones)
    if (bone.head) return;
  const Body body = find_body(skeleton);
  const int head = body.head >= 0 || body.neck.empty() ? body.head : body.neck.back();
  if (head <= 0) return;
  const auto height = static_cast<float>(figure.height());
  const int parent = skeleton.joints[static_cast<std::size_t>(head)].parent;
  shown.bones.push_back(
      {parent, head, 0.042f * height, ShownMotion::Side::middle, 0, -1, true, 0.11f * height});
}

void find_box(ShownMotion& shown) {
  const float inf = std::numeric_limits<float>::infinity();
  shown.low = {inf, inf, inf};
  shown.high = {-inf, -inf, -inf};
  for (const Point3& p : shown.positions) {
    if (std::isnan(p.x)) continue;
    shown.low = {std::min(shown.low.x, p.x), std::min(shown.low.y, p.y), std::min(shown.low.z, p.z)};
    shown.high = {std::max(shown.high.x, p.x), std::max(shown.high.y, p.y), std::max(shown.high.z, p.z)};
  }
  if (!(shown.low.x <= shown.high.x)) shown.low = shown.high = {};
}

void find_stretch(ShownMotion& shown, const Motion& motion) {
  bool changes = false;
  for (const ShownMotion::Bone& bone : shown.bones)
    if (bone.joint > 0 && motion.translates(bone.joint)) changes = true;
  if (!changes) return;
  shown.stretch.reserve(static_cast<std::size_t>(shown.frames) * shown.bones.size());
  for (int frame = 0; frame < shown.frames; ++frame)
    for (const ShownMotion::Bone& bone : shown.bones) {
      const Point3 a = shown.at(frame, bone.from), b = shown.at(frame, bone.to);
      const float length =
          std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
      shown.stretch.push_back(bone.rest_length > 0 ? length / bone.rest_length : 1.0f);
    }
  // What is too little for a colour is none.
  if (std::none_of(shown.stretch.begin(), shown.stretch.end(),
                   [](float s) { return std::abs(s - 1) >= ShownMotion::least_stretch; }))
    shown.stretch.clear();
}

void find_contacts(ShownMotion& shown, const Motion& motion, const WorldMotion& world, Work& work) {
  try {
    shown.contacts = detect_contacts(motion, DetectContactsParams{}, work);
  } catch (const Failure&) {
    shown.contacts = Contacts();  // no feet, no marks
  }
  for (const FootPoint& point : shown.contacts.points) {
    auto& spots = shown.contact_spots.emplace_back();
    for (int frame = 0; frame < shown.frames; ++frame)
      spots.push_back(narrowed(point_at(world, point.joint, point.local, static_cast<std::size_t>(frame))));
  }
  if (!shown.contacts.points.empty()) shown.floor = shown.contacts.floor;
}

std::shared_ptr<const ShownMotion> of_motion(const Motion& motion, ValuePtr value, Work& work) {
  auto shown = std::make_shared<ShownMotion>();
  const Skeleton& skeleton = motion.skeleton();
  if (motion.frames() == 0 || skeleton.size() == 0) return nullptr;
  shown->value = std::move(value);
  shown->fps = motion.fps();
  shown->frames = static_cast<int>(motion.frames());
  const Figure figure(skeleton);
  shown->size = figure.height();
  find_bones(*shown, skeleton, figure);
  find_head(*shown, skeleton, figure);
  shown->points = skeleton.size() + static_cast<int>(skeleton.ends.size());
  const WorldMotion world = world_motion(motion, work);
  const std::size_t points = static_cast<std::size_t>(shown->points);
  shown->positions.resize(static_cast<std::size_t>(shown->frames) * points);
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    work.check();
    const ConstVec3Track track = world.position(joint);
    for (std::size_t frame = 0; frame < motion.frames(); ++frame)
      shown->positions[frame * points + static_cast<std::size_t>(joint)] = narrowed(track[frame]);
  }
  for (std::size_t i = 0; i < skeleton.ends.size(); ++i) {
    const EndSite& end = skeleton.ends[i];
    const std::size_t point = static_cast<std::size_t>(skeleton.size()) + i;
    for (std::size_t frame = 0; frame < motion.frames(); ++frame)
      shown->positions[frame * points + point] = narrowed(point_at(world, end.joint, end.offset, frame));
  }
  find_box(*shown);
  find_stretch(*shown, motion);
  find_contacts(*shown, motion, world, work);
  return shown;
}

std::shared_ptr<const ShownMotion> of_points(const Points& markers, ValuePtr value, Work& work) {
  auto shown = std::make_shared<ShownMotion>();
  if (markers.frames == 0 || markers.labels.empty()) return nullptr;
  shown->value = std::move(value);
  shown->markers = true;
  shown->fps = markers.fps;
  shown->frames = static_cast<int>(markers.frames);
  shown->names = markers.labels;
  shown->points = static_cast<int>(markers.labels.size());
  shown->parents.assign(markers.labels.size(), -1);
  shown->sides.assign(markers.labels.size(), ShownMotion::Side::middle);
  const std::size_t points = markers.labels.size();
  shown->positions.resize(markers.frames * points);
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t label = 0; label < points; ++label) {
    work.check();
    const ConstVec3Track track = markers.track(static_cast<int>(label));
    for (std::size_t frame = 0; frame < markers.frames; ++frame)
      shown->positions[frame * points + label] = markers.is_missing(static_cast<int>(label), frame)
                                                     ? Point3{none, none, none}
                                                     : narrowed(track[frame]);
  }
  find_box(*shown);
  const Point3 low = shown->low, high = shown->high;
  shown->size =
      std::max({0.05, static_cast<double>(high.y - low.y), 0.3 * (high.x - low.x), 0.3 * (high.z - low.z)});
  // Markers of a face hang in the air: their floor lies under them.
  shown->floor = low.y > shown->size || low.y < -0.5 * shown->size ? low.y : 0;
  const auto& given = markers.links;
  std::vector<std::pair<int, int>> links(given.begin(), given.end());
  if (links.empty()) links = steady_links(*shown);
  for (const auto& [from, to] : links)
    shown->bones.push_back(
        {from, to, static_cast<float>(0.0035 * shown->size), ShownMotion::Side::middle, 0, -1});
  return shown;
}

}  // namespace

Point3 ShownMotion::root(int frame) const {
  if (!markers) return at(frame, 0);
  Point3 sum;
  float count = 0;
  for (int point = 0; point < points; ++point) {
    const Point3& p = at(frame, point);
    if (std::isnan(p.x)) continue;
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
    ++count;
  }
  return count > 0 ? Point3{sum.x / count, sum.y / count, sum.z / count} : sum;
}

int ShownMotion::frame_at(double seconds) const {
  return std::clamp(static_cast<int>(std::floor(seconds * fps + 1e-6)), 0, std::max(0, frames - 1));
}

std::shared_ptr<const ShownMotion> make_shown_motion(ValuePtr value, Work& work) {
  if (const auto* motion = dynamic_cast<const Motion*>(value.get())) return of_motion(*motion, value, work);
  if (const auto* points = dynamic_cast<const Points*>(value.get())) return of_points(*points, value, work);
  return nullptr;
}

}  // namespace kinegraph
