#include "core/contour/blend/corner.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::blending {

namespace {

constexpr double turn_floor = 1e-7;    // rad, below it a tangent jump is rounding
constexpr double bend_floor = 1e-6;    // of the curvature
constexpr double bend_share = 0.0075;  // deviation of a blended curvature jump: this · jump · d²

double stretch_factor(double turn) { return 0.9 + 0.03 * turn; }
double middle_share(double turn) { return (64 - 44 * stretch_factor(turn)) / 64 * std::sin(0.5 * turn); }

/// Distance of p from the curve of an element between a and b: Newton from the nearest of a few samples.
double distance(const Element& e, double a, double b, Vec p) {
  if (e.straight) return norm(e.from + std::clamp(dot(p - e.from, e.tangent), a, b) * e.tangent - p);
  constexpr int samples = 8;
  double best = HUGE_VAL, at = a;
  for (int i = 0; i <= samples; ++i) {
    const double t = a + (b - a) * i / samples;
    if (const double d = norm(e.at(t).value - p); d < best) best = d, at = t;
  }
  // Newton on (h − p)·h' = 0, kept in the interval.
  for (int i = 0; i < 4; ++i) {
    const Jet h = e.at(at);
    const double slope = 1 + dot(h.value - p, h.d2);
    if (!(slope > 0.1)) break;
    at = std::clamp(at - dot(h.value - p, h.d1) / slope, a, b);
    best = std::min(best, norm(e.at(at).value - p));
  }
  return best;
}

}  // namespace

JointShape joint_shape(const Element& before, const Element& after) {
  const Jet left = before.at(before.length), right = after.at(0);
  JointShape shape;
  shape.turn = angle_between(left.d1, right.d1);
  if (shape.turn < turn_floor) shape.turn = 0;
  shape.tightest = std::max(norm(left.d2), norm(right.d2));
  shape.bend = norm(right.d2 - left.d2);
  if (!(shape.bend > bend_floor * shape.tightest)) shape.bend = 0;
  return shape;
}

Reach reach(const JointShape& joint, double tolerance, const Ability& ability) {
  Reach r;
  const double a = middle_share(joint.turn), b = bend_share * joint.bend;
  if (!(a > 0 || b > 0)) return r;
  r.allowed = 2 * tolerance / (a + std::sqrt(a * a + 4 * b * tolerance));
  // Peak curvature 1.4 sin(θ/2)/d and peak curvature rate 4 sin(θ/2)/d² of a blended corner; jump/d of a blended
  // curvature jump.
  const double s = std::sin(0.5 * joint.turn), v = ability.speed;
  double need = 1.4 * s * v * v / ability.acceleration;
  const bool jerky = ability.jerk < HUGE_VAL;
  if (jerky) need = std::max(need, std::sqrt(4 * s * v * v * v / ability.jerk));
  if (joint.bend > 0) {
    const double slow = joint.tightest > 0 ? std::min(v, std::sqrt(ability.acceleration / joint.tightest)) : v;
    need = std::max(need, jerky ? slow * slow * slow * joint.bend / ability.jerk : 0.5 * r.allowed);
  }
  r.wanted = std::min(r.allowed, std::max({1.25 * need, ability.step, tolerance}));
  return r;
}

Rational corner_curve(const Element& before, double d1, const Element& after, double d2) {
  const Jet a = before.at(before.length - d1), b = after.at(d2);
  const JointShape joint = joint_shape(before, after);
  // A curvature jump alone is passed evenly, λ = 1.
  const double by_turn = middle_share(joint.turn), by_bend = bend_share * joint.bend * 0.5 * (d1 + d2);
  const double share = by_turn > 0 ? by_turn / (by_turn + by_bend) : 0.0;
  const double l = (1 + share * (stretch_factor(joint.turn) - 1)) * (d1 + d2);
  std::vector<Vec> p(8);
  p[0] = a.value;
  p[1] = p[0] + (l / 7) * a.d1;
  p[2] = 2 * p[1] - p[0] + (l * l / 42) * a.d2;
  p[3] = 3 * p[2] - 3 * p[1] + p[0] + (l * l * l / 210) * a.d3;
  p[7] = b.value;
  p[6] = p[7] - (l / 7) * b.d1;
  p[5] = 2 * p[6] - p[7] + (l * l / 42) * b.d2;
  p[4] = 3 * p[5] - 3 * p[6] + p[7] - (l * l * l / 210) * b.d3;
  return Rational::bezier(p);
}

double corner_deviation(const Rational& curve, const Element& before, double d1, const Element& after, double d2) {
  const Vec corner = after.at(0).value;
  double worst = 0, nearest = HUGE_VAL;
  constexpr int samples = 32;
  for (int i = 1; i < samples; ++i) {
    const Vec p = curve.at(static_cast<double>(i) / samples).value;
    const double d = std::min(distance(before, before.length - d1, before.length, p), distance(after, 0, d2, p));
    worst = std::max(worst, std::isfinite(d) ? d : HUGE_VAL);
    nearest = std::min(nearest, norm(p - corner));
  }
  return std::max(worst, nearest);
}

}  // namespace bahnwerk::blending
