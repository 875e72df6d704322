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
double division_point(Division division, int i);

/// Divides cell c of the grid into division[c]. O(cells).
template <int N>
void divide(Grid<N>& grid, const LanePath<N>& path, const LargeVector<Division>& division, ProgressScope& progress);

extern template void divide<2>(Grid<2>&, const LanePath<2>&, const LargeVector<Division>&, ProgressScope&);
extern template void divide<3>(Grid<3>&, const LanePath<3>&, const LargeVector<Division>&, ProgressScope&);
extern template void divide<5>(Grid<5>&, const LanePath<5>&, const LargeVector<Division>&, ProgressScope&);
extern template void divide<8>(Grid<8>&, const LanePath<8>&, const LargeVector<Division>&, ProgressScope&);

}  // namespace bahnwerk
