#include "core/motion/jerk_grid.hpp"

namespace bahnwerk {

namespace {

template <int N>
Station<N> station_at(const Segment& segment, double u) {
  const PathPoint p = segment.at_parameter(u);
  Station<N> at;
  at.u = u;
  at.s = segment.travelled(u);
  for (std::size_t k = 0; k < N; ++k) {
    at.d1[k] = p.d1[k];
    at.d2[k] = p.d2[k];
    at.d3[k] = p.d3[k];
  }
  return at;
}

}  // namespace

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
void divide(Grid<N>& grid, const Path& path, const LargeVector<Division>& division, PlanningPulse& pulse) {
  LargeVector<Station<N>> stations;
  LargeVector<GridCell> cells;
  std::size_t total = 0;
  for (const Division d : division) total += d.parts;
  cells.reserve(total);
  stations.reserve(grid.stations.size() + total - grid.cells.size());
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    pulse(c, grid.cells.size());
    const GridCell& old = grid.cells[c];
    const Segment& segment = path[old.segment];
    if (c == 0 || old.station != grid.cells[c - 1].station + 1) stations.push_back(grid.left(c));
    const double u0 = grid.left(c).u, du = grid.right(c).u - u0;
    for (int i = 1; i <= division[c].parts; ++i) {
      GridCell cell = old;
      cell.station = static_cast<std::uint32_t>(stations.size() - 1);
      cell.cusp_left = old.cusp_left && i == 1;
      cell.cusp_right = old.cusp_right && i == division[c].parts;
      Station<N> next =
          i == division[c].parts ? grid.right(c) : station_at<N>(segment, u0 + division_point(division[c], i) * du);
      if (!(next.s > stations.back().s) && i < division[c].parts) continue;  // finer than path length resolves
      cells.push_back(cell);
      stations.push_back(next);
    }
  }
  grid.stations = std::move(stations);
  grid.cells = std::move(cells);
}

template void divide<2>(Grid<2>&, const Path&, const LargeVector<Division>&, PlanningPulse&);
template void divide<3>(Grid<3>&, const Path&, const LargeVector<Division>&, PlanningPulse&);

}  // namespace bahnwerk
