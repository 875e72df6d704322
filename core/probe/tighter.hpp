#pragma once
/// Tighter problems. A heuristic search may return a slower motion for looser limits; a motion that keeps tighter
/// limits keeps the given ones, so that motions for tighter problems are candidates, too.
#include <vector>

#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns a speed, mm/s, that no motion within the tube can reach from rest and brake from under the problem's limits.
double unreachable_speed(const ProbeProblem& problem);

/// Returns the problem itself, then problems with lower speeds, a narrower tube, and lower limits; only the problem
/// itself for more than 300 points. Speeds above unreachable_speed() are replaced by it. Lower speeds and narrower
/// tubes are fixed shares of what the whole path admits, so that they hardly depend on the given values.
std::vector<ProbeProblem> with_tighter(const ProbeProblem& problem);

enum class TightenedQuantity { speed, tolerance, acceleration, jerk, snap };
inline constexpr TightenedQuantity tightened_quantities[] = {TightenedQuantity::speed, TightenedQuantity::tolerance,
                                                             TightenedQuantity::acceleration, TightenedQuantity::jerk,
                                                             TightenedQuantity::snap};

/// Multiplies one quantity of `problem`, of every axis, by `factor`, up to its value in `given`; returns whether that
/// changes the problem.
bool scale_quantity(ProbeProblem& problem, TightenedQuantity quantity, double factor, const ProbeProblem& given);

}  // namespace bahnwerk::probe
