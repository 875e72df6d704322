#pragma once
/// Problems that the tests of optimal laws share.
#include "core/base/progress.hpp"
#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/problem.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::cam::testing {

inline MotionPoint point_at(double at, std::vector<Range> values, int continuity = 2) {
  MotionPoint point;
  point.at = {at, at};
  point.values = std::move(values);
  point.continuity = continuity;
  return point;
}

inline Range fixed(double value) { return {value, value}; }

/// `stroke` mm in `duration` s over 90 deg, at rest with zero acceleration at both ends.
inline MotionLawProblem rest_to_rest(double stroke, double duration) {
  MotionLawProblem problem;
  problem.length = 90;
  problem.cycle_duration = duration;
  problem.method = LawMethod::optimal;
  problem.objective.weight = {0, 1, 0.25 * duration, 0.06 * duration * duration};
  problem.points = {point_at(0, {fixed(0), fixed(0), fixed(0)}), point_at(90, {fixed(stroke), fixed(0), fixed(0)})};
  return problem;
}

/// The least objective of a basis, with the angles in the middle of their ranges.
inline SplineResult solve(const LawTask& task, const LawBasis& basis) {
  Progress progress;
  return SplineProgram(task, basis, task.middle()).solve({}, progress);
}

/// Open or periodic, some ranges, some monotone sections; derivatives are such that a law of degree 7 exists.
inline MotionLawProblem random_problem(Random& random) {
  MotionLawProblem problem;
  problem.method = LawMethod::optimal;
  problem.periodic = random.chance(0.5);
  const std::size_t count = 3 + random.below(4);
  const double seconds = random.uniform(0.001, 0.01);  // per deg
  double at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = random.uniform(0, 40);
    MotionPoint point = point_at(at, {random.chance(0.3) ? Range{s, s + random.uniform(1, 4)} : fixed(s)},
                                 2 + static_cast<int>(random.below(2)));
    if (!problem.periodic && (i == 0 || i + 1 == count)) {
      point.values.push_back(fixed(0));
      point.values.push_back(fixed(0));
    }
    problem.points.push_back(std::move(point));
    at += random.uniform(30, 90);
  }
  problem.length = problem.periodic ? at : problem.points.back().at.min;
  problem.cycle_duration = problem.length * seconds;
  problem.objective.weight = {0, 1, random.uniform(10, 40) * seconds, random.uniform(200, 900) * seconds * seconds};
  for (std::size_t i = 0; i < problem.sections(); ++i) {
    const Range a = problem.points[i].value(0), b = problem.points[problem.end_point(i)].value(0);
    if (problem.periodic && random.chance(0.2))
      problem.points[i].section[0] = {std::min(a.min, b.min) - 6, std::max(a.max, b.max) + 6};
  }
  return problem;
}

}  // namespace bahnwerk::cam::testing
