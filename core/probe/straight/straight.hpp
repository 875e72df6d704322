#pragma once
/// Straight parts of a motion [Thielemann, "Einfacher Fall"]: the profile of 15 phases along a direction, under what
/// the axes' limits leave there.
#include <cstddef>
#include <vector>

#include "core/motion/profile/profile.hpp"
#include "core/probe/problem.hpp"
#include "core/probe/straight/motion_writer.hpp"

namespace bahnwerk::probe {

/// L = min_k L_k/|d_k| of acceleration, jerk and snap, and the problem's speed, along the unit vector d.
ProfileLimits limits_along(const ProbeProblem& problem, Vec direction);

/// Appends `profile` along the unit vector `direction` with its phases, after point `point`.
void append_straight(MotionWriter& writer, const Profile& profile, Vec direction, std::size_t point);

/// The straight from rest at point `from` to rest at point `to`, past those in between, which are passed where they
/// are. O(points between · log).
double append_rest_to_rest(MotionWriter& writer, const ProbeProblem& problem, std::size_t from, std::size_t to);
/// Its duration, s.
double rest_to_rest_duration(const ProbeProblem& problem, std::size_t from, std::size_t to);

/// Per point the last one of the row of points that begins there, whose straight passes all of them as it has to: in
/// order, within point_tolerance, and within the tube. At least the next point; the last point has itself. Rows are
/// found from the start of the path on; a point within a row has the row's end. O(points · log points).
std::vector<std::size_t> straight_rows(const ProbeProblem& problem);

}  // namespace bahnwerk::probe
