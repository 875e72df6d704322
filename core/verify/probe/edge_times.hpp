#pragma once
/// Closed-form lower bounds of the time between two points of a probe path.
#include "core/probe/problem.hpp"

namespace bahnwerk {

/// Which ends of a move are at rest (v = a = j = 0).
struct Rests {
  bool begin = false, end = false;
};

/// The time that a displacement takes at least, s, `shorter` mm less in every direction being granted: distance /
/// speed, and per axis and derivative the quickest move under that limit alone, which switches between its extremes at
/// the zeros of a Chebyshev polynomial of the second kind from rest to rest ((384 d/S)^¼ for snap), and does not switch
/// from rest to any state ((24 d/S)^¼).
double least_time(const ProbeProblem& problem, Vec displacement, Rests rests, double shorter);

}  // namespace bahnwerk
