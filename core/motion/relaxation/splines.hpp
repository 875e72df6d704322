#pragma once
/// The test functions of the relaxation (relaxation.hpp) on one of its cells: quadratic B-splines and hats over nodes
/// of any spacing [de Boor: A Practical Guide to Splines, 1978]. Both sum to 1 everywhere.
#include <array>
#include <cstddef>

namespace bahnwerk {

/// A quadratic polynomial on a cell of length h: values and slopes at both ends, second derivative.
struct SplinePart {
  double begin = 0, end = 0, slope_begin = 0, slope_end = 0, second = 0;
  double at(double x) const { return begin + x * (slope_begin + x * second / 2); }
  double slope(double x) const { return slope_begin + x * second; }
  double integral(double h) const { return h * (begin + end) / 2 - second * h * h * h / 12; }
};

/// Returns the three quadratic B-splines on a cell of length h between neighbours of lengths `before` and `after`, in
/// the order of their support: the one that ends with this cell, the middle one, the one that begins with it.
inline std::array<SplinePart, 3> spline_parts(double before, double h, double after) {
  const double left = before + h, right = h + after;
  return {SplinePart{h / left, 0, -2 / left, 0, 2 / (h * left)},
          SplinePart{before / left, after / right, 2 / left, -2 / right, -2 / (h * right) - 2 / (h * left)},
          SplinePart{0, h / right, 0, 2 / right, 2 / (h * right)}};
}

}  // namespace bahnwerk
