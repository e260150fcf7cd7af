// The suspended mass-spring chain that makes limbs follow through [Kwon §5.4]. Unit masses in a tree, each
// hooked to a driven particle s:
//   ẍ = hook (s − x) + Σ_neighbours link (|Δ| − ℓ(t)) Δ/|Δ| − drag (ẋ − v_drag),
// ℓ(t) the present length of that link in the driven motion.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "graph/work.h"
#include "nodes/motion/rotation.h"

namespace kinegraph {

struct MassSpringParams {
  double hook = 300;         // s⁻²
  double link = 600;         // s⁻²
  double drag = 12;          // s⁻¹
  bool drag_in_root = true;  // v_drag is particle 0's driven velocity, else 0
  int substeps = 0;          // of a frame at least; 0 = by fps and stiffness
};

// Positions of all particles, frame after frame: at[frame * particles + particle].
struct ParticlePath {
  std::size_t particles = 0;
  std::vector<Vec3> at;
  std::size_t frames() const { return particles ? at.size() / particles : 0; }
};

struct MassSpringResult {
  ParticlePath positions;
  ParticlePath velocities;  // empty unless asked for
};

// `parents`: of each particle, smaller than its own index; -1 = none. `driven` goes through its frames on C1
// cubics. Starts at the driven positions and velocities.
//
// Each step takes the mean of old and new velocity and, for a link, the discrete gradient of its energy
//   −link (1 − 2ℓ / (r⁺ + r)) (Δ⁺ + Δ)/2,   r = |Δ|,
// whose work is exactly the change of the link's energy: so with the driven particles at rest the total
// energy only falls, by the drag's work, whatever the stiffness and the step [Gonzalez, Time Integration and
// Discrete Hamiltonian Systems, 1996]. Second order. For a given r⁺ the unknown velocities solve a linear
// system on the tree, the same for all axes; r⁺ is found by repetition, some five times at the defaults, for
// which the step is held under ½ / √link. Where the driven jump (their speed changes by over 8 times the
// tree's height a second from one frame to the next, as out of a T-pose put before a clip), the half second
// that starts there takes twice as many steps, since what is left of an error grows with the jump.
MassSpringResult simulate(const std::vector<int>& parents, const ParticlePath& driven, double fps,
                          const MassSpringParams& params, bool with_velocities, Work& work);

// Kinetic energy, hooks and links of one state; `rest`: the driven particles.
double energy_of(const std::vector<int>& parents, std::span<const Vec3> rest, std::span<const Vec3> x,
                 std::span<const Vec3> v, const MassSpringParams& params);

}  // namespace kinegraph
