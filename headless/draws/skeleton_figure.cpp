#include "headless/draws/skeleton_figure.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "headless/draws/theme.h"
#include "nodes/motion/elementary.h"

namespace kinegraph {

namespace {

// The convex hull of spots, clockwise on the page (Andrew's monotone chain).
std::vector<Spot> hull_of(std::vector<Spot> spots) {
  std::sort(spots.begin(), spots.end(),
            [](Spot a, Spot b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  auto turn = [](Spot o, Spot a, Spot b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); };
  std::vector<Spot> hull;
  for (int pass = 0; pass < 2; ++pass) {
    std::size_t start = hull.size();
    for (Spot spot : spots) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), spot) <= 0) hull.pop_back();
      hull.push_back(spot);
    }
    hull.pop_back();
    std::reverse(spots.begin(), spots.end());
  }
  return hull;
}

}  // namespace

Color side_color(Side side) {
  return side == Side::left ? theme::left : side == Side::right ? theme::right : theme::centre;
}

Figure::Figure(const Skeleton& skeleton) {
  RestPose rest = rest_pose(skeleton);
  height_ = rest_height(skeleton);
  std::size_t count = static_cast<std::size_t>(skeleton.size());
  below_.assign(count, 0);
  for (const auto& end : skeleton.ends) below_[end.joint] = std::max(below_[end.joint], norm(end.offset));
  for (int joint = skeleton.size() - 1; joint > 0; --joint) {
    int parent = skeleton.joints[joint].parent;
    below_[parent] = std::max(below_[parent], below_[joint] + skeleton.link_length(joint));
  }
  const Body body = find_body(skeleton);
  if (!body.legs.empty()) body_joint_ = body.pelvis;
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (skeleton.is_below(joint, body_joint_)) joints_.push_back(joint);
  // A rest pose can be flat (all offsets along one axis): the longest way down is a height too.
  if (count > 0) height_ = std::max(height_, 1.2 * below_[body_joint_]);
  if (!(height_ > 1e-9)) height_ = 1;
  in_body_.assign(count, false);
  find_sides(skeleton, body);
  find_trunk(skeleton, body, rest);

  const int head = body.head;
  for (int joint : joints_) {
    if (joint == body_joint_) continue;
    if (in_body_[joint] || skeleton.link_length(joint) < 0.003 * height_) continue;
    if (head >= 0 && joint != head && skeleton.is_below(joint, head))
      continue;  // eyes, jaw: the head hides them
    int parent = skeleton.joints[joint].parent;
    limbs_.push_back({{parent, {}, std::min(radius_at(parent), radius_at(joint) + 0.012 * height_)},
                      {joint, {}, radius_at(joint)},
                      parent});
  }
  std::vector<bool> tipped(count, false);
  for (const auto& end : skeleton.ends) {
    if (!skeleton.is_below(end.joint, body_joint_) || end.joint == head ||
        norm(end.offset) < 0.003 * height_ || tipped[end.joint])
      continue;
    if (head >= 0 && skeleton.is_below(end.joint, head)) continue;
    tipped[end.joint] = true;
    double radius = std::min(radius_at(end.joint), 0.012 * height_);
    limbs_.push_back({{end.joint, {}, radius_at(end.joint)}, {end.joint, end.offset, radius}, end.joint});
  }
  if (head >= 0) {
    Vec3 tip{0, 0.09 * height_, 0};
    if (int neck = skeleton.joints[head].parent; neck >= 0 && skeleton.link_length(head) > 0.003 * height_)
      tip = rotate(inverse(rest.orientations[head]),
                   0.09 * height_ * normalized(rest.positions[head] - rest.positions[neck]));
    for (const auto& end : skeleton.ends)
      if (end.joint == head && norm(end.offset) > 0.02 * height_) tip = end.offset;
    if (norm(tip) > 0.16 * height_) tip = (0.16 * height_ / norm(tip)) * tip;
    limbs_.push_back({{head, 0.15 * tip, 0.04 * height_}, {head, tip, 0.04 * height_}, head, true});
  }

  for (const Leg& leg : body.legs) feet_.push_back(leg.toe >= 0 ? leg.toe : leg.ankle);
  for (const Arm& arm : body.arms)
    if (arm.hand >= 0) hands_.push_back(arm.hand);
}

