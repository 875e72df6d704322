#pragma once
/// Motion laws within velocity and acceleration limits of every axis: the fastest one, and the one with a braking
/// reserve [Bock 2.2.3].
///
/// Each section from rest to rest gets a grid. A backward pass computes the controllable set of each node: the largest
/// v² from which the section can still end at rest. A forward pass takes the largest reachable v² inside these sets
/// [Bobrow 1985; Shin, McKay 1985; Pham, Pham 2018]. Cells in which the law switches are divided until the estimated
/// loss is below `tolerance`; cells in which a limit is exceeded between the stations get a smaller share of it.
/// Sections beyond `window` cells are planned in overlapping windows, each to a stop at its end; only the part is used
/// that this stop does not influence, so the law is that of the whole section. Paths that need more than `usual_cells`
/// get wider cells, at most 10 times as wide: the duration is then up to 5e-4 above that of finer cells, and the law
/// stays below the limits by 1e-5 of them. Straight segments are one cell each and exact. Sections that repeat an
/// earlier one take over its law (core/motion/grid/section_repeats.hpp). The result is piecewise cubic in time. Cost:
/// O(cells) time and memory per section; for two axes, path evaluation included, about 85 ns per cell for one solution
/// and 0.6 µs with all rounds (tests/bench/bench_motion.cpp).
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/grid/grid.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The options of plan_acceleration_limited().
struct AccelerationLimitedOptions {
  bool keep_reserve = false;     ///< whether to keep a braking reserve; otherwise the law is time-optimal
  double braking_reserve = 0.7;  ///< K_b ∈ (0,1): the share of an axis' acceleration that bending may use
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< largest tangent jump without a stop, rad
  double excess = 2e-9;     ///< allowed relative excess over a limit inside a cell; a larger one slows the section
  double tolerance = 2e-7;  ///< estimated loss of duration to the grid, relative
  int max_divisions = 5,
      max_rounds = 5;  ///< largest number of divisions of the grid, then of reductions of limits inside cells
  GridOptions grid;
  std::size_t window =
      1 << 16;               ///< approximate number of cells planned at once; longer sections are planned in windows
  double usual_cells = 1e6;  ///< paths that need more cells get up to 10 times as wide ones
  double width = 1;          ///< least factor of the cells' width, 1 … 10
};

/// The law, with figures of its computation.
struct AccelerationLimitedResult {
  TimeLaw law;
  std::size_t rounds = 0;  ///< largest number of passes of any section
  std::size_t cells = 0;   ///< cells of the final grids
  std::size_t window = 0;  ///< largest number of cells planned at once
};

/// Throws InvalidInput for limits that are not positive and for paths that turn by more than 160 000 rad, Stopped when
/// `progress` says so, UnreachablePose.
AccelerationLimitedResult plan_acceleration_limited(const PathTask& task, const AccelerationLimitedOptions& options,
                                                    Progress progress);
/// Plans a contour on a Cartesian machine.
AccelerationLimitedResult plan_acceleration_limited(const Contour& contour, const Machine& machine,
                                                    const AccelerationLimitedOptions& options, Progress progress);

}  // namespace bahnwerk
