#pragma once
/// Checks the setpoints: every row against the motion that was verified.
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Inputs of the check.
struct SetpointInput {
  const AxisPath& path;
  const Machine& machine;
  const TimeLaw& law;  ///< the verified law, slowed to whole cycles
  const SetpointSource& setpoints;
  const Contour* contour = nullptr;  ///< contour whose blocks the columns mode and block describe, if they exist
  /// Factor from each axis' unit to that of its columns, such as 180/π for rad shown in deg; empty: 1.
  std::vector<double> shown = {};
  /// Distance by which an interpolator may place a row before or behind the law's place, along the path, relative to
  /// the longest distance of the law in one cycle.
  double lag = 0;
};

/// Returns the check of every row. It evaluates path and law at the rows' times, so the rows keep the limits of the
/// motion. Row k is the state just
/// after t = k · cycle time; the last row is at rest, exactly at the path's end. core/verify/rounding.hpp defines ε and
/// the rounding of a piece of the law. In addition t has an error of ε t, so with the law's v, a, j at that time:
///
/// `setpoints count`         1      |rows − (duration / cycle time + 1)|; plus the number of missing columns: 0
/// `setpoints time`          s      (rows − 1) · cycle time against the law's duration: 32 ε of it
/// `setpoints path`          mm     column s against the law: 32 ε (|s| + |v| T …) + v ε t + lag · max v · cycle time
/// `setpoints speed`         mm/s   column v against the law: 32 ε (|v| + |a| T …) + |a| ε t
/// `setpoints forward`       mm     largest decrease of s from row to row: 32 ε of the path's length
/// `setpoints position`      mm     axes against the path at the row's s: 32 ε (|q| + |q′| · length of the segment)
/// `setpoints velocity`      mm/s   axes against q′ v with the row's s and v: 32 ε |q′| v
/// `setpoints acceleration`  mm/s²  axes against q″ v² + q′ a: 32 ε (|q″| v² + |q′| |a|) + |q′| (32 ε (|a| + |j| T …) +
///                                  |j| ε t)
/// `setpoints mode and block`  1    rows with another mode or block than the segment or dwell at which the law is: 0
/// `setpoints end`           mm     last row: distance from the path's end and of s from its length: 0
/// `setpoints end at rest`   mm/s   last row: largest |v|, and |a| · cycle time, of any axis and of the path: 0
///
/// |q| is the norm over all axes with equal weights: mm stands for the axis' unit. Each check reports the row that is
/// closest to its tolerance; `at` is its time. A value that is not a number fails. Cost per row, reading included: 62
/// ns on lines, 160 ns on arcs, 220 ns on cubics, of which reading takes 22, 75, 100 ns (bench_verify). The objects
/// that `input` refers to have to outlive the check.
std::unique_ptr<RowCheck> path_row_check(const SetpointInput& input);

/// Returns the results after reading all rows for this check alone, 1024 at a time. Reports every 2048 rows; passes its
/// exceptions on.
std::vector<Check> setpoint_checks(const SetpointInput& input, Progress progress);

}  // namespace bahnwerk
