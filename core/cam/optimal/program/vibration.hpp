#pragma once
/// Condition of no residual vibration: a mode of a drive train rests at two points of a law.
///
/// The mode x″ + 2ζω x′ + ω² x = −s″ that rests at t0 rests at t1 again exactly where ∫ s″(t) e^{(ζω + iω_d) t} dt = 0,
/// ω_d = ω √(1 − ζ²) (Duhamel's integral): two conditions, linear in the coefficients of a spline.
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/cam/optimal/program/law_basis.hpp"
#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

struct VibrationRow {
  std::vector<std::pair<std::size_t, double>> terms;  ///< variable of the program, weight
  double given = 0;                                   ///< contribution of given sections; the sum of both has to be 0
};
/// Returns the rows of the integral's real and imaginary part, scaled by e^{−ζω t1}. Gauss–Legendre quadrature has 12
/// points on each of the parts, which turn by 1 rad at most: it is exact to rounding up to degree 21.
std::array<VibrationRow, 2> vibration_rows(const LawTask& task, const LawBasis& basis,
                                           const std::vector<double>& breaks, const LawTask::Vibration& vibration);

}  // namespace bahnwerk::cam
