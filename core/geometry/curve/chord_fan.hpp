#pragma once
/// Simplification of a polyline in one pass: which chords pass all points between their ends within a tolerance
/// [Imai & Iri 1986, with cones instead of exact visibility].
#include <algorithm>
#include <cmath>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// The chords from one point. Slopes are measured against the direction of the first point outside of the tolerance;
/// each point admits an interval of slopes, in space a square inscribed in its disc. O(1) and about 10 ns per point.
class ChordFan {
 public:
  /// A point of a planar polyline (z constant) admits the whole interval.
  ChordFan(double tolerance, bool planar)
      : tolerance_(tolerance), reach_(most_aside * (planar ? 1 : 0.70710678118654752) * tolerance) {}

  /// Makes `anchor` the begin of the chords.
  void begin(Vec anchor) {
    anchor_ = anchor;
    open_ = false;
  }
  /// Returns whether the chord from the anchor to `p` passes within the tolerance of all points since. If so, later
  /// chords have to pass `p`, too; otherwise the fan is unchanged.
  bool take(Vec p) {
    const Vec way = p - anchor_;
    if (!open_) {
      const double length = norm(way);
      if (length > most_aside * tolerance_) open(way / length), restrict(length, 0, 0);
      return true;
    }
    const double along = dot(way, direction_);
    if (along < farthest_ - slack * tolerance_) return false;  // the polyline has turned back
    const double a = dot(way, across_) / along, b = dot(way, up_) / along;
    if (a < low_a_ || a > high_a_ || b < low_b_ || b > high_b_) return false;
    restrict(along, a, b);
    return true;
  }

 private:
  // Fractions of the tolerance. A point up to `slack` beyond the chord's end is nearer than 1 to it, because slopes are
  // at most √2: hypot(0.01, 0.97 + 0.0142) < 1.
  static constexpr double most_aside = 0.97, slack = 0.01;

  void open(Vec direction) {
    direction_ = direction;
    const Vec aside =
        std::abs(direction.z) < 0.9 ? Vec{-direction.y, direction.x, 0} : Vec{0, -direction.z, direction.y};
    across_ = aside / norm(aside);
    up_ = cross(direction_, across_);
    low_a_ = low_b_ = -1, high_a_ = high_b_ = 1;
    farthest_ = 0, open_ = true;
  }
  void restrict(double along, double a, double b) {
    farthest_ = std::max(farthest_, along);
    const double half = reach_ / along;
    low_a_ = std::max(low_a_, a - half), high_a_ = std::min(high_a_, a + half);
    low_b_ = std::max(low_b_, b - half), high_b_ = std::min(high_b_, b + half);
  }

  double tolerance_, reach_;
  Vec anchor_, direction_, across_, up_;
  double low_a_ = 0, high_a_ = 0, low_b_ = 0, high_b_ = 0, farthest_ = 0;
  bool open_ = false;
};

}  // namespace bahnwerk
