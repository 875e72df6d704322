#pragma once
/// Planned laws and limit curves as lines to draw.
#include <functional>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "docs/draw/chart.hpp"

namespace bahnwerk::draw {

inline constexpr double reserve = 0.7;  ///< K_b

AccelerationLimitedResult plan(const Contour& contour, const Machine& machine, bool keep_reserve,
                               const GridOptions& grid = {}, double tolerance = 1e-6);

/// The fastest law with limited jerk.
TimeLaw plan_smooth(const Contour& contour, const Machine& machine);
/// The coordinates of a contour, which it keeps, driven by a law.
PathMotion motion(const Contour& contour, const TimeLaw& law);
/// The contour with its corners and runs of chords rounded.
Contour rounded(const Contour& contour, double tolerance, const Machine& machine);

/// Calls `look` for states all along a motion, both sides of every border between its pieces included.
void along(const Motion& motion, const std::function<void(double t, const MotionState&)>& look);

/// v over s.
Line speed_over_length(const TimeLaw& law);
/// |a_k|/A_k over time.
Line use_over_time(const Motion& motion, const Machine& machine, std::size_t axis);
enum class Quantity { velocity, acceleration, jerk };
/// The largest share of its limit that any axis uses, over time.
Line largest_use(const Motion& motion, const Machine& machine, Quantity quantity);
/// Share of the duration in which some axis uses more than 0.999 of its acceleration or velocity.
double share_at_limit(const Motion& motion, const Machine& machine);

/// Limit curves, one line per path segment, since they jump with the curvature.
/// Largest speed at which any path acceleration is allowed at all, two axes: v² κ ≤ A_x |y'| + A_y |x'|.
std::vector<Line> highest_speed(const Contour& contour, const Machine& machine);
/// The limit curve of [Bock (2.15)].
std::vector<Line> reserve_speed(const Contour& contour, const Machine& machine);

}  // namespace bahnwerk::draw
