#include "nodes/motion/rotation.h"

#include <limits>
#include <stdexcept>

#include "nodes/motion/elementary.h"

namespace kinegraph {

Vec3 log(Quat q) {
  Vec3 v{q.x, q.y, q.z};
  double square = dot(v, v);
  if (square < 1e-280) {  // sin α and α are the same number here, and the square may have lost digits
    if (q.w >= 0) return v;
    v = 1e160 * v;
    return norm(v) > 0 ? pi * normalized(v) : Vec3{pi, 0, 0};
  }
  double sine = std::sqrt(square);
  return (arc_tangent2(sine, q.w) / sine) * v;
}

Quat exp(Vec3 half_angle) {
  double square = dot(half_angle, half_angle);
  if (square < 1e-280) return {half_angle.x, half_angle.y, half_angle.z, 1};
  double angle = std::sqrt(square);
  auto [sin, cos] = sin_cos(angle);
  double s = sin / angle;
  return {s * half_angle.x, s * half_angle.y, s * half_angle.z, cos};
}

double turn(Quat q) {
  // atan2 keeps tiny angles, which an arccos of w would lose below 1e-8.
  return 2 * arc_tangent2(norm({q.x, q.y, q.z}), std::fabs(q.w));
}
double turn(Quat a, Quat b) {
  return turn(inverse(a) * b);
}

Quat slerp(double t, Quat a, Quat b) {
  b = nearer(b, a);
  Quat difference{b.x - a.x, b.y - a.y, b.z - a.z, b.w - a.w};
  Quat sum{a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
  double chord = std::sqrt(dot(difference, difference));
  double angle =
      2 * arc_tangent2(chord, std::sqrt(dot(sum, sum)));  // between a and b on the sphere, at most π/2
  double from = 1 - t, to = t;
  if (angle > 1e-8) {
    double sin = sine(angle);
    from = sine(from * angle) / sin;
    to = sine(to * angle) / sin;
  }
  Quat q{from * a.x + to * b.x, from * a.y + to * b.y, from * a.z + to * b.z, from * a.w + to * b.w};
  // Between the ends the weights keep the length; beyond them they magnify what the ends lack of it.
  return t < 0 || t > 1 ? normalized(q) : q;
}

Quat axis_angle(Vec3 unit_axis, double radians) {
  auto [sin, cos] = sin_cos(0.5 * radians);
  return {sin * unit_axis.x, sin * unit_axis.y, sin * unit_axis.z, cos};
}

Quat about_y(double radians) {
  auto [sin, cos] = sin_cos(0.5 * radians);
  return {0, sin, 0, cos};
}

Quat smallest_turn(Vec3 from, Vec3 to) {
  // The direction is all that counts: the largest component first, so that no square over- or underflows.
  auto unit = [](Vec3 v) {
    double largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
    return largest > 0 ? normalized(v / largest) : Vec3{};
  };
  Vec3 a = unit(from), b = unit(to);
  if (a == Vec3{} || b == Vec3{}) return {};
  Vec3 sum = a + b;
  double twice_cos_half = norm(sum);
  // a × b = a × (a + b), and near the opposite the sum is exact where the product has lost its digits.
  Vec3 axis = twice_cos_half > 0.5 ? cross(a, b) : cross(a, sum);
  if (twice_cos_half > 0.5) {
    axis = axis / twice_cos_half;
    return normalized(Quat{axis.x, axis.y, axis.z, 0.5 * twice_cos_half});
  }
  if (norm(axis) < 1e-15) {  // opposite: about any axis across
    double x = std::fabs(a.x), y = std::fabs(a.y), z = std::fabs(a.z);
    Vec3 least = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    axis = cross(a, least);
  }
  axis = normalized(axis);
  double sin_half = 0.5 * norm(b - a);
  return normalized(Quat{sin_half * axis.x, sin_half * axis.y, sin_half * axis.z, 0.5 * twice_cos_half});
}

Quat twist_about(Quat q, Vec3 unit_axis) {
  double along = q.x * unit_axis.x + q.y * unit_axis.y + q.z * unit_axis.z;
  return normalized(Quat{along * unit_axis.x, along * unit_axis.y, along * unit_axis.z, q.w});
}

double heading_of(Quat q) {
  double heading = 2 * arc_tangent2(q.y, q.w);
  if (heading > pi) return heading - 2 * pi;
  return heading <= -pi ? heading + 2 * pi : heading;
}

void make_continuous(std::span<double> x, std::span<double> y, std::span<double> z, std::span<double> w) {
  for (std::size_t t = 1; t < w.size(); ++t) {
    if (x[t] * x[t - 1] + y[t] * y[t - 1] + z[t] * z[t - 1] + w[t] * w[t - 1] < 0) {
      x[t] = -x[t];
      y[t] = -y[t];
      z[t] = -z[t];
      w[t] = -w[t];
    }
  }
}

namespace {

int axis_index(char axis) {
  int index = axis - 'X';
  if (index < 0 || index > 2) throw std::logic_error("an Euler axis is X, Y or Z");
  return index;
}

double component(const Quat& q, int axis) {
  return axis == 0 ? q.x : axis == 1 ? q.y : q.z;
}

// `angle` moved by whole turns to within half a turn of `near`.
double nearest_turn(double angle, double near) {
  return angle + 2 * pi * std::floor((near - angle) / (2 * pi) + 0.5);
}

double distance2(const std::array<double, 3>& a, const double* b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace

Quat from_euler(std::string_view axes, const double* radians) {
  Quat q;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    auto [sin, cos] = sin_cos(0.5 * radians[i]);
    int axis = axis_index(axes[i]);
    // The product with a rotation about one axis: half of the sixteen terms vanish.
    if (axis == 0) {
      q = {q.x * cos + q.w * sin, q.y * cos + q.z * sin, q.z * cos - q.y * sin, q.w * cos - q.x * sin};
    } else if (axis == 1) {
      q = {q.x * cos - q.z * sin, q.y * cos + q.w * sin, q.z * cos + q.x * sin, q.w * cos - q.y * sin};
    } else {
      q = {q.x * cos + q.y * sin, q.y * cos - q.x * sin, q.z * cos + q.w * sin, q.w * cos - q.z * sin};
    }
  }
  return q;
}

// With i, j, k the axes in order, ε their parity and q = exp(iα/2) exp(jβ/2) exp(kγ/2),
//   w + q_j = √2 sin((β + π/2)/2) cos((α + εγ)/2),   q_i + ε q_k = √2 sin((β + π/2)/2) sin((α + εγ)/2),
//   w - q_j = √2 cos((β + π/2)/2) cos((α - εγ)/2),   q_i - ε q_k = √2 cos((β + π/2)/2) sin((α - εγ)/2):
// half sum and half difference by one atan2 each, and the middle angle by a third, without an arcsine's loss
// at ±90°.
std::array<double, 3> to_euler(Quat q, std::string_view axes, const double* near) {
  int i = axis_index(axes[0]), j = axis_index(axes[1]), k = axis_index(axes[2]);
  if (axes.size() != 3 || i == j || j == k || i == k)
    throw std::logic_error("Euler angles need three distinct axes");
  double parity = (j - i + 3) % 3 == 1 ? 1 : -1;
  static constexpr double zero[3] = {0, 0, 0};
  const double* wished = near ? near : zero;

  double qi = component(q, i), qj = component(q, j), qk = parity * component(q, k);
  double sum_cos = q.w + qj, sum_sin = qi + qk, difference_cos = q.w - qj, difference_sin = qi - qk;
  double sum_length = std::sqrt(sum_cos * sum_cos + sum_sin * sum_sin);
  double difference_length = std::sqrt(difference_cos * difference_cos + difference_sin * difference_sin);
  double half_sum = arc_tangent2(sum_sin, sum_cos);
  double half_difference = arc_tangent2(difference_sin, difference_cos);
  double middle = 2 * arc_tangent2(sum_length, difference_length) - 0.5 * pi;
  double first = half_sum + half_difference;
  double last = half_sum - half_difference;
  // Where one of the two lengths is no more than rounding, only the other's angle is known.
  constexpr double singular = 1e-12;
  if (sum_length < singular) {
    first = wished[0];
    last = first - 2 * half_difference;
  } else if (difference_length < singular) {
    first = wished[0];
    last = 2 * half_sum - first;
  }

  // The same rotation twice: (α, β, γ) and (α + π, π - β, γ + π), each with whole turns.
  std::array<double, 3> one{nearest_turn(first, wished[0]), nearest_turn(middle, wished[1]),
                            nearest_turn(parity * last, wished[2])};
  // The first and last angle of the other lie π away from these, so it can't be nearer where these are near.
  const double to_first = pi - std::fabs(one[0] - wished[0]), to_last = pi - std::fabs(one[2] - wished[2]);
  if (distance2(one, wished) < 0.99 * (to_first * to_first + to_last * to_last)) return one;
  std::array<double, 3> other{nearest_turn(first + pi, wished[0]), nearest_turn(pi - middle, wished[1]),
                              nearest_turn(parity * last + pi, wished[2])};
  if (sum_length < singular || difference_length < singular) {
    // Here any first angle will do, so the other family is no further solution but the same one.
    return one;
  }
  return distance2(other, wished) < distance2(one, wished) ? other : one;
}

}  // namespace kinegraph
