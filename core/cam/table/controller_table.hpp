#pragma once
/// Motion that a controller makes of a cam table: points with derivatives by the master, joined by straight lines or by
/// polynomials of degree 5 or 7, and its distance from the law.
#include <array>
#include <cstddef>
#include <vector>

#include "core/cam/cam_law.hpp"

namespace bahnwerk::cam {

/// Curve on which a controller goes from a point to the next one.
enum class Between { straight, quintic, septic };

/// Derivatives are by the master: unit per master's unit to the power of the order, on the side of the law behind the
/// point (the last point: before it).
struct TablePoint {
  double master = 0, position = 0, velocity = 0, acceleration = 0, jerk = 0;
  Between next = Between::straight;  ///< curve from this point to the next one
};

/// The cycle that a table shows: where it begins, how long it is in master's units, and in s.
struct TableCycle {
  double begin = 0, length = 0, duration = 0;
};

struct ControllerTable {
  std::vector<TablePoint> points;
  std::vector<TablePoint> ends;  ///< states at the ends of the curves, one per curve
  /// True peak of the difference between s^(r) of the law and of the table, r = 0 … 3, unit/s^r, at cycle.duration.
  std::array<double, 4> error{};
  std::size_t steps = 0;    ///< jumps of velocity or acceleration that a short curve carries
  double longest_step = 0;  ///< length of the longest of these curves, master's unit
};

/// Makes a table with equal steps.
ControllerTable even_table(const CamLaw& law, const TableCycle& cycle, std::size_t steps, Between between);

/// Makes a table with points at the breaks of the law (where these are more than `max_points`, at its jumps); the curve
/// that is worst is divided, at a break or in its middle, until the table is within 1e-6 of the stroke and 1 % of the
/// peak jerk, or has `max_points`, or the curve is 1/64 of a piece. A polynomial of degree 5 takes position, velocity
/// and acceleration at its ends, one of degree 7 the jerk, too: it is used between points where the jerk does not jump.
/// A piece of degree 5 (7) at most is itself, where both hold. `septic` false: degree 5 alone. `own_ends`: the
/// controller knows the state at the end of each curve beside that at the begin of the next one, and carries jumps
/// exactly; else the latter counts, and a jump of velocity or acceleration takes a curve of its own, a thousandth of
/// the piece before it.
ControllerTable breaks_table(const CamLaw& law, const TableCycle& cycle, std::size_t max_points, bool septic = true,
                             bool own_ends = false);

}  // namespace bahnwerk::cam
