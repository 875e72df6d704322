#pragma once
/// Divides the cells of a Grid for a jerk-limited law. Straight segments, too, need nodes where the law changes its
/// jerk, and nodes are dense near rest, where s ~ t³.
#include <cstdint>

#include "core/motion/grid/grid.hpp"

namespace bahnwerk {

/// Spacing of the parts of a cell: equal lengths, or equal times next to a rest.
enum class Spread : std::uint8_t { even, from_rest, to_rest, both };

/// The division of a cell.
struct Division {
  std::uint16_t parts = 1;
  Spread spread = Spread::even;
};

/// Returns the end of part i as a fraction of the cell.
inline double division_point(Division division, int i) {
  const double x = static_cast<double>(i) / division.parts, y = 1 - x;
  switch (division.spread) {
    case Spread::even:
      break;
    case Spread::from_rest:
      return x * x * x;
    case Spread::to_rest:
      return 1 - y * y * y;
    case Spread::both:
      return x < 0.5 ? 4 * x * x * x : 1 - 4 * y * y * y;
  }
  return x;
}

/// Divides cell c of the grid into division[c]. O(cells).
template <int N>
void divide(Grid<N>& grid, const LanePath<N>& path, const LargeVector<Division>& division, ProgressScope& progress) {
  grid.divide(
      path, [&](std::size_t c) { return division[c].parts; },
      [&](std::size_t c, int i, double u0, double u1) { return u0 + division_point(division[c], i) * (u1 - u0); },
      [](std::size_t, std::size_t) {}, progress);
}

}  // namespace bahnwerk
