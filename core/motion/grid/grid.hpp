#pragma once
/// The stations of one section of a path at which a planner evaluates limits: dense where the path turns, one cell per
/// straight segment.
///
/// A section extends from one rest to the next. Cells lie inside one segment each, so curvature may jump from cell to
/// cell. Inside a cell the curvature vector is reproduced by the cubic through its values and derivatives at both ends
/// to `hermite` of an axis limit. With this the planner holds limits between stations.
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/grid/lane_path.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// A cell of the grid.
struct GridCell {
  std::uint32_t station = 0;  ///< index of the station at the left end; the right one is station + 1
  std::uint32_t segment = 0;  ///< path segment
  bool straight = false;
  bool cusp_left = false, cusp_right = false;  ///< whether curvature is unbounded at that end, where the speed is zero
  bool any_way = false;  ///< whether the cell lies beside a needle point: path length does not resolve the turn
  bool regular() const { return !(straight | cusp_left | cusp_right | any_way); }
};

/// Limits of a motion along a path. Both have to outlive the object.
struct LaneLimits {
  const Machine& machine;           ///< limits of the lanes
  const std::vector<double>& feed;  ///< largest speed along the path per segment, mm/s
};

/// Limits of the width of cells.
struct GridOptions {
  double angle = 0.004;  ///< largest turn of a cell, rad
  double hermite =
      1e-10;  ///< allowed error of the cubic model of a curvature vector, as a fraction of the axis acceleration limit
  double longest = std::numeric_limits<double>::infinity();  ///< longest cell where q is not linear, mm
};

/// Least length of a cell of a free-form curve, as a part of its segment. Path length counts from the beginning of a
/// segment and is rounded: next to a vanishing tangent, where s ~ ρ^(m+1), it does not resolve places that the
/// parameter resolves. A motion from rest takes 1e-6 of the segment's time for this length.
constexpr double shortest_cell = 1e-12;

/// The stations and cells of a section, with N lanes.
template <int N>
class Grid {
 public:
  LargeVector<Station<N>> stations;
  LargeVector<GridCell> cells;
  double section_length = 0;  ///< mm

  double length(std::size_t c) const { return right(c).s - left(c).s; }
  const Station<N>& left(std::size_t c) const { return stations[cells[c].station]; }
  const Station<N>& right(std::size_t c) const { return stations[cells[c].station + 1]; }

  /// Reserves memory for this many cells; growing step by step would touch twice the memory.
  void reserve(std::size_t cells_expected) {
    stations.reserve(cells_expected);
    cells.reserve(cells_expected);
  }
  /// Builds the stations for the path segments [first, last). The first and the last cell are halved towards the rest
  /// at the section's ends, where the speed changes by more than its value. O(cells).
  void build(const LanePath<N>& path, std::size_t first, std::size_t last, const LaneLimits& limits,
             const GridOptions& options, ProgressScope& progress);
  /// Becomes the cells [first, last) of another grid. O(last − first).
  void slice(const Grid& of, std::size_t first, std::size_t last);
  /// Removes all cells but [0, last).
  void cut(std::size_t last);
  /// Divides cell c into parts[c] equal cells; parts[c] becomes the number of cells made. O(cells), in place but for
  /// the stations made.
  void divide(const LanePath<N>& path, LargeVector<std::uint8_t>& parts, ProgressScope& progress);
  /// Divides cell c into count(c) cells; inner part i ends at the parameter place(c, i, u0, u1) between the cell's
  /// ends. Parts finer than path length resolves (`shortest_cell`) are omitted: made(c, m) receives their number.
  /// O(cells).
  template <class Count, class Place, class Made>
  void divide(const LanePath<N>& path, Count&& count, Place&& place, Made&& made, ProgressScope& progress);

  /// Returns whether a station at `s` leaves long enough cells between two others of a segment of that length.
  static bool resolved(double before, double s, double after, double length, double shortest = shortest_cell) {
    return s - before > shortest * length && after - s > shortest * length;
  }

 private:
  /// Inner stations that divide a cell.
  struct Inner {
    std::size_t cell, stations;
  };

  void grade_end(const LanePath<N>& path, bool front);
  /// Inserts the stations `inner` of the cells `divided`, both in the cells' order. The arrays are moved within their
  /// memory as far as it suffices.
  void insert(const LargeVector<Station<N>>& inner, const LargeVector<Inner>& divided, ProgressScope& progress);
};

template <int N>
template <class Count, class Place, class Made>
void Grid<N>::divide(const LanePath<N>& path, Count&& count, Place&& place, Made&& made, ProgressScope& progress) {
  LargeVector<Station<N>> inner;
  LargeVector<Inner> divided;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    progress(c, cells.size());
    const std::size_t before = inner.size();
    const int parts = count(c);
    if (parts > 1) progress.work(static_cast<std::size_t>(parts));
    for (int i = 1; i < parts; ++i) {
      const Station<N> next = path.at(cells[c].segment, place(c, i, left(c).u, right(c).u));
      const double last = inner.size() > before ? inner.back().s : left(c).s;
      if (resolved(last, next.s, right(c).s, path[cells[c].segment].length())) inner.push_back(next);
    }
    if (inner.size() > before) divided.push_back({c, inner.size() - before});
    made(c, inner.size() - before + 1);
  }
  insert(inner, divided, progress);
}

extern template class Grid<2>;
extern template class Grid<3>;
extern template class Grid<5>;
extern template class Grid<8>;

}  // namespace bahnwerk
