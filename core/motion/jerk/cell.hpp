#pragma once
/// The motion law inside one cell when jerk is limited. Speed is the cubic of time through speed and acceleration at
/// both ends, so s(t) is a quartic, jerk is linear in time, and neighbouring cells meet with continuous acceleration.
///
/// From (v₁, a₁) to (v₂, a₂) over the length h: ∫v dt = T (v₁ + v₂)/2 + T² (a₁ − a₂)/12 = h gives T, and
/// j₁ = 6 (v₂ − v₁)/T² − (4a₁ + 2a₂)/T,  j₂ = −6 (v₂ − v₁)/T² + (2a₁ + 4a₂)/T.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/law/time_law.hpp"
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// State of a law at a node: b = v² (mm²/s²) and path acceleration a (mm/s²).
struct JerkNode {
  double b = 0, a = 0;
};

/// State of a law at a moving node, with its speed: v = √b (mm/s) and w = 1/(2v), the derivative of v by b. L is a
/// number, or a vector of one number per node.
template <class L>
struct MovingNode {
  L b, a, v, w;
};

/// Duration (s) and jerk (mm/s³) at both ends, with their gradients by (b₁, a₁, b₂, a₂). L is a number, or a vector of
/// one number per cell.
template <class L>
struct JerkCellOf {
  L T{}, j1{}, j2{};
  std::array<L, 4> dT{}, dj1{}, dj2{};
};
using JerkCell = JerkCellOf<double>;

namespace jerk_cell_detail {
/// The discriminant is at least this part of v̄²; a larger change of acceleration has no sensible law.
constexpr double min_root = 0.01;
}  // namespace jerk_cell_detail

/// Returns the law between two moving nodes at the distance h, mm.
template <class L>
inline JerkCellOf<L> jerk_cell(const MovingNode<L>& left, const MovingNode<L>& right, L h) {
  const L v1 = left.v, w1 = left.w, a1 = left.a, v2 = right.v, w2 = right.w, a2 = right.a;
  const L mean = 0.5 * (v1 + v2), square = mean * mean;
  const L R = root(larger(square + (1.0 / 3) * h * (a1 - a2), jerk_cell_detail::min_root * square));
  JerkCellOf<L> c;
  const L sum = mean + R, u = sum / (2.0 * h), m6 = 6.0 * (v2 - v1) * u;
  c.T = 2.0 * h / sum;
  c.j1 = (m6 - 4.0 * a1 - 2.0 * a2) * u;
  c.j2 = (2.0 * a1 + 4.0 * a2 - m6) * u;
  const L Tv = -0.5 * c.T / R, Ta = Tv * c.T * (1.0 / 6);
  const L t1 = -(c.j1 + m6 * u) * u, t2 = -(c.j2 - m6 * u) * u, u6 = 6.0 * u * u;
  c.dT = {Tv * w1, Ta, Tv * w2, -Ta};
  c.dj1 = {(t1 * Tv - u6) * w1, t1 * Ta - 4.0 * u, (t1 * Tv + u6) * w2, -t1 * Ta - 2.0 * u};
  c.dj2 = {(t2 * Tv + u6) * w1, t2 * Ta + 2.0 * u, (t2 * Tv - u6) * w2, -t2 * Ta + 4.0 * u};
  return c;
}

/// Law between rest and a node with speed² b: constant jerk, T = 3h/v, |a| = 2v²/(3h), j = 2v³/(9h²). `a` of the moving
/// node is tied to b, so the gradients have one entry, for b of the node at index `moving` (0 left, 1 right).
inline JerkCell rest_cell(double b, double h, std::size_t moving) {
  const double v = std::sqrt(b);
  JerkCell c;
  c.T = 3 * h / v;
  c.j1 = c.j2 = 2.0 / 9 * b * v / (h * h);
  c.dT[2 * moving] = -0.5 * c.T / b;
  c.dj1[2 * moving] = c.dj2[2 * moving] = 1.5 * c.j1 / b;
  return c;
}
/// Factor of a = tie · b at the moving node of the first (sign +) or last cell (sign −) of a section.
inline double rest_tie(double h) { return 2.0 / (3 * h); }

/// Returns the law between the states at both ends; s counts from the cell's left end.
inline LawPiece jerk_piece(JerkNode l, JerkNode r, double h) {
  LawPiece p;
  if (!(l.b > 0) || !(r.b > 0)) {
    const double b = std::max(l.b, r.b), v = std::sqrt(b);
    p.duration = 3 * h / v;
    p.j = 2.0 / 9 * b * v / (h * h);
    if (l.b > 0) {
      p.v = v;
      p.a = -rest_tie(h) * b;
    }
    return p;
  }
  const double v1 = std::sqrt(l.b), v2 = std::sqrt(r.b), mean = 0.5 * (v1 + v2);
  const double R =
      std::sqrt(std::max(mean * mean + h * (l.a - r.a) * (1.0 / 3), jerk_cell_detail::min_root * mean * mean));
  p.duration = 2 * h / (mean + R);
  const double u = 1 / p.duration, m6 = 6 * (v2 - v1) * u;
  p.v = v1;
  p.a = l.a;
  p.j = (m6 - 4 * l.a - 2 * r.a) * u;
  p.snap = ((2 * l.a + 4 * r.a - m6) * u - p.j) * u;
  return p;
}

}  // namespace bahnwerk
