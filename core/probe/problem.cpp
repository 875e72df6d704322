#include "core/probe/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.hpp"

namespace bahnwerk {

void merge_points(ProbeProblem& problem) {
  const std::vector<Vec>& given = problem.given;
  problem.points.clear();
  problem.point_of.assign(given.size(), 0);
  if (given.empty()) throw InvalidInput(std::vector<InputFault>{{{"points"}, "two points are needed at least"}});
  constexpr double share = 0.25;  // the rest is left to the motion, which has one time for all of them
  const auto near = [&](Vec a, Vec b) { return norm(a - b) < share * problem.point_tolerance || a == b; };
  std::size_t last = given.size() - 1;  // the given points from here on all belong to the last point
  while (last > 0 && near(given[last - 1], given.back())) --last;
  for (std::size_t i = 0; i < last; ++i) {
    if (problem.points.empty() || !near(given[i], problem.points.back())) problem.points.push_back(given[i]);
    problem.point_of[i] = problem.points.size() - 1;
  }
  if (problem.points.empty() || problem.points.back() == given.back())
    throw InvalidInput(std::vector<InputFault>{
        {{"points"}, "all points are one within point_tolerance: there is nothing to move along"}});
  problem.points.push_back(given.back());
  for (std::size_t i = last; i < given.size(); ++i) problem.point_of[i] = problem.points.size() - 1;
}

double distance_from_edge(Vec point, Vec a, Vec b) {
  const Vec edge = b - a, from = point - a;
  const double length2 = dot(edge, edge), along = dot(from, edge);
  if (!(along > 0) || !(length2 > 0)) return norm(from);
  if (along >= length2) return norm(point - b);
  // The cross product keeps its digits where the point is near the edge's line.
  return norm(cross(from, edge)) / std::sqrt(length2);
}

double coordinate_rounding(const ProbeProblem& problem) {
  double largest = 0;
  for (const Vec& p : problem.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 16 * std::numeric_limits<double>::epsilon() * largest;
}

}  // namespace bahnwerk
