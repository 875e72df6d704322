#pragma once
/// Writes the law of one run, cell by cell, all of it slowed by one factor.
#include <algorithm>
#include <cmath>

#include "core/curve/path.hpp"
#include "core/motion/cell_law.hpp"
#include "core/motion/law.hpp"

namespace bahnwerk {

/// Path lengths count from the begin of the segment. O(1) each.
class LawWriter {
 public:
  LawWriter(MotionLaw& law, const Path& path, double slow)
      : law_(law), path_(path), slow_(slow), v_(1 / slow), a_(v_ * v_), j_(a_ * v_) {}

  void cell(const CellLaw& cell, std::size_t segment, double s, double s_end) {
    const double from = path_[segment].s0();
    LawPiece& p = law_.next();
    p.duration = cell.duration * slow_;
    p.s = from + s;
    p.s_end = from + s_end;
    p.v = cell.v * v_;
    p.a = cell.a * a_;
    p.j = cell.j * j_;
    p.segment = segment;
  }

  /// Lets the last piece, which has to run at constant speed, go on to `s_end`.
  void extend(double duration, std::size_t segment, double s_end) {
    law_.extend(path_[segment].s0() + s_end, duration * slow_);
  }

  /// Accelerate, hold, brake between the v² b1 and b2: exact on a straight line.
  void straight(std::size_t segment, double s1, double s2, double b1, double b2, double a, double cap) {
    const double peak = std::min(cap, 0.5 * (b1 + b2) + a * (s2 - s1));
    const double v1 = std::sqrt(b1), v2 = std::sqrt(b2), v = std::sqrt(std::max({peak, b1, b2}));
    const double up = (peak - b1) / (2 * a), down = (peak - b2) / (2 * a), hair = 1e-13 * (s2 - s1);
    double s = s1;
    const bool rises = up > hair, falls = down > hair;
    double end = falls ? std::min(s2, std::max(s1, s2 - down)) : s2;
    if (rises) {
      const double to = std::min(end, s1 + up);
      // Without a plateau both ramps meet in one point.
      const bool plateau = end - to > hair;
      const double meet = plateau ? to : end;
      ramp(segment, s, meet, v1, v, a);
      s = meet;
    }
    if (end - s > hair || (!rises && !falls)) {
      ramp(segment, s, end, v, v, 0);
      s = end;
    }
    if (falls) ramp(segment, s, s2, v, v2, -a);
  }

 private:
  void ramp(std::size_t segment, double s, double s_end, double v1, double v2, double a) {
    cell({2 * (s_end - s) / (v1 + v2), v1, a, 0}, segment, s, s_end);
  }

  MotionLaw& law_;
  const Path& path_;
  double slow_, v_, a_, j_;  // factors of durations, speeds, accelerations, jerks
};

}  // namespace bahnwerk
