#include "core/probe/problem.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace bahnwerk {
namespace {

ProbeProblem of(std::vector<Vec> points, double tolerance) {
  ProbeProblem problem;
  problem.given = std::move(points);
  problem.point_tolerance = tolerance;
  merge_points(problem);
  return problem;
}

TEST(ProbeProblem, RepeatedPointsAreOneAndEndsStayWhereTheyAre) {
  const ProbeProblem p = of({{0, 0}, {3, 0}, {3, 0}, {3, 2e-7}, {7, 0}, {7, 2e-7}}, 1e-6);
  EXPECT_EQ(p.points, (std::vector<Vec>{{0, 0}, {3, 0}, {7, 2e-7}}));
  EXPECT_EQ(p.point_of, (std::vector<std::size_t>{0, 1, 1, 1, 2, 2}));
  EXPECT_EQ(p.edges(), 2u);
}

TEST(ProbeProblem, DensePointsDoNotShrinkToOne) {
  std::vector<Vec> row;
  for (int i = 0; i <= 20; ++i) row.push_back({0.1 * i, 0, 0});
  const ProbeProblem p = of(row, 1.0);
  EXPECT_EQ(p.points.back(), row.back());
  for (std::size_t i = 0; i < row.size(); ++i) EXPECT_LT(norm(row[i] - p.points[p.point_of[i]]), 0.25) << i;
  for (std::size_t i = 0; i + 1 < p.points.size(); ++i) EXPECT_GE(norm(p.points[i + 1] - p.points[i]), 0.25);
}

TEST(ProbeProblem, ZeroPointToleranceStillMergesEqualPoints) {
  EXPECT_EQ(of({{1, 2, 3}, {1, 2, 3}, {4, 5, 6}}, 0).points.size(), 2u);
}

TEST(ProbeProblem, OnePlaceIsNoPath) {
  EXPECT_THROW(of({}, 1e-6), InvalidInput);
  EXPECT_THROW(of({{1, 1}}, 1e-6), InvalidInput);
  EXPECT_THROW(of({{1, 1}, {1, 1}, {1, 1 + 1e-7}}, 1e-6), InvalidInput);
}

TEST(ProbeProblem, ThereAndBackIsAPath) { EXPECT_EQ(of({{0, 0}, {5, 0}, {0, 0}}, 1e-6).points.size(), 3u); }

TEST(ProbeProblem, DistanceIsFromTheSegmentNotFromItsLine) {
  EXPECT_DOUBLE_EQ(distance_from_edge({2, 1, 0}, {0, 0, 0}, {4, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(distance_from_edge({-3, 4, 0}, {0, 0, 0}, {4, 0, 0}), 5);
  EXPECT_DOUBLE_EQ(distance_from_edge({4, 3, 4}, {0, 0, 0}, {4, 0, 0}), 5);
  EXPECT_DOUBLE_EQ(distance_from_edge({1, 1, 1}, {1, 0, 1}, {1, 0, 1}), 1);
  EXPECT_EQ(distance_from_edge({0.1, 0.1, 0.1}, {0, 0, 0}, {1, 1, 1}), 0);
}

}  // namespace
}  // namespace bahnwerk
