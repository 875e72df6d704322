/// Dwells and synchronous sections in a law that is otherwise optimal.
#include "core/cam/optimal/straight_sections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/optimal/optimal_law.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// 0 … 12 mm, 12 … 24 mm at 60 mm/s over 72 deg in 0.2 s, a dwell at 30 mm, back.
MotionLawProblem packing_cam() {
  MotionLawProblem problem;
  problem.method = LawMethod::optimal;
  problem.periodic = true;
  problem.length = 360;
  problem.cycle_duration = 1;
  problem.objective.weight = {0, 1, 0.1, 0.01};
  for (const auto& [at, position] : {std::pair{0, 0}, {72, 12}, {144, 24}, {200, 30}, {260, 30}})
    problem.points.push_back(testing::point_at(at, {testing::fixed(position)}));
  problem.points[1].law = problem.points[3].law = ClassicalLaw::straight;
  problem.degree = 7;
  return problem;
}

TEST(StraightSections, AreStraightInAnOptimalLaw) {
  Progress progress;
  const MotionLawProblem problem = packing_cam();
  const OptimalLaw found = plan_optimal_law(problem, progress);
  EXPECT_TRUE(found.proven);
  for (const auto& [section, velocity] : {std::pair{1, 60.0}, {3, 0.0}}) {
    const LawExtremes v = found.solution.law.section_extremes(1, static_cast<std::size_t>(section));
    EXPECT_NEAR(v.lowest.value, velocity, 1e-6);
    EXPECT_NEAR(v.highest.value, velocity, 1e-6);
  }
  EXPECT_LE(found.solution.bound->objective, found.solution.value.objective);
  MotionLawProblem free = problem;
  for (MotionPoint& point : free.points) point.law.reset();
  EXPECT_LE(plan_optimal_law(free, progress).solution.value.objective, found.solution.value.objective * (1 + 1e-8));
}

using Places = std::vector<std::vector<std::string>>;
Places refused(const MotionLawProblem& problem, bool straight) {
  Places places;
  try {
    if (straight)
      with_straight_sections(problem);
    else
      check_classical_sections(problem);
  } catch (const InvalidInput& fault) {
    for (const InputFault& each : fault.faults) places.push_back(each.place);
  }
  return places;
}

/// No rounding of the program is left in it: a dwell at 0 is at 0.
TEST(StraightSections, AreOneLineBetweenTheirNumbers) {
  Progress progress;
  MotionLawProblem problem = packing_cam();
  problem.points[3].values[0] = problem.points[4].values[0] = testing::fixed(0);
  const CamLaw law = plan_optimal_law(problem, progress).solution.law;
  std::size_t straight = 0;
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    if (law.piece(i).section != 1 && law.piece(i).section != 3) continue;
    EXPECT_EQ(law.piece(i).bernstein,
              law.piece(i).section == 1 ? (std::vector<double>{12, 24}) : (std::vector<double>{0, 0}));
    ++straight;
  }
  EXPECT_EQ(straight, 2u);
  // A dwell of free height lies where the sections beside it end.
  problem.points[3].values[0] = problem.points[4].values[0] = {-2, 2};
  problem.points[3].law.reset();
  problem.points[3].section[1] = {0, 0};
  const CamLaw free = plan_optimal_law(problem, progress).solution.law;
  for (std::size_t i = 0; i < free.pieces(); ++i) {
    if (free.piece(i).section != 3) continue;
    EXPECT_EQ(free.piece(i).degree(), 1u);
    EXPECT_NEAR(free.in_piece(i, 0, 0), free.in_piece(i - 1, 1, 0), 1e-9);
    EXPECT_NEAR(free.in_piece(i, 1, 0), free.in_piece(i + 1, 0, 0), 1e-9);
  }
}

TEST(StraightSections, ARefusalNamesEveryLawThatIsInTheWay) {
  MotionLawProblem problem = packing_cam();
  problem.points[2].values[0] = {23, 24};
  problem.points[3].section[1] = {0.5, 1};
  EXPECT_EQ(refused(problem, true), (Places{{"points", "1", "law"}, {"points", "3", "section", "velocity"}}));
  problem = packing_cam();
  problem.points[2].at = {140, 150};
  problem.points[3].at = {190, 200};  // of a dwell, whose velocity does not depend on it
  EXPECT_EQ(refused(problem, true), (Places{{"points", "1", "law"}}));
}

TEST(StraightSections, ClassicalLawsBesideThemBeginWithTheirVelocity) {
  MotionLawProblem problem = packing_cam();
  problem.points[0].law = problem.points[2].law = ClassicalLaw::polynomial_345;
  const MotionLawProblem joined = with_straight_sections(problem);
  EXPECT_EQ(joined.points[0].law, ClassicalLaw::polynomial_345);
  EXPECT_FALSE(joined.points[1].law);
  for (const std::size_t p : {1u, 2u}) {
    EXPECT_NEAR(joined.points[p].value(1).min, 60, 1e-12);
    EXPECT_TRUE(joined.points[p].value(1).fixed());
  }
  EXPECT_EQ(joined.points[3].value(1).min, 0);
  EXPECT_TRUE(joined.points[4].value(1).free());  // behind it is a spline
  problem.points[1].values.push_back({-5, 50});
  EXPECT_EQ(refused(problem, true), (Places{{"points", "1", "velocity"}}));
}

TEST(StraightSections, ClassicalLawsInMotionHaveFixedAnglesAndLeaveRoomBetweenStillPoints) {
  MotionLawProblem problem = packing_cam();
  problem.points[2].law = problem.points[4].law = ClassicalLaw::modified_sine;
  EXPECT_EQ(refused(problem, false), Places{});
  problem.points[3].at = {190, 210};
  EXPECT_EQ(refused(problem, false), (Places{{"points", "3", "at"}}));
  problem.points[3].at = {200, 200};
  problem.points[4].at = {250, 270};  // behind it a modified sine begins at rest
  EXPECT_EQ(refused(problem, false), Places{});
  problem.vibration = {{5, 0}};
  problem.points[0].still = problem.points[1].still = true;
  problem.points[3].still = problem.points[4].still = true;
  EXPECT_EQ(refused(problem, false),
            (Places{{"points", "3", "still"}, {"points", "4", "still"}, {"points", "0", "still"}}));
}

}  // namespace
}  // namespace bahnwerk::cam
