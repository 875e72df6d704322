#include "core/verify/probe/probe_checks.hpp"

#include <map>

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

std::map<std::string, Check> checks(const ProbeProblem& problem, const Motion& motion,
                                    const std::vector<double>& times) {
  Progress silent;
  std::map<std::string, Check> out;
  for (const Check& check : probe_checks({problem, motion, times}, silent)) out[check_name(check)] = check;
  return out;
}

std::vector<std::string> failed(const std::map<std::string, Check>& all) {
  std::vector<std::string> names;
  for (const auto& [name, check] : all)
    if (!check.passed) names.push_back(name);
  return names;
}

using Names = std::vector<std::string>;

class ProbeChecks : public testing::Test {
 protected:
  ProbeProblem problem_ = problem({{0, 0}, {10, 0}, {10, 8}}, 0.2);
  ProbeMotion plan_ = [this] {
    Progress silent;
    return plan_arcs(problem_, silent);
  }();
};

TEST_F(ProbeChecks, ARightMotionPasses) { EXPECT_EQ(failed(checks(problem_, *plan_.motion, plan_.times)), Names{}); }

TEST_F(ProbeChecks, TheTubeIsHeldBetweenSamples) {
  const double deviation = checks(problem_, *plan_.motion, plan_.times)["deviation"].value;
  double sampled = 0;
  for (int k = 0; k <= 20000; ++k) {
    const double t = plan_.duration() * k / 20000;
    const MotionState x = plan_.motion->evaluate(t);
    const std::size_t edge = t < plan_.times[1] ? 0 : 1;
    sampled =
        std::max(sampled, distance_from_edge({x[0][0], x[0][1]}, problem_.points[edge], problem_.points[edge + 1]));
  }
  EXPECT_GE(deviation, sampled);
  EXPECT_LE(deviation, sampled * (1 + 1e-4));
  problem_.tolerance = 0.99 * deviation;
  EXPECT_EQ(failed(checks(problem_, *plan_.motion, plan_.times)), Names{"deviation"});
}

TEST_F(ProbeChecks, EdgesArePassedInOrderNotAsOneSet) {
  // The same motion with the corner's time put off: on its way up the second edge the head is still held to the first.
  std::vector<double> late = plan_.times;
  late[1] += 0.1;
  EXPECT_EQ(failed(checks(problem_, *plan_.motion, late)), (Names{"deviation", "points"}));
}

TEST_F(ProbeChecks, EachLimitIsHeld) {
  ProbeMotion quick = slowed(plan_, 0.999);
  EXPECT_EQ(failed(checks(problem_, *quick.motion, quick.times)),
            (Names{"acceleration x", "acceleration y", "jerk x", "jerk y", "snap x", "snap y", "speed"}));
  problem_.speed *= 0.9999;
  EXPECT_EQ(failed(checks(problem_, *plan_.motion, plan_.times)), Names{"speed"});
}

TEST_F(ProbeChecks, APointThatIsMissedIsFound) {
  problem_.given[1].y += 3e-6;
  EXPECT_EQ(failed(checks(problem_, *plan_.motion, plan_.times)), Names{"points"});
}

TEST_F(ProbeChecks, PointsTakenForOneHaveToBeOne) {
  problem_.given.insert(problem_.given.begin() + 1, Vec{5, 0});
  problem_.point_of = {0, 1, 1, 2};
  EXPECT_EQ(failed(checks(problem_, *plan_.motion, plan_.times)), Names{"points"});
}

TEST_F(ProbeChecks, TimesAscendFromTheStartToTheEnd) {
  std::vector<double> times = plan_.times;
  times.back() += 1e-3;
  EXPECT_EQ(failed(checks(problem_, *plan_.motion, times)), (Names{"deviation", "points"}));
}

TEST_F(ProbeChecks, EndsAreThePoints) {
  problem_.given.back().y += 2e-9;
  EXPECT_EQ(failed(checks(problem_, *plan_.motion, plan_.times)), Names{"end position"});
}

TEST(ProbeChecksOfSplines, AJumpOfJerkIsFound) {
  // From rest to rest by a quintic: jerk is not 0 at the ends.
  ProbeProblem p = problem({{0, 0}, {1, 0}}, 0.2, 2, 20, 1e6, 1e6, 1e9);
  const SplineMotion quintic(std::vector<SplineMotion::Piece>{{1, {{0, 0, 0, 10, -15, 6}, {0}}}});
  EXPECT_EQ(failed(checks(p, quintic, {0, 1})), (Names{"end at rest", "start at rest"}));
  const SplineMotion septic(std::vector<SplineMotion::Piece>{{1, {{0, 0, 0, 0, 35, -84, 70, -20}, {0}}}});
  EXPECT_EQ(failed(checks(p, septic, {0, 1})), Names{});
  EXPECT_NEAR(checks(p, septic, {0, 1})["speed"].value, 35.0 / 16, 1e-8);
}

}  // namespace
}  // namespace bahnwerk
