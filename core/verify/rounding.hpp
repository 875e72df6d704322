#pragma once
/// The effect of rounding on the states of a law: the source of every tolerance that no document sets.
///
/// With ε = 2⁻⁵² a sum that is evaluated in n operations has an error of at most n ε/2 times the sum of its terms'
/// magnitudes [Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 3.1]. A piece of a law is
/// evaluated in 8 operations (Horner); its coefficients and its duration were written with some 10 roundings each and
/// scaled with up to 5 more when the motion was slowed, and so were its neighbour's. 32 ε covers them. Hence, with T
/// the piece's duration and q its snap:
///
/// position      32 ε (|s| + |v| T + |a| T²/2 + |j| T³/6 + |q| T⁴/24)   mm; s: the larger one of both ends
/// speed         32 ε (|v| + |a| T + |j| T²/2 + |q| T³/6)               mm/s
/// acceleration  32 ε (|a| + |j| T + |q| T²/2)                          mm/s²
///
/// Nothing here depends on the motion's peak speed or on limits, so slow motions are checked as exactly as fast ones.
/// Time is rounded where it is counted from the motion's beginning: t has an error of ε t. A setpoint's speed may
/// therefore be off by |a| ε t, its position by |v| ε t.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/motion/law/time_law.hpp"

namespace bahnwerk::verify {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double rounding = 32 * epsilon;

/// Tolerances of position (mm), speed (mm/s) and acceleration (mm/s²).
struct PieceRounding {
  double position = 0, speed = 0, acceleration = 0;
};

/// Returns the tolerances of a piece's states. O(1).
inline PieceRounding rounding_of(const LawPiece& p) {
  const double T = std::abs(p.duration), v = std::abs(p.v), a = std::abs(p.a) * T, j = std::abs(p.j) * T * T,
               q = std::abs(p.snap) * T * T * T;
  PieceRounding r;
  r.position = rounding * (std::max(std::abs(p.s), std::abs(p.s_end)) + T * (v + a / 2 + j / 6 + q / 24));
  r.speed = rounding * (v + a + j / 2 + q / 6);
  r.acceleration = rounding * (std::abs(p.a) + T * (std::abs(p.j) + std::abs(p.snap) * T / 2));
  return r;
}

}  // namespace bahnwerk::verify
