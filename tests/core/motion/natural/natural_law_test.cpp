// The natural feed: links evenly in their parameter, everything within the limits.
#include "core/motion/natural/natural_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

/// Two lines of `leg` mm at a right angle with a link of G² between them, in one curve or in two.
struct Corner {
  Path tool;
  std::vector<double> shares;
  explicit Corner(double leg, double room = 20) {
    tool.append(std::make_shared<Line>(Vec{-leg - room, 0}, Vec{-room, 0}), 0);
    tool.append(std::make_shared<Rational>(Rational::bezier(
                    {{-room, 0}, {-0.6 * room, 0}, {-0.3 * room, 0}, {0, 0.3 * room}, {0, 0.6 * room}, {0, room}})),
                1);
    tool.append(std::make_shared<Line>(Vec{0, room}, Vec{0, leg + room}), 2);
    shares = {0, 1, 0};
  }
};

struct Problem {
  Corner corner;
  CartesianAxisPath axes;
  Machine machine{{{"x", 500, 4000, 80000}, {"y", 400, 3000, 60000}}, 0.001};
  PathTask task;
  explicit Problem(double leg, double room = 20)
      : corner(leg, room),
        axes(corner.tool, 2),
        task{axes, machine, {unlimited, unlimited, unlimited}, {true, false, false, true}} {}
  TimeLaw law(std::size_t steps = 64, Limits along = {}) const {
    Progress progress;
    return plan_natural(task, {corner.shares, steps, along}, progress);
  }
};

TEST(NaturalLaw, PassesTheLinkEvenlyInItsParameter) {
  const Problem problem(100);
  const TimeLaw law = problem.law();
  double begin = -1, end = 0;
  for (const LawPiece& piece : law.pieces())
    if (piece.segment == 1) {
      if (begin < 0) begin = piece.t0;
      end = piece.t0 + piece.duration;
    }
  const Segment& link = problem.axes[1];
  for (const LawPiece& piece : law.pieces()) {
    if (piece.segment != 1) continue;
    EXPECT_NEAR(link.parameter(piece.s), (piece.t0 - begin) / (end - begin), 1e-6);
    EXPECT_NEAR(link.parameter(piece.at(piece.duration / 2).s), (piece.t0 + piece.duration / 2 - begin) / (end - begin),
                1e-6);
  }
}

TEST(NaturalLaw, IsAtRestAtTheEndsAndContinuousInAcceleration) {
  const Problem problem(100);
  const TimeLaw law = problem.law();
  EXPECT_EQ(law.pieces().front().v, 0);
  EXPECT_EQ(law.pieces().front().a, 0);
  LawState before{0, 0, 0, 0};
  for (const LawPiece& piece : law.pieces()) {
    EXPECT_NEAR(piece.s, before.s, 1e-9);
    EXPECT_NEAR(piece.v, before.v, 1e-7);
    EXPECT_NEAR(piece.a, before.a, 1e-4);
    before = piece.at(piece.duration);
  }
  EXPECT_NEAR(before.s, problem.axes.length(), 1e-9);
  EXPECT_NEAR(before.v, 0, 1e-7);
  EXPECT_NEAR(before.a, 0, 1e-4);
}

TEST(NaturalLaw, KeepsTheLimitsAndReachesOne) {
  for (const double leg : {3.0, 30.0, 300.0}) {
    const Problem problem(leg);
    const TimeLaw law = problem.law(16);
    const std::vector<double> feeds(3, unlimited);
    const auto worst = [&] {
      VerifierInput input{problem.axes, problem.machine, law, feeds, problem.task.rests};
      input.order = 3;
      Progress progress;
      double most = 0;
      for (const Check& check : verify_motion(input, progress).checks)
        if (check_name(check).ends_with(" x") || check_name(check).ends_with(" y"))  // of an axis
          most = std::max(most, check.value / check.limit);
      return most;
    };
    EXPECT_NEAR(worst(), 1, 1e-6) << leg;
  }
}

TEST(NaturalLaw, LimitsAlongThePathSlowEverything) {
  const Problem problem(100);
  Limits along;
  along.velocity = 20;
  const TimeLaw law = problem.law(64, along);
  double fastest = 0;
  for (const LawPiece& piece : law.pieces()) fastest = std::max(fastest, piece.at(piece.duration / 2).v);
  EXPECT_LE(fastest, 20 * (1 + 1e-9));
  EXPECT_GE(fastest, 19);
  EXPECT_GT(law.duration(), problem.law().duration());
}

TEST(NaturalLaw, RefusesSharesThatDoNotFit) {
  Problem problem(100);
  Progress progress;
  EXPECT_THROW(plan_natural(problem.task, {{0, 1}, 64, {}}, progress), std::invalid_argument);
  EXPECT_THROW(plan_natural(problem.task, {{0, 0.5, 0}, 64, {}}, progress), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
