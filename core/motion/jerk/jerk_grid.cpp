#include "core/motion/jerk/jerk_grid.hpp"

namespace bahnwerk {

double division_point(Division division, int i) {
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

template <int N>
void divide(Grid<N>& grid, const LanePath<N>& path, const LargeVector<Division>& division, ProgressScope& progress) {
  grid.divide(
      path, [&](std::size_t c) { return division[c].parts; },
      [&](std::size_t c, int i, double u0, double u1) { return u0 + division_point(division[c], i) * (u1 - u0); },
      [](std::size_t, std::size_t) {}, progress);
}

template void divide<2>(Grid<2>&, const LanePath<2>&, const LargeVector<Division>&, ProgressScope&);
template void divide<3>(Grid<3>&, const LanePath<3>&, const LargeVector<Division>&, ProgressScope&);
template void divide<5>(Grid<5>&, const LanePath<5>&, const LargeVector<Division>&, ProgressScope&);
template void divide<8>(Grid<8>&, const LanePath<8>&, const LargeVector<Division>&, ProgressScope&);

}  // namespace bahnwerk