double Figure::reach(int joint) const {
  double reach = 0.07 * height_;
  for (const Limb& limb : limbs_)
    if (limb.head && limb.joint == joint) reach = std::max(reach, norm(limb.to.local) + 1.5 * limb.to.radius);
  return reach;
}

// Thicker the more there is below: hips over knees over ankles, arms over fingers.
double Figure::radius_at(int joint) const {
  return height_ *
         (0.008 + 0.032 * std::min(1.0, below_[static_cast<std::size_t>(joint)] / (0.55 * height_)));
}

void Figure::find_sides(const Skeleton& skeleton, const Body& body) {
  for (const Joint& joint : skeleton.joints) sides_.push_back(read_joint_name(joint.name).side);
  const auto mark = [&](int joint, bool left) {
    if (joint >= 0 && sides_[joint] == Side::middle) sides_[joint] = left ? Side::left : Side::right;
  };
  for (const Leg& leg : body.legs) mark(leg.hip, leg.left);
  for (const Arm& arm : body.arms) mark(arm.clavicle >= 0 ? arm.clavicle : arm.upper, arm.left);
  for (int joint = 1; joint < skeleton.size(); ++joint)
    if (sides_[joint] == Side::middle) sides_[joint] = sides_[skeleton.joints[joint].parent];
}

void Figure::find_trunk(const Skeleton& skeleton, const Body& body, const RestPose& rest) {
  const auto& legs = body.legs;
  if (legs.size() != 2 || body.arms.size() != 2) return;
  const int shoulders[2] = {body.arms[0].upper, body.arms[1].upper};
  std::vector<int> spine;  // from the root up to where the arms part
  for (int joint = shoulders[0]; joint >= body_joint_; joint = skeleton.joints[joint].parent)
    if (skeleton.is_below(shoulders[1], joint)) spine.insert(spine.begin(), joint);
  if (spine.size() < 2 || skeleton.is_below(legs[0].hip, spine[1])) return;

  Part pelvis{{}, spine[0]}, chest{{}, spine.back()};
  std::size_t waist = spine.size() / 2;
  for (int hip : {legs[0].hip, legs[1].hip}) pelvis.balls.push_back({hip, {}, 0.04 * height_});
  for (std::size_t i = 0; i < spine.size(); ++i) {
    Ball ball{spine[i], {}, (i == waist ? 0.054 : 0.046) * height_};
    if (i <= waist) pelvis.balls.push_back(ball);
    if (i >= waist) chest.balls.push_back(ball);
  }
  // The waist has a width of its own, or the body would be an hourglass.
  Vec3 across = rest.positions[legs[0].hip] - rest.positions[legs[1].hip];
  for (double way : {-0.026, 0.026}) {
    Vec3 local = rotate(inverse(rest.orientations[spine[waist]]), way * height_ * normalized(across));
    chest.balls.push_back({spine[waist], local, 0.046 * height_});
    pelvis.balls.push_back({spine[waist], local, 0.046 * height_});
  }
  for (int shoulder : shoulders) chest.balls.push_back({shoulder, {}, 0.03 * height_});
  body_ = {pelvis, chest};
  for (int end : {legs[0].hip, legs[1].hip, shoulders[0], shoulders[1]})
    for (int joint = end; joint > 0; joint = skeleton.joints[joint].parent) in_body_[joint] = true;
}

