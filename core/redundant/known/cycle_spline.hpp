#pragma once
/// A coarse motion from one filtered number per cycle: the uniform cubic B-spline in time with these numbers as control
/// points. It is itself a low-pass with the taps 1/6, 4/6, 1/6, and its peaks of velocity and acceleration follow
/// exactly from differences of control points.
#include <cstddef>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {

/// Returns the spline with the control points control[axis][i], i = 0 … n, mm, at the times i · `step`, s; it has n
/// cells. The first three and the last three of an axis must be equal, so that the axis begins and ends at rest. Throws
/// std::invalid_argument for fewer than four control points.
SplineMotion cycle_spline(const std::vector<std::vector<double>>& control, double step);

/// Returns the positions of a motion, [axis][i], at the n + 1 times i · duration/n.
std::vector<std::vector<double>> sampled(const Motion& motion, std::size_t n);

}  // namespace bahnwerk
