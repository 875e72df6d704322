#pragma once
/// The fastest motion law within velocity, acceleration and jerk limits of every axis and of the path. Acceleration is
/// continuous and zero at both ends of every section [Bock Def. 2.6], [Herrmann (4.80)].
///
/// Each section from rest to rest gets a grid by turn and by time. An interior-point method (solver.hpp) finds v² and a
/// at its nodes. Cells in which the law switches are divided, and the problem is solved again. Cells in which a limit
/// is exceeded between nodes get a smaller share of it. The rest of any excess slows the section uniformly, so limits
/// hold everywhere. The result is piecewise quartic in time. A straight segment alone between two rests has a closed
/// form (profile.hpp). The problem is not convex, so the result is a local optimum. Sections that repeat an earlier one
/// take over its law (core/motion/grid/section_repeats.hpp). If the method fails, other starts are tried, and finally a
/// slow law that holds the limits.
///
/// Long sections are planned in windows (windows.ipp). Cost: O(cells); a smooth spline takes 20 to 28 iterations, 3.5
/// to 4.7 µs per cell from 1e3 to 1e6 cells (tests/bench/bench_jerk.cpp). Through kinematics cells are wider, windows
/// shorter and the start is slower (docs/methods/motion.md): 400 cells per turn of a coil, 40 to 80 Newton steps.
#include <cstddef>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/jerk/start.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The options of plan_jerk_limited().
struct JerkLimitedOptions {
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps are corners with a stop
  Limits path;              ///< limits of v mm/s, |a| mm/s², |j| mm/s³ along the path; infinite by default
  double gap = 1e-4;        ///< loss of duration to the solver, relative
  double tolerance = 1e-4;  ///< loss of duration to the grid, relative, estimated; 6 times as much through kinematics
  double angle = 0.02;      ///< largest turn of a cell, rad; 5 times as much through kinematics
  /// Number of cells, before division, that are planned at once in longer sections; half of it through kinematics. 0
  /// plans every section as a whole.
  std::size_t window = 2400;
  /// Largest number of divisions of the grid for accuracy, and largest number of divisions and reductions of shares
  /// because of excesses.
  int max_divisions = 3, max_rounds = 40;
};

/// The law, with figures of its computation.
struct JerkLimitedResult {
  TimeLaw law;
  std::size_t iterations = 0;  ///< Newton steps times cells, divided by the cells, over all rounds
  std::size_t cells = 0;       ///< cells of the final grids
};

/// Throws InvalidInput for limits that are not positive, Stopped when `progress` says so, UnreachablePose.
JerkLimitedResult plan_jerk_limited(const PathTask& task, const JerkLimitedOptions& options, Progress progress);
/// Plans a contour on a Cartesian machine.
JerkLimitedResult plan_jerk_limited(const Contour& contour, const Machine& machine, const JerkLimitedOptions& options,
                                    Progress progress);

}  // namespace bahnwerk
