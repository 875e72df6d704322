#include "core/verify/bound/repeated_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Differences between two segments.
struct Difference {
  double tangent = 0, q2 = 0, third = 0;           ///< largest |Δ| of q′, q″, q‴: 1, 1/mm, 1/mm²
  double pace = 0, change = 0, second_change = 0;  ///< |w′ − 1|, |w″|, |w‴|
  double curvature = 0, torsion = 0;               ///< largest |q″|, |q‴| of either
  bool none() const { return tangent == 0 && q2 == 0 && third == 0 && pace == 0; }
};

double length_of(const Segment& segment) { return segment.travelled(segment.curve().end()); }

bool same_curve(const Rational& a, const Rational& b) {
  if (a.degree() != b.degree() || a.rational() != b.rational() || a.begin() != b.begin() || a.end() != b.end() ||
      a.pivot() != b.pivot() || a.reach() != b.reach() || a.vanishing_begin() != b.vanishing_begin() ||
      a.vanishing_end() != b.vanishing_end() || a.weight() != b.weight())
    return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Polynomial p = a.coordinate(k), q = b.coordinate(k);
    // The constant of a polynomial is its place.
    if (p.size() != q.size() ||
        (!p.empty() && !std::equal(p.begin() + !a.rational(), p.end(), q.begin() + !a.rational())))
      return false;
  }
  return true;
}

bool difference(const Arc& a, const Arc& b, double length, Difference& d) {
  const double frame = norm(a.e1() - b.e1()) + norm(a.e2() - b.e2()), sweep = std::abs(a.sweep() - b.sweep());
  const double parts = std::abs(a.radius() - b.radius()) / b.radius() + sweep / std::abs(b.sweep()) +
                       std::abs(a.rise() - b.rise()) / length + d.pace;
  // Bounds the difference of (r φ (e₂ cos φx − e₁ sin φx) + rise n)/length at corresponding x, and of its derivatives,
  // each relative to its size; twice that for terms of second order.
  const double all = 2 * (3 * frame + sweep + 4 * parts + std::abs(b.sweep()) * d.pace);
  if (!(all < 1e-6)) return false;
  const double turn = std::abs(b.sweep()) / length;
  d.curvature = 1.001 * b.radius() * turn * turn, d.torsion = d.curvature * turn;
  d.tangent = all, d.q2 = all * d.curvature, d.third = all * d.torsion;
  return true;
}

/// Bounds the differences between two segments; returns false if their curves are too different to compare.
bool difference(const Segment& a, const Segment& b, Difference& d) {
  if (a.straight() != b.straight() || a.cusp_begin() != b.cusp_begin() || a.cusp_end() != b.cusp_end()) return false;
  const double length = length_of(b), off = std::abs(length_of(a) - length);
  if (!(off <= 1e-6 * length)) return false;
  d.pace = 2 * off / length, d.change = 3 * d.pace / length, d.second_change = 30 * d.pace / (length * length);
  if (a.straight()) {
    d.tangent = norm(a.at_parameter(a.curve().begin()).d1 - b.at_parameter(b.curve().begin()).d1);
    return d.tangent <= 1e-6;
  }
  if (a.curve().kind() != b.curve().kind()) return false;
  if (a.curve().kind() == CurveKind::arc)
    return difference(static_cast<const Arc&>(a.curve()), static_cast<const Arc&>(b.curve()), length, d);
  return a.curve().kind() == CurveKind::rational && off == 0 &&
         same_curve(static_cast<const Rational&>(a.curve()), static_cast<const Rational&>(b.curve()));
}

/// The largest of what a motion from rest to rest may have: mm/s, mm/s², mm/s³.
struct Most {
  double speed = 0, acceleration = 0, jerk = 0;
};

double excess(const Difference& d, const Machine& machine, std::size_t axes, const Most& most, bool joints) {
  const double v = most.speed, v2 = v * v, v3 = v2 * v, a = most.acceleration;
  const double velocity = 2 * (d.tangent + d.pace) * v;
  const double acceleration = 2 * d.q2 * v2 + (2 * d.tangent + 4 * d.pace) * a + 2 * d.change * v2;
  const double along = most.jerk + a * d.curvature * v;  // |s⃛|
  const double jerk = (2 * d.third + 7 * d.pace * d.torsion) * v3 + (6 * d.q2 + 9 * d.pace * d.curvature) * v * a +
                      6 * d.curvature * d.change * v3 + 6 * d.change * v * a + 2 * d.second_change * v3 +
                      (d.tangent + d.pace > 0 ? (2 * d.tangent + d.pace) * along : 0);
  double worst = d.pace;  // largest relative difference; it begins with that of feeds
  for (std::size_t k = 0; k < axes; ++k) {
    const AxisLimits& limit = machine.axes[k];
    if (!std::isfinite(acceleration + jerk)) return infinite;
    const double step = limit.acceleration * machine.cycle_time, jump = limit.jerk * machine.cycle_time;
    worst = std::max({worst, velocity / limit.velocity, acceleration / limit.acceleration});
    if (std::isfinite(limit.jerk)) worst = std::max(worst, jerk / limit.jerk);
    if (joints) worst = std::max(worst, 2 * velocity / step);
    if (joints && std::isfinite(limit.jerk)) worst = std::max(worst, 2 * acceleration / jump);
  }
  return worst;
}

}  // namespace

double repeat_margin(const AxisPath& path, const Machine& machine, const std::vector<double>& feeds,
                     const Repetition& repetition, ProgressScope& progress) {
  const auto& [a, b, n] = repetition;
  if (!path.cartesian() || a + n > path.size() || b + n > path.size()) return infinite;
  std::vector<Difference> differences;
  double length = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Difference d;
    progress.work(2);
    if (feeds[a + i] != feeds[b + i] || !difference(path[a + i], path[b + i], d)) return infinite;
    if (!d.none()) differences.push_back(d);
    length += length_of(path[b + i]);
  }
  if (differences.empty()) return 0;
  Most most;
  double jerk = 0;
  bool limited = false;
  for (std::size_t k = 0; k < path.axes(); ++k) {
    most.acceleration = std::hypot(most.acceleration, machine.axes[k].acceleration);
    jerk = std::hypot(jerk, machine.axes[k].jerk);  // infinite if any is: then nothing is known of s⃛
    limited = limited || std::isfinite(machine.axes[k].jerk);
  }
  most.jerk = limited ? jerk : 0;
  const double reach = std::sqrt(most.acceleration * length);
  double worst = 0;
  for (const Difference& d : differences) {
    progress.work();
    most.speed = d.curvature > 0 ? std::min(reach, std::sqrt(1.01 * most.acceleration / d.curvature)) : reach;
    worst = std::max(worst, excess(d, machine, path.axes(), most, n > 1));
  }
  return 1.01 * worst;
}

std::optional<RepeatedSections::Known> RepeatedSections::find(std::size_t first, std::size_t last) {
  if (!path_.cartesian()) return {};
  shape_ = rough_shape(path_.tool(), first, last);
  for (const std::size_t i : index_.of(shape_)) {
    const Known& known = known_[i];
    if (known.last - known.first != last - first) continue;
    const double margin = repeat_margin(path_, machine_, feeds_, {known.first, first, last - first}, progress_);
    if (margin <= largest_margin) return Known{first, last, known.duration * (1 - margin), known.nodes, known.cells};
  }
  return {};
}

void RepeatedSections::add(const Known& section) {
  if (!path_.cartesian()) return;
  index_.add(shape_, known_.size());
  known_.push_back(section);
}

}  // namespace bahnwerk::verify
