#pragma once
/// Writes the law of one section, cell by cell.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/path/path.hpp"
#include "core/motion/acceleration/cell_law.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Path lengths count from the beginning of the segment. Each call is O(1).
class LawWriter {
 public:
  LawWriter(TimeLaw& law, const Path& path) : law_(law), path_(path) {}

  /// Writes the law of a cell from s to s_end, mm.
  void cell(const CellLaw& cell, std::size_t segment, double s, double s_end) {
    const double from = path_[segment].s0();
    LawPiece& p = law_.next();
    p.duration = cell.duration;
    p.s = from + s;
    p.s_end = from + s_end;
    p.v = cell.v;
    p.a = cell.a;
    p.j = cell.j;
    p.segment = segment;
  }

  /// Extends the last piece, which has to run at constant speed, to `s_end`.
  void extend(std::size_t segment, double s_end) { law_.extend(path_[segment].s0() + s_end); }

  /// A place of a segment, mm, and v² there, mm²/s².
  struct End {
    double s, b;
  };
  /// Writes accelerate, hold, brake between two places of a straight line, with the acceleration `a` and v² up to
  /// `cap`, which is exact there. The lengths of the phases follow from their speeds, never from differences of places:
  /// a slow feed is reached within nanometres, which the rounding of s far along the path would hide.
  void straight(std::size_t segment, const End& begin, const End& end, double a, double cap) {
    const double s1 = begin.s, s2 = end.s, b1 = begin.b, b2 = end.b;
    const double way = s2 - s1, least = 4 * epsilon, top = 0.5 * (b1 + b2) + a * way;
    const double v1 = std::sqrt(b1), v2 = std::sqrt(b2), v = std::sqrt(std::max({std::min(cap, top), b1, b2}));
    double up = (v - v1) * (v + v1) / (2 * a), down = (v - v2) * (v + v2) / (2 * a);
    const double hold = way - up - down;
    const bool holds = cap < top && hold > least * way;
    if (!holds) {  // both ramps meet in one point; their difference is more accurate than their sum
      up = std::clamp(0.5 * way + (b2 - b1) / (4 * a), 0.0, way);
      down = way - up;
    }
    const bool rises = v - v1 > least * v, falls = v - v2 > least * v;
    const double begin_hold = rises ? std::min(s2, falls || holds ? s1 + up : s2) : s1;
    const double end_hold = falls ? std::max(begin_hold, holds ? s2 - down : begin_hold) : s2;
    if (rises) cell(ramp(falls || holds ? up : way, v1, v, a), segment, s1, begin_hold);
    if (holds || (!rises && !falls)) cell(ramp(holds ? hold : way, v, v, 0), segment, begin_hold, end_hold);
    if (falls) cell(ramp(rises || holds ? down : way, v, v2, -a), segment, end_hold, s2);
  }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  /// Returns the law from v1 to v2 over a length with constant acceleration.
  static CellLaw ramp(double length, double v1, double v2, double a) { return {2 * length / (v1 + v2), v1, a, 0}; }

  TimeLaw& law_;
  const Path& path_;
};

}  // namespace bahnwerk
