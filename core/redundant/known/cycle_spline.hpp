#pragma once
/// A coarse motion from one number per cycle: the uniform cubic B-spline in time that has the output of a filter as its
/// control points. It smooths by three more taps (1/6, 4/6, 1/6) and makes a motion whose peaks are known exactly:
/// velocity and acceleration are largest at differences of control points.
#include <cstddef>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {

/// control[axis][i], i = 0 … n: of the times (i) · step; as many cells between. At least the first three and the last
/// three of an axis are equal, so that it begins and ends at rest. Throws std::invalid_argument for fewer than four.
SplineMotion cycle_spline(const std::vector<std::vector<double>>& control, double step);

/// Returns the positions of a motion at the times i · duration/n, i = 0 … n: [axis][i].
std::vector<std::vector<double>> sampled(const Motion& motion, std::size_t n);

}  // namespace bahnwerk