void Figure::draw(Canvas& canvas, const Camera& camera, const Pose& pose, Vec3 origin, Spot at,
                  const JointColor& color) const {
  auto world = [&](const Ball& ball) {
    return pose.positions[ball.joint] + rotate(pose.orientations[ball.joint], ball.local);
  };
  auto page = [&](Vec3 point) { return at + camera.project(point - origin); };
  const double scale = camera.scale();
  const double halo = std::clamp(0.008 * height_ * scale, 0.5, 2.2);
  const double middle_depth =
      camera.depth(pose.positions.empty() ? Vec3{} : pose.positions[static_cast<std::size_t>(body_joint_)]);

  struct Piece {
    double depth;
    Outline outline;
    Paint paint;
  };
  std::vector<Piece> pieces;
  // Paler behind, full in front; lit from above left.
  auto shades = [&](Color base, double depth) {
    double behind = std::clamp(0.16 - (depth - middle_depth) / (0.5 * height_), 0.0, 0.42);
    base = mixed(base, theme::paper, behind);
    return std::vector<Stop>{
        {0, mixed(base, theme::paper, 0.34)}, {0.45, base}, {1, mixed(base, theme::ink, 0.34)}};
  };
  auto color_of = [&](int joint) { return color ? color(joint) : side_color(side(joint)); };

  for (const auto& limb : limbs_) {
    Vec3 from = world(limb.from), to = world(limb.to);
    Spot a = page(from), b = page(to);
    double depth = (camera.depth(from) + camera.depth(to)) / 2;
    if (!limb.head && side(limb.to.joint) == Side::middle)
      depth -= 0.15 * height_;  // a neck comes out of the chest
    double widest = std::max(limb.from.radius, limb.to.radius) * scale;
    Spot along = b - a;
    double length = std::sqrt(along.x * along.x + along.y * along.y);
    Spot across = length > 1e-6 ? Spot{along.y / length, -along.x / length} : Spot{-0.6, -0.8};
    if (across.x * -0.5 + across.y * -0.87 < 0) across = -1 * across;
    auto joint_color = limb.head ? color_of(limb.joint) : color_of(limb.to.joint);
    Paint paint = limb.head
                      ? Paint::around(0.5 * (a + b) + widest * Spot{-0.4, -0.6}, 2.4 * widest,
                                      shades(joint_color, depth))
                      : Paint::along(a + widest * across, a - widest * across, shades(joint_color, depth));
    Outline outline = limb.head ? ellipse(0.5 * (a + b), 0.5 * length + widest, 1.12 * widest,
                                          length > 1e-6 ? arc_tangent2(along.y, along.x) : 0)
                                : capsule(a, limb.from.radius * scale, b, limb.to.radius * scale);
    pieces.push_back({depth, std::move(outline), std::move(paint)});
  }
  for (const auto& part : body_) {
    std::vector<Spot> rim;
    double depth = 0, left = 1e300, right = -1e300;
    for (const auto& ball : part.balls) {
      Vec3 point = world(ball);
      depth += camera.depth(point) / static_cast<double>(part.balls.size());
      Spot centre = page(point);
      for (int i = 0; i < 24; ++i) {
        auto turned = sin_cos(2 * pi * i / 24);
        rim.push_back(centre + ball.radius * scale * Spot{turned.cos, turned.sin});
        left = std::min(left, rim.back().x);
        right = std::max(right, rim.back().x);
      }
    }
    pieces.push_back(
        {depth, polyline(hull_of(std::move(rim)), true),
         Paint::along({left, 0}, {right, 0.25 * (right - left)}, shades(color_of(part.joint), depth))});
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.depth < b.depth; });
  for (auto& piece : pieces) {
    canvas.stroke(piece.outline, {faded(theme::paper, 0.9), 2 * halo});
    canvas.fill(std::move(piece.outline), std::move(piece.paint));
  }
}

void Figure::draw_shadow(Canvas& canvas, const Camera& camera, const Pose& pose, Vec3 origin, Spot at,
                         double floor) const {
  // A low sun from the upper left behind the viewer would tangle the figures; straight down keeps each by
  // itself.
  auto page = [&](Vec3 point) { return at + camera.project(Vec3{point.x, floor, point.z} - origin); };
  canvas.begin_group(0.16);
  auto cast = [&](Vec3 from, Vec3 to, double radius) {
    Spot a = page(from), b = page(to);
    double flat = std::max(0.25, camera.flattening()) * 2.2;
    canvas.stroke(polyline({a, b}), {theme::ink, std::max(0.8, radius * camera.scale() * flat)});
  };
  auto world = [&](const Ball& ball) {
    return pose.positions[ball.joint] + rotate(pose.orientations[ball.joint], ball.local);
  };
  for (const auto& limb : limbs_) cast(world(limb.from), world(limb.to), limb.from.radius);
  for (const auto& part : body_)
    for (const auto& ball : part.balls) cast(world(part.balls[0]), world(ball), ball.radius);
  canvas.end();
}

}  // namespace kinegraph
