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

TEST(PointChoice, SplitAddsOnePointToEachOpenEdge) {
  ProbeProblem p = problem(circle(8000, 6), 0.05);
  p.point_tolerance = 1e-4;
  merge_points(p);
  PointChoice choice(p);
  const std::size_t before = choice.chosen().index.size();
  choice.split({3, 10});
  EXPECT_EQ(choice.chosen().index.size(), before + 2);
  choice.choose_all();
  EXPECT_EQ(choice.chosen().index.size(), p.points.size());
}

}  // namespace
}  // namespace bahnwerk
