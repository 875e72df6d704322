#pragma once
/// Tighter problems. A heuristic search may return a slower motion for looser limits; a motion that keeps tighter
/// limits keeps the given ones, so that motions for tighter problems are candidates, too.
#include <vector>

#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns a speed, mm/s, that no motion within the tube can reach from rest and brake from under the problem's limits.
double unreachable_speed(const ProbeProblem& problem);

/// Returns the problem with unreachable_speed() in place of a higher speed: problems that differ by such speeds are
/// one.
ProbeProblem with_reachable_speed(ProbeProblem problem);

/// Returns problems with lower speeds; none for more than 300 points. They are fixed shares of what the whole path
/// admits, but for two close to the given one, so that they hardly depend on it. Speeds with which the points cannot be
/// passed within `duration` s, that of a motion that is known, are left out.
std::vector<ProbeProblem> slower_problems(const ProbeProblem& problem, double duration);

/// Returns problems with a narrower tube (fixed shares of the path's length) or lower limits; none for more than 300
/// points.
std::vector<ProbeProblem> weaker_problems(const ProbeProblem& problem);

enum class TightenedQuantity { speed, tolerance, acceleration, jerk, snap };
inline constexpr TightenedQuantity tightened_quantities[] = {TightenedQuantity::speed, TightenedQuantity::tolerance,
                                                             TightenedQuantity::acceleration, TightenedQuantity::jerk,
                                                             TightenedQuantity::snap};

/// Multiplies one quantity of `problem`, of every axis, by `factor`, up to its value in `given`; returns whether that
/// changes the problem.
bool scale_quantity(ProbeProblem& problem, TightenedQuantity quantity, double factor, const ProbeProblem& given);

}  // namespace bahnwerk::probe
