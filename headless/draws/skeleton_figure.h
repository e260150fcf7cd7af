// A skeleton drawn as a solid-looking figure: tapered, shaded limbs, a body, a head. Left is blue, right is
// orange, the middle grey; what is farther from the viewer is paler.
#pragma once
#include <functional>
#include <vector>

#include "headless/draws/camera.h"
#include "headless/draws/canvas.h"
#include "nodes/motion/body.h"
#include "nodes/motion/joint_names.h"
#include "nodes/motion/kinematics.h"
#include "nodes/motion/skeleton.h"

namespace kinegraph {

Color side_color(Side side);

// What is drawn for a skeleton, found once for all its poses.
class Figure {
 public:
  explicit Figure(const Skeleton& skeleton);

  double height() const { return height_; }  // of the rest pose, m; never 0
  // The joint that carries the body: where the legs part, else the root. What is above it (a root left at the
  // world's origin) isn't drawn.
  int body() const { return body_joint_; }
  const std::vector<int>& joints() const { return joints_; }  // body() and all below it
  // How far the drawing stands out beyond the joint, m: of the head by all of it.
  double reach(int joint) const;
  Side side(int joint) const { return sides_[static_cast<std::size_t>(joint)]; }
  const std::vector<int>& feet() const {
    return feet_;
  }  // joints whose trails tell how it walks: toes or ankles
  const std::vector<int>& hands() const { return hands_; }

  using JointColor = std::function<Color(int joint)>;
  // The pose with the world point `origin` put at `at`. `color`: of each joint's limb, else by side.
  void draw(Canvas& canvas, const Camera& camera, const Pose& pose, Vec3 origin, Spot at,
            const JointColor& color = nullptr) const;
  // Its shadow on the floor (world height `floor`), to be drawn before it.
  void draw_shadow(Canvas& canvas, const Camera& camera, const Pose& pose, Vec3 origin, Spot at,
                   double floor) const;

 private:
  struct Ball {  // a point of a limb: fixed in a joint's frame
    int joint;
    Vec3 local;
    double radius;  // m
  };
  struct Limb {
    Ball from, to;
    int joint;  // the one that turns it
    bool head = false;
  };
  struct Part {  // a convex piece of the body
    std::vector<Ball> balls;
    int joint;
  };
  void find_sides(const Skeleton& skeleton, const Body& body);
  void find_trunk(const Skeleton& skeleton, const Body& body, const RestPose& rest);
  double radius_at(int joint) const;

  double height_ = 1;
  int body_joint_ = 0;
  std::vector<int> joints_;
  std::vector<Side> sides_;
  std::vector<double> below_;  // longest way from the joint to a tip below it, m
  std::vector<int> feet_, hands_;
  std::vector<Limb> limbs_;
  std::vector<Part> body_;
  std::vector<bool> in_body_;  // the link from the joint's parent to it lies inside the body
};

}  // namespace kinegraph
