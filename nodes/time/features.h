// What time warping compares of two motions: the rotations of joints that have a partner, as rotation vectors
// about each motion's own mean, and the encoded root; each scaled so that all weigh about the same.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/encoded_root.h"
#include "nodes/motion/motion.h"
#include "nodes/time/series.h"

namespace kinegraph {

// One degree of freedom. Joints: axis 0, 1, 2 of v, named "LeftUpLeg.x"; the root's are those of ρ. The
// encoded root (joint -1): axis 0 d_x, 1 d_z, 2 height, 3 Δψ, named "root.travel_x", "root.travel_z",
// "root.height", "root.heading".
struct Dof {
  int joint = -1;
  int axis = 0;
};
inline constexpr int root_axes = 4;
const char* name_of_root_axis(int axis);
std::string name_of(const Dof& dof, const Skeleton& skeleton);
// Every DOF of a skeleton: three a joint, in order, then the root's four.
std::vector<Dof> all_dofs(const Skeleton& skeleton);

// A motion taken apart: v = 2 log(q̄⁻¹ q), rad, three dims a joint (the root's q is ρ), and q̄, the mean of
// each joint.
struct RotationVectors {
  std::vector<Quat> means;
  Series v;
};
RotationVectors rotation_vectors(const Motion& motion, const EncodedRoot& root, Work& work);

// The form in which single DOFs are carried to another clock and back. As rotation vectors about `bases`, the
// means; but the root's is 2 log(ρ ρ_rest⁻¹), whose part about up is 0: so DOFs of different frames put
// together make no heading.
std::vector<Quat> bases_of(const RotationVectors& vectors, const Skeleton& skeleton);
Series carried_vectors(const std::vector<Quat>& bases, const Motion& motion, const EncodedRoot& root,
                       Work& work);
Quat carried_rotation(const std::vector<Quat>& bases, std::size_t joint, Vec3 v);

// The time series of a root axis.
std::vector<double>& root_axis(EncodedRoot& root, int axis);
const std::vector<double>& root_axis(const EncodedRoot& root, int axis);

// One flag for each of all_dofs(): joint patterns as everywhere, `root` for the encoded root's four, and
// single DOFs by name. Read left to right; a first `-` starts from all. Errors and warnings as chosen_joints.
std::vector<bool> chosen_dofs(std::string_view pattern, const Skeleton& skeleton, std::string_view param,
                              Work& work);

// The chosen DOFs that move in at least one of the motions, without their means; a joint's three divided by
// its pooled spread σ (root mean square half-angle to the mean over both motions' frames, at least 0.05 rad),
// root axes by their pooled σ (at least 0.001). `partner`: for each joint of the source one of the reference,
// or -1.
struct Features {
  std::vector<Dof> dofs;  // of the source, one a dimension
  Series source, reference;
};
Features features_of(const RotationVectors& source, const EncodedRoot& source_root,
                     const RotationVectors& reference, const EncodedRoot& reference_root,
                     const std::vector<int>& partner, const std::vector<bool>& chosen, Work& work);

}  // namespace kinegraph
