#include "core/contour/blend/corner.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/curve/line.hpp"
#include "core/geometry/path/matched.hpp"

namespace bahnwerk::blending {

namespace {

constexpr double turn_floor = 1e-7;         // rad, below it a tangent jump is rounding
constexpr double curvature_floor = 1e-6;    // part of the curvature that counts as none
constexpr double curvature_share = 0.0075;  // deviation of a blended curvature jump: this · jump · d²

double stretch_factor(double turn) { return 0.9 + 0.03 * turn; }
double middle_share(double turn) { return (64 - 44 * stretch_factor(turn)) / 64 * std::sin(0.5 * turn); }

constexpr double proof_share = 1e-3;                     // part of the tolerance to which it is proven
constexpr double first_place = 0.05, last_place = 0.95;  // range of the joint's parameter on its blend

/// The part between two places of an element, as a curve between two parameters.
struct Part {
  Part(const Element& e, double from, double to)
      : line(e.straight ? Line(e.from + from * e.tangent, e.from + to * e.tangent) : Line({}, {})),
        curve(e.straight ? static_cast<const Curve&>(line) : e.segment->curve()),
        u0(e.straight ? 0 : e.parameter(from)),
        u1(e.straight ? 1 : e.parameter(to)) {}
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  Line line;
  const Curve& curve;
  double u0, u1;
};

/// The place on a blend nearest to a point.
double place_of(const Rational& curve, Vec p) {
  constexpr int samples = 16;
  double best = HUGE_VAL, at = 0.5;
  for (int i = 1; i < samples; ++i) {
    const double u = static_cast<double>(i) / samples;
    if (const double d = norm(curve.at(u).value - p); d < best) best = d, at = u;
  }
  const Nearest n = nearest(curve, at - 1.0 / samples, at + 1.0 / samples, p);
  return std::clamp(n.distance <= best ? n.u : at, first_place, last_place);
}

}  // namespace

JointShape joint_shape(const Element& before, const Element& after) {
  const Jet left = before.at(before.length), right = after.at(0);
  JointShape shape;
  shape.turn = angle_between(left.d1, right.d1);
  if (shape.turn < turn_floor) shape.turn = 0;
  shape.tightest = std::max(norm(left.d2), norm(right.d2));
  shape.curvature_jump = norm(right.d2 - left.d2);
  if (!(shape.curvature_jump > curvature_floor * shape.tightest)) shape.curvature_jump = 0;
  return shape;
}

namespace {

/// Returns the speed up to which a joint may be passed as given, by the steps that are allowed in one cycle. 0: it is a
/// corner.
double step_speed(const JointShape& joint, const Ability& ability) {
  if (!(joint.turn <= ability.corner) || !(ability.speed > 0)) return 0;
  const double cycle = ability.step / ability.speed, room = ability.jerk * cycle - joint.turn * ability.pull;
  if (!(room > 0)) return 0;
  const double by_curvature = joint.curvature_jump > 0 ? std::sqrt(room / joint.curvature_jump) : HUGE_VAL;
  return joint.turn > 0 ? std::min(by_curvature, ability.acceleration * cycle / joint.turn) : by_curvature;
}

}  // namespace

Reach reach(const JointShape& joint, double tolerance, const Ability& ability) {
  Reach r;
  const double a = middle_share(joint.turn), b = curvature_share * joint.curvature_jump;
  if (!(a > 0 || b > 0)) return r;
  r.allowed = 2 * tolerance / (a + std::sqrt(a * a + 4 * b * tolerance));
  // Peak curvature 1.4 sin(θ/2)/d and peak curvature rate 4 sin(θ/2)/d² of a blended corner; jump/d of a blended
  // curvature jump.
  const double s = std::sin(0.5 * joint.turn), v = ability.speed;
  double need = 1.4 * s * v * v / ability.acceleration;
  const bool jerky = ability.jerk < HUGE_VAL;
  if (jerky) {
    // The acceleration on an arc is κv², its jerk κ²v³.
    double most = v;
    if (const double k = joint.tightest; k > 0)
      most = std::min({v, std::sqrt(ability.pull / k), std::cbrt(std::sqrt(3.0) * ability.jerk / (k * k))});
    const double as_it_is = step_speed(joint, ability);
    if (as_it_is >= most) return r;
    if (joint.turn == 0 && as_it_is > 0) r.least = as_it_is * as_it_is * as_it_is * joint.curvature_jump / ability.jerk;
  }
  if (jerky) need = std::max(need, std::sqrt(4 * s * v * v * v / ability.jerk));
  if (joint.curvature_jump > 0) {
    const double slow = joint.tightest > 0 ? std::min(v, std::sqrt(ability.acceleration / joint.tightest)) : v;
    need = std::max(need, jerky ? slow * slow * slow * joint.curvature_jump / ability.jerk : 0.5 * r.allowed);
  }
  r.wanted = std::min(r.allowed, std::max({1.25 * need, ability.step, tolerance}));
  return r;
}

Rational corner_curve(const Element& before, double d1, const Element& after, double d2) {
  const Jet a = before.at(before.length - d1), b = after.at(d2);
  const JointShape joint = joint_shape(before, after);
  // A curvature jump alone is passed evenly, λ = 1.
  const double by_turn = middle_share(joint.turn),
               by_curvature = curvature_share * joint.curvature_jump * 0.5 * (d1 + d2);
  const double share = by_turn > 0 ? by_turn / (by_turn + by_curvature) : 0.0;
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

CornerFit corner_fit(const Rational& curve, const Element& before, double d1, const Element& after, double d2,
                     double tolerance) {
  const Vec joint = after.at(0).value;
  CornerFit fit;
  if (before.straight && after.straight && std::abs(d1 - d2) <= 1e-9 * (d1 + d2)) {
    fit.deviation = norm(curve.at(0.5).value - joint);
    return fit;
  }
  fit.joint = place_of(curve, joint);
  const double off = norm(curve.at(fit.joint).value - joint);
  fit.deviation = off;
  if (!(off <= tolerance)) return fit;
  const Part left(before, before.length - d1, before.length), right(after, 0, d2);
  const double slack = proof_share * tolerance, least = (1 - proof_share) * tolerance;
  const auto half = [&](const Part& part, double u0, double u1) {
    const MatchedPieces pieces{u0,
                               u1,
                               part.u0,
                               part.u1,
                               norm(curve.at(u0).value - part.curve.at(part.u0).value),
                               norm(curve.at(u1).value - part.curve.at(part.u1).value)};
    double found = least;
    return MatchedDistance(curve, part.curve).bound(pieces, tolerance, slack, found);
  };
  for (const double bound : {half(left, 0, fit.joint), half(right, fit.joint, 1)})
    if (!(bound <= fit.deviation)) fit.deviation = std::isnan(bound) ? HUGE_VAL : bound;
  return fit;
}

}  // namespace bahnwerk::blending
