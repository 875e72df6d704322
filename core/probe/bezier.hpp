#pragma once
/// A piece of a motion in Bernstein form: its control points enclose it (Farouki, "The Bernstein polynomial basis: a
/// centennial retrospective", CAGD 29, 2012). Distance from an edge, speed, and the strain max_k |a_k|/A_k are convex
/// functions of a vector, so their largest value at control points bounds them over the piece; halving closes in on the
/// true maximum, four times as near with each step.
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/geometry/curve/vec.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

struct Bezier {
  static constexpr std::size_t max_points = 8;
  std::array<Vec, max_points> b{};
  std::size_t n = 1;  ///< control points: degree + 1
};

/// Returns the piece Σ c_i τⁱ over τ ∈ [0, duration], s; n ≤ 8 coefficients, mm/sⁱ.
Bezier bezier(const Vec* coefficients, std::size_t n, double duration);
/// Returns the derivative with respect to τ; a piece of degree 0 has the derivative 0.
Bezier derivative(const Bezier& piece, double duration);
/// Cuts the piece in the middle (de Casteljau).
void halve(const Bezier& piece, Bezier& left, Bezier& right);

/// Returns the largest value of a convex function of the piece's vector: never less than the true one, and more than it
/// by the fraction `resolution` at most. Returns `floor` where no value exceeds it.
template <class Convex>
double peak_of(const Bezier& piece, Convex&& f, double floor = 0, double resolution = 1e-9, int depth = 40) {
  double upper = 0;
  for (std::size_t i = 0; i < piece.n; ++i) upper = std::max(upper, f(piece.b[i]));
  if (!(upper > floor)) return floor;
  const double lower = std::max(f(piece.b[0]), f(piece.b[piece.n - 1]));
  if (upper <= std::max(lower, floor) * (1 + resolution) || depth == 0) return upper;
  Bezier left, right;
  halve(piece, left, right);
  const double first = peak_of(left, f, std::max(floor, lower), resolution, depth - 1);
  return peak_of(right, f, first, resolution, depth - 1);
}

/// The strain max_k |x_k| / limit_k of a vector under the axes' limits of acceleration, jerk or snap.
struct Strain {
  Vec limit;
  double operator()(Vec x) const {
    return std::max({std::abs(x.x) / limit.x, std::abs(x.y) / limit.y, std::abs(x.z) / limit.z});
  }
};
/// Returns the strains of acceleration, jerk and snap; an axis that the problem has not got counts as unlimited.
std::array<Strain, 3> axis_strains(const ProbeProblem& problem);

}  // namespace bahnwerk::probe
