#include "core/geometry/curve/arc.hpp"

#include <algorithm>
#include <numbers>
#include <string>

#include "core/base/errors.hpp"

namespace bahnwerk {
namespace {

[[noreturn]] void fault(const char* where, const char* what) {
  std::vector<std::string> place{"arc"};
  if (*where != '\0') place.emplace_back(where);
  throw InvalidInput({{std::move(place), what}});
}

bool usable(Vec a) {
  constexpr double largest = 1e9;  // mm; also false for NaN
  return std::abs(a.x) <= largest && std::abs(a.y) <= largest && std::abs(a.z) <= largest;
}

}  // namespace

Arc::Arc(Vec centre, Vec e1, Vec e2, double radius, double sweep, double rise)
    : centre_(centre),
      e1_(e1),
      e2_(e2),
      start_(centre + radius * e1),
      climb_(rise == 0 ? Vec{} : rise * cross(e1, e2)),
      radius_(radius),
      sweep_(sweep),
      rise_(rise),
      length_(std::hypot(radius * sweep, rise)) {}

Jet Arc::at(double u) const {
  // cos φ − 1 = −2 sin²(φ/2) is used from the start point outwards, so that short arcs of large radius have full
  // accuracy.
  const double half = 0.5 * sweep_ * u, sine = std::sin(half), cosine = std::cos(half);
  const double s = 2 * sine * cosine, versine = 2 * sine * sine, c = 1 - versine;
  const double r1 = radius_ * sweep_, r2 = r1 * sweep_, r3 = r2 * sweep_;
  return {start_ + (radius_ * s) * e2_ - (radius_ * versine) * e1_ + u * climb_,
          (r1 * c) * e2_ - (r1 * s) * e1_ + climb_, (-r2 * c) * e1_ - (r2 * s) * e2_, (r3 * s) * e1_ - (r3 * c) * e2_};
}

bool Arc::derivatives(PathBatch& batch) const {
  // Further points follow from the first one by the addition theorems; up to 0.1 rad these terms are exact to 1e-18.
  const double u0 = batch.u[0], reach = std::abs(sweep_ * (batch.u[batch.count - 1] - u0));
  if (!(reach <= 0.1)) return false;
  const double s0 = std::sin(sweep_ * u0), c0 = std::cos(sweep_ * u0);
  const double r1 = radius_ * sweep_, r2 = r1 * sweep_, r3 = r2 * sweep_;
  batch.planar = e1_.z == 0 && e2_.z == 0 && climb_.z == 0;
  const std::size_t axes = batch.planar ? 2 : 3;
  const auto both = [](double x) { return PointPair{x, x}; };
  for (std::size_t p = 0; p < batch.used_pairs(); ++p) {
    const PointPair x = (batch.u.pair[p] - both(u0)) * both(sweep_), y = x * x;
    const PointPair sine =
        x * (both(1) -
             y * (both(1.0 / 6) - y * (both(1.0 / 120) -
                                       y * (both(1.0 / 5040) - y * (both(1.0 / 362880) - y * both(1.0 / 39916800))))));
    const PointPair versine =
        y *
        (both(0.5) - y * (both(1.0 / 24) - y * (both(1.0 / 720) - y * (both(1.0 / 40320) - y * both(1.0 / 3628800)))));
    const PointPair s = both(s0) + (both(c0) * sine - both(s0) * versine),
                    c = both(c0) - (both(s0) * sine + both(c0) * versine);
    for (std::size_t k = 0; k < axes; ++k) {
      const PointPair a = both(e1_[k]), b = both(e2_[k]);
      const PointPair out = c * a + s * b, along = c * b - s * a;
      batch.d1[k].pair[p] = both(r1) * along + both(climb_[k]);
      batch.d2[k].pair[p] = both(-r2) * out;
      batch.d3[k].pair[p] = both(-r3) * along;
    }
  }
  return true;
}

Arc Arc::through(Vec from, Vec to, Vec centre, Vec normal, bool counter_clockwise, double tolerance) {
  if (!usable(from) || !usable(to) || !usable(centre))
    fault("", "the arc's points have to be finite and within 1e9 mm");
  if (!usable(normal) || !(norm(normal) > 1e-9)) fault("normal", "the arc's plane has no normal");
  const Vec n = normal / norm(normal);
  const auto in_plane = [&](Vec v) { return v - dot(v, n) * n; };
  centre = from + in_plane(centre - from);
  const Vec chord = in_plane(to - from);
  const double rise = dot(to - from, n), distance = norm(chord);
  Vec a = from - centre;
  double radius = norm(a);
  const double other = norm(a + chord);
  if (!(std::min(radius, other) > 1e-9)) fault("center", "the arc's radius is zero");
  if (!(std::abs(radius - other) <= tolerance)) {
    fault("center", "the arc's radii at start and end differ by more than the tolerance");
  }
  if (distance <= 1e-9) {
    const Vec e1 = a / radius, e2 = cross(n, e1);
    return {centre, e1, e2, radius, counter_clockwise ? 2 * std::numbers::pi : -2 * std::numbers::pi, rise};
  }
  // Onto the bisector: remove the component of (middle of the chord − centre) along the chord.
  const Vec along = chord / distance;
  const double shift = dot(a + 0.5 * chord, along);
  centre += shift * along;
  a = a - shift * along;
  radius = 0.5 * (norm(a) + norm(a + chord));
  if (!(radius > 1e-9)) fault("center", "the arc's radius is zero");
  Vec e1 = a / norm(a), e2 = cross(n, e1);
  const double angle = std::atan2(dot(chord, e2), norm(a) + dot(chord, e1));
  constexpr double turn = 2 * std::numbers::pi;
  const double sweep = counter_clockwise ? (angle > 0 ? angle : angle + turn) : (angle < 0 ? angle : angle - turn);
  if (std::abs(sweep) > std::numbers::pi && std::abs(shift) > 0.05 * radius) {
    fault("center", "the arc's radii differ too much for end points this close to each other");
  }
  return {centre, e1, e2, radius, sweep, rise};
}

}  // namespace bahnwerk
