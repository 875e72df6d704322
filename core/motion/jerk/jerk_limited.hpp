#pragma once
/// The fastest motion law within velocity, acceleration and jerk limits of every axis and of the path: smooth
/// acceleration, at rest with zero acceleration at both ends of every section [Bock Def. 2.6], [Herrmann (4.80)].
///
/// Per section from rest to rest a grid is laid by turn and by time, an interior-point method (solver.hpp) finds
/// v² and a at its nodes, cells in which the law switches are divided and the problem solved again; cells in which a
/// limit is exceeded between nodes get a smaller share of it; what remains slows the section uniformly, so that limits
/// hold everywhere. The result is piecewise quartic in time with continuous acceleration. A straight segment alone
/// between two rests takes the closed form (profile.hpp). The problem is not convex: what is found is a local optimum.
/// Sections along which the axes do what they did along an earlier one take over its law
/// (core/motion/grid/section_repeats.hpp). Should the method find nothing, other starts are tried, and at last a slow
/// law that holds the limits.
///
/// Long sections are planned window by window (windows.cpp). Cost: O(cells), linear; a smooth spline takes 20 to
/// 28 iterations in all, 3.5 to 4.7 µs per cell from 1e3 to 1e6 cells (tests/bench/bench_jerk.cpp). Through kinematics
/// cells are wider, windows shorter, and the start is slower (docs/methods/motion.md): 400 cells per turn of a coil,
/// 40 to 80 Newton steps on them.
#include <cstddef>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/jerk/start.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

struct JerkLimitedOptions {
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps are corners with a stop
  Limits path;              ///< limits of v mm/s, |a| mm/s², |j| mm/s³ along the path; infinite unless given
  double gap = 1e-4;        ///< loss of duration to the solver, relative
  double tolerance = 1e-4;  ///< loss of duration to the grid, relative, estimated; six times as much through kinematics
  double angle = 0.02;      ///< most a cell turns, rad; five times as much through kinematics
  /// Cells of longer sections that are planned at once, before they are divided, through kinematics half of it; 0 =
  /// all.
  std::size_t window = 2400;
  /// Times that the grid is divided for accuracy, and that it is divided or shares are tightened for what cells exceed.
  int max_divisions = 3, max_rounds = 40;
};

struct JerkLimitedResult {
  TimeLaw law;
  std::size_t iterations = 0;  ///< Newton steps, times cells, over the cells: all rounds
  std::size_t cells = 0;       ///< cells of the final grids
};

/// Throws InvalidInput for limits that are not positive, Stopped when progress says so, UnreachablePose. Progress runs
/// from `from` to `to`.
JerkLimitedResult plan_jerk_limited(const PathTask& task, const JerkLimitedOptions& options, Progress& progress,
                                    double from = 0, double to = 1);
/// The same for a contour on a Cartesian machine.
JerkLimitedResult plan_jerk_limited(const Contour& contour, const Machine& machine, const JerkLimitedOptions& options,
                                    Progress& progress, double from = 0, double to = 1);

}  // namespace bahnwerk
