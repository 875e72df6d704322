#pragma once
/// Problems that several tests state in a line or two.
#include <initializer_list>
#include <vector>

#include "core/cam/problem.hpp"

namespace bahnwerk::cam::testing_problems {

inline MotionPoint point(double at, int continuity, std::vector<Range> values) {
  MotionPoint p;
  p.at = {at, at};
  p.continuity = continuity;
  p.values = std::move(values);
  return p;
}
inline Range number(double value) { return {value, value}; }
inline MotionPoint rest(double at, double position) { return point(at, 2, {number(position), number(0), number(0)}); }

/// One second per unit of the master; weights 1, 30, 900.
inline MotionLawProblem problem(double length, bool periodic, std::vector<MotionPoint> points) {
  MotionLawProblem out;
  out.length = length;
  out.cycle_duration = length;
  out.periodic = periodic;
  out.points = std::move(points);
  out.objective.weight = {0, 1, 30, 900};
  return out;
}
inline std::vector<double> angles(const MotionLawProblem& problem) {
  std::vector<double> at;
  for (const MotionPoint& p : problem.points) at.push_back(p.at.min);
  return at;
}

}  // namespace bahnwerk::cam::testing_problems
