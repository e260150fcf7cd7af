// A polynomial of degree five between two states of a coordinate: so that pieces join in value, speed and
// acceleration.
#pragma once

namespace kinegraph {

struct CoordinateState {
  double value = 0, speed = 0, acceleration = 0;
};

class Quintic {
 public:
  Quintic(const CoordinateState& from, const CoordinateState& to, double seconds)
      : c0_(from.value), c1_(from.speed), c2_(from.acceleration / 2) {
    const double T = seconds;
    const double gap = to.value - (c0_ + T * (c1_ + T * c2_));
    const double slope = to.speed - (c1_ + 2 * T * c2_);
    const double bend = to.acceleration - from.acceleration;
    c3_ = (10 * gap - 4 * T * slope + T * T * bend / 2) / (T * T * T);
    c4_ = (-15 * gap + 7 * T * slope - T * T * bend) / (T * T * T * T);
    c5_ = (6 * gap - 3 * T * slope + T * T * bend / 2) / (T * T * T * T * T);
  }
  CoordinateState at(double t) const {
    return {c0_ + t * (c1_ + t * (c2_ + t * (c3_ + t * (c4_ + t * c5_)))),
            c1_ + t * (2 * c2_ + t * (3 * c3_ + t * (4 * c4_ + t * 5 * c5_))),
            2 * c2_ + t * (6 * c3_ + t * (12 * c4_ + t * 20 * c5_))};
  }

 private:
  double c0_, c1_, c2_, c3_, c4_, c5_;
};

// 1 in the middle of [0, 1] and 0 outside, with two continuous derivatives.
inline double bump(double s) {
  if (s <= 0 || s >= 1) return 0;
  const double u = s * (1 - s);
  return 64 * u * u * u;
}
// 0 before 0, 1 after 1, with two continuous derivatives.
inline double smooth_step(double s) {
  if (s <= 0) return 0;
  if (s >= 1) return 1;
  return s * s * s * (10 + s * (-15 + 6 * s));
}

}  // namespace kinegraph
