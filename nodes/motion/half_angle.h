// The half-angle of a rotation without an arc tangent, for loops over every frame of every joint.
#pragma once

namespace kinegraph {

// θ / sin θ for θ in [0, π/2] with sin² θ = sine2 and cos θ = cosine: the vector part of a unit quaternion
// with w >= 0 times this is its log. Within 4 ulp.
double angle_over_sine(double sine2, double cosine);

}  // namespace kinegraph
