#include "core/probe/optimal/point_choice.hpp"

#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

TEST(PointChoice, SparsePointsAreAllChosenAndStayWhereTheyAre) {
  const ProbeProblem p = problem(circle(40, 6), 0.05);
  const ChosenPoints chosen = PointChoice(p).chosen();
  EXPECT_EQ(chosen.index.size(), p.points.size());
  EXPECT_EQ(chosen.at, p.points);
  for (double tube : chosen.tube) EXPECT_EQ(tube, 0.05);
}

TEST(PointChoice, OfDensePointsAFewAreChosenNearThePath) {
  ProbeProblem p = problem(circle(8000, 6), 0.05);
  p.point_tolerance = 1e-4;
  merge_points(p);
  const ChosenPoints chosen = PointChoice(p).chosen();
  EXPECT_LT(chosen.index.size(), 600u);
  EXPECT_EQ(chosen.index.front(), 0u);
  EXPECT_EQ(chosen.index.back(), p.edges());
  for (const Vec& at : chosen.at) EXPECT_NEAR(norm(at), 6, 1e-4);
  for (double tube : chosen.tube) EXPECT_GT(tube, 0.04);
}

TEST(PointChoice, PointsOfAPairAreNotBothChosenAtFirst) {
  std::vector<Vec> points = circle(40, 6);
  const Vec beside = points[20] + (points[21] - points[20]) / 1000;
  points.insert(points.begin() + 21, beside);
  EXPECT_EQ(PointChoice(problem(points, 0.05)).chosen().index.size(), 41u);
}

TEST(PointChoice, PointsWithinReachOfARestAreNotChosenAtFirst) {
  ProbeProblem p = problem(circle(8000, 6), 0.05);
  p.point_tolerance = 0.03;
  merge_points(p);
  const std::vector<std::size_t> index = PointChoice(p).chosen().index;
  for (std::size_t c = 1; c + 1 < index.size(); ++c)
    EXPECT_GE(norm(p.points[index[c]] - p.points.front()), p.point_tolerance) << index[c];
}

TEST(PointChoice, SplitAddsOnePointOrAllToEachOpenEdge) {
  ProbeProblem p = problem(circle(8000, 6), 0.05);
  p.point_tolerance = 1e-4;
  merge_points(p);
  PointChoice choice(p);
  std::vector<double> times;
  for (std::size_t i = 0; i < p.points.size(); ++i) times.push_back(static_cast<double>(i));
  const ChosenPoints before = choice.chosen();
  EXPECT_TRUE(choice.split({3, 10}, times, false));
  EXPECT_EQ(choice.chosen().index.size(), before.index.size() + 2);
  choice.chosen();
  EXPECT_TRUE(choice.split({20}, times, true));
  EXPECT_GT(choice.chosen().index.size(), before.index.size() + 4);
  EXPECT_FALSE(choice.split({20}, times, true));
}

}  // namespace
}  // namespace bahnwerk
