#pragma once
/// Straight parts of a motion [Thielemann, "Einfacher Fall"]: the profile of 15 phases along a direction, under the
/// limits that the axes leave there.
#include <cstddef>
#include <vector>

#include "core/motion/profile/profile.hpp"
#include "core/probe/problem.hpp"
#include "core/probe/straight/motion_writer.hpp"

namespace bahnwerk::probe {

/// Returns the limits L = min_k L_k/|d_k| of acceleration, jerk and snap along the unit vector d, and the problem's
/// speed.
Limits limits_along(const ProbeProblem& problem, Vec direction);

/// Returns the time at which the profile has covered `distance`, s.
double time_at(const Profile& profile, double distance);

/// Appends `profile` along the unit vector `direction` with its phases, after point `point`.
void append_straight(MotionWriter& writer, const Profile& profile, Vec direction, std::size_t point);

/// Appends the straight from rest at point `from` to rest at point `to`, which passes the points between; returns its
/// duration, s. O(points between).
double append_rest_to_rest(MotionWriter& writer, const ProbeProblem& problem, std::size_t from, std::size_t to);
/// Returns the duration of that straight, s.
double rest_to_rest_duration(const ProbeProblem& problem, std::size_t from, std::size_t to);

}  // namespace bahnwerk::probe
