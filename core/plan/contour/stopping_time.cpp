#include "core/plan/contour/stopping_time.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/bound/rest_to_rest.hpp"

namespace bahnwerk {
namespace {

constexpr double rounding = 1e-9;  // relative rounding of the sum, and of a joint's limit

/// Returns ∫ (1 − v/F) dt over at most `tau` s, for v ≤ w + A t.
double lost_to_acceleration(double speed, double w, double acceleration, double tau) {
  if (!(speed > w)) return 0;
  tau = std::min(tau, (speed - w) / acceleration);
  return ((speed - w) * tau - 0.5 * acceleration * tau * tau) / speed;
}

/// Returns ∫ (1 − v/F) dt over at most `tau` s, for v ≤ w + J t²/2.
double lost_to_jerk(double speed, double w, double jerk, double tau) {
  if (!(speed > w) || !std::isfinite(jerk)) return 0;
  tau = std::min(tau, std::sqrt(2 * (speed - w) / jerk));
  return ((speed - w) * tau - jerk * tau * tau * tau / 6) / speed;
}

}  // namespace

StoppingTime::StoppingTime(const Contour& contour, const AxisPath& axes, const Machine& machine, double corner_angle)
    : contour_(contour),
      axes_(axes),
      machine_(machine),
      corner_angle_(corner_angle),
      feeds_(contour.feeds()),
      rests_(contour.rest_places()) {
  for (int order = 1; order <= Limits::highest_order; ++order) {
    double square = 0;
    for (const AxisLimits& axis : machine.axes) square += axis.of(order) * axis.of(order);
    together_.of(order) = std::sqrt(square);
  }
}

bool StoppingTime::rests(std::size_t i) const {
  return i == 0 || i >= contour_.path.size() || rests_[i] || stops_at(contour_.path, i, corner_angle_);
}

double StoppingTime::least(std::size_t first, std::size_t last, ProgressScope& progress) const {
  if (!axes_.cartesian()) return 0;
  double sum = 0;
  for (std::size_t begin = first, end = first + 1; begin < last; begin = end++) {
    while (end < last && !rests(end)) ++end, progress.work(1);
    sum += between_stops(begin, end, progress);
  }
  return sum * (1 - rounding);
}

StoppingTime::Limit StoppingTime::limit(std::size_t i) const {
  const Segment& segment = axes_[i];
  Limit l{together_, 0};
  l.velocity = std::min(l.velocity, feeds_[i]);
  const PathPoint at = segment.at_parameter(segment.curve().begin());
  if (segment.straight()) {
    for (std::size_t k = 0; k < machine_.axes.size(); ++k)
      if (const double rate = std::abs(at.d1[k]); rate > 1e-12) l.lower_to(machine_.axes[k], rate);
  } else if (segment.curve().kind() == CurveKind::arc) {
    const double q2 = norm(at.d2);
    if (q2 > 0) l.velocity = std::min(l.velocity, std::sqrt(together_.acceleration / q2));
    l.jerk += q2 * q2 * l.velocity * l.velocity * l.velocity;
  } else {
    l.jerk = unlimited;  // the curvature is not known
  }
  l.time = segment.length() / l.velocity;
  return l;
}

/// Returns the largest speed at the joint before segment `next`, at which no axis steps by more than acceleration ·
/// cycle in velocity and jerk · cycle in acceleration, |Δq″ v² + Δq′ v̇|.
double StoppingTime::joint_speed(std::size_t next) const {
  const Segment &before = axes_[next - 1], &after = axes_[next];
  const PathPoint a = before.at_parameter(before.curve().end()), b = after.at_parameter(after.curve().begin());
  const double cycle = machine_.cycle_time;
  double speed = unlimited;
  for (std::size_t k = 0; k < machine_.axes.size(); ++k) {
    const double tangent_jump = std::abs(b.d1[k] - a.d1[k]), q2 = std::abs(b.d2[k] - a.d2[k]);
    const AxisLimits& axis = machine_.axes[k];
    if (tangent_jump > 0) speed = std::min(speed, axis.acceleration * cycle / tangent_jump);
    if (q2 > 0) speed = std::min(speed, std::sqrt((axis.jerk * cycle + tangent_jump * together_.acceleration) / q2));
  }
  return speed * (1 + rounding);
}

double StoppingTime::between_stops(std::size_t first, std::size_t last, ProgressScope& progress) const {
  progress.work(1);
  if (last == first + 1 && axes_.linear(first)) return verify::rest_to_rest(axes_, first, feeds_[first], machine_);
  Limit l = limit(first);
  const auto stop = [](const Limit& at) {
    if (!std::isfinite(at.velocity)) return 0.0;
    return std::max(lost_to_acceleration(at.velocity, 0, at.acceleration, 0.5 * at.time),
                    lost_to_jerk(at.velocity, 0, at.jerk, 0.5 * at.time));
  };
  double sum = l.time + stop(l);
  for (std::size_t i = first + 1; i < last; ++i) {
    progress.work(1);
    const Limit before = l;
    l = limit(i);
    sum += l.time;
    const double speed = std::min(before.velocity, l.velocity), w = joint_speed(i);
    if (!(w < speed) || !std::isfinite(speed)) continue;
    const double tau = 0.5 * std::min(before.time, l.time);
    sum += 2 * std::max(lost_to_acceleration(speed, w, std::max(before.acceleration, l.acceleration), tau),
                        lost_to_jerk(speed, w, std::max(before.jerk, l.jerk), tau));
  }
  return sum + stop(l);
}

}  // namespace bahnwerk
