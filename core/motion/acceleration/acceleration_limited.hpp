#pragma once
/// Motion laws within velocity and acceleration limits of every axis: the fastest one, and the one with a braking
/// reserve [Bock 2.2.3].
///
/// Per section from rest to rest a grid is laid, one backward pass finds the largest v² from which each node can still
/// come to rest, one forward pass takes the largest v² that stays below it; cells where the law switches are divided
/// until the estimated loss falls below `tolerance`, and cells in which a limit is exceeded between the stations get a
/// smaller share of it. Sections beyond `window` cells are planned in overlapping windows, each to a stop at its end;
/// what is kept of it is what that stop cannot reach, so the law is that of the whole section. Paths that would need
/// more than `usual_cells` get wider ones, at most 10 times as wide: there the duration is up to 5e-4 above what finer
/// ones would give, and the law stays 1e-5 of the limits below them, which wide cells see less exactly. Straight
/// segments are one cell each and exact. Sections along which the axes do what they did along an earlier one take over
/// its law (core/motion/grid/section_repeats.hpp). The result is piecewise cubic in time. Cost: O(cells) time and
/// memory per section; for two axes, path evaluation included, about 85 ns per cell for one solution and 0.6 µs with
/// all rounds (tests/bench/bench_motion.cpp).
#include <cstddef>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/grid/grid.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

struct AccelerationLimitedOptions {
  bool keep_reserve = false;     ///< braking_reserve instead of time_optimal
  double braking_reserve = 0.7;  ///< K_b ∈ (0,1): the share of an axis' acceleration that bending may use
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps are corners with a stop
  double excess = 2e-9;  ///< by which a limit may be exceeded inside a cell; what remains slows the section, relative
  double tolerance = 2e-7;  ///< estimated loss of duration to the grid, relative
  int max_divisions = 5,
      max_rounds = 5;  ///< times that the grid is divided, then that limits inside cells are tightened
  GridOptions grid;
  std::size_t window = 1 << 16;  ///< cells planned at once, about; longer sections are planned piece by piece
  double usual_cells = 1e6;      ///< on paths that would need more cells get up to 10 times as wide
  double width = 1;              ///< times that cells are as wide as usual, at least: 1 … 10
};

struct AccelerationLimitedResult {
  TimeLaw law;
  std::size_t rounds = 0;  ///< most passes any section took
  std::size_t cells = 0;   ///< cells of the final grids
  std::size_t window = 0;  ///< most of them planned at once
};

/// Throws InvalidInput for limits that are not positive and for paths that turn by more than 160 000 rad, Stopped when
/// progress says so, UnreachablePose. Progress runs from `from` to `to`.
AccelerationLimitedResult plan_acceleration_limited(const PathTask& task, const AccelerationLimitedOptions& options,
                                                    Progress& progress, double from = 0, double to = 1);
/// The same for a contour on a Cartesian machine.
AccelerationLimitedResult plan_acceleration_limited(const Contour& contour, const Machine& machine,
                                                    const AccelerationLimitedOptions& options, Progress& progress,
                                                    double from = 0, double to = 1);

}  // namespace bahnwerk
