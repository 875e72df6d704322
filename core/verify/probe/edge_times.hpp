#pragma once
/// Closed-form lower bounds of the time between two points of a probe path.
#include "core/probe/problem.hpp"

namespace bahnwerk {

/// The ends of a move that are at rest (v = a = j = 0).
struct Rests {
  bool begin = false, end = false;
};

/// Returns a lower bound of the time, s, that a displacement takes if it may be `shorter` mm less in every direction.
/// It is the largest of distance / speed and, per axis and derivative, the least time under that limit alone: from rest
/// to rest the derivative switches between its extremes at the zeros of a Chebyshev polynomial of the second kind
/// ((384 d/S)^¼ for snap), from rest to any state it does not switch ((24 d/S)^¼).
double least_time(const ProbeProblem& problem, Vec displacement, Rests rests, double shorter);

}  // namespace bahnwerk
