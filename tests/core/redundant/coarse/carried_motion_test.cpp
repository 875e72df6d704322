#include "core/redundant/coarse/carried_motion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

/// 2 mm of a line in 1 s and 1 s of another: the law has two pieces, the spline three.
std::shared_ptr<const PathMotion> head() {
  const JointTask task = test::joint_task(test::straight(3, 4), test::md1());
  TimeLaw law;
  law.append({0, 2, 0, 2.5, 0, 1.25, 0, 0});
  law.append({0, 2, 2.5, 5, 2.5, -1.25, 0, 0});
  return std::make_shared<const PathMotion>(task.path, std::move(law));
}

std::shared_ptr<const SplineMotion> spline() {
  return std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{1, {{0, 0, 0.5}, {0}}}, {3, {{0.5, 1}, {0}}}, {4, {{2.5, 1, -0.5}, {0}}}});
}

TEST(CarriedMotion, TakesEachAxisFromWhereItBelongs) {
  const CarriedMotion motion(head(), spline(), {false, true});
  ASSERT_EQ(motion.pieces(), 4u);
  EXPECT_EQ(motion.duration(), 4);
  for (std::size_t piece = 0; piece < 4; ++piece) {
    EXPECT_EQ(motion.begin(piece), static_cast<double>(piece));
    for (const double part : {0.0, 0.3, 1.0}) {
      const double t = motion.begin(piece) + part;
      const MotionState x = motion.in_piece(piece, t);
      EXPECT_NEAR(x[0][0], spline()->evaluate(t)[0][0], 1e-12);
      EXPECT_NEAR(x[1][0], spline()->evaluate(t)[1][0], 1e-12);
      EXPECT_NEAR(x[0][1], head()->evaluate(t)[0][1], 1e-12);
      EXPECT_NEAR(x[1][1], head()->evaluate(t)[1][1], 1e-12);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        Polynomial p;
        ASSERT_TRUE(motion.polynomial(piece, axis, p));
        EXPECT_NEAR(evaluate(p, part), x[0][axis], 1e-12);
      }
    }
  }
  EXPECT_NEAR(motion.final_state()[0][0], 3, 1e-12);
  EXPECT_NEAR(motion.final_state()[0][1], 4, 1e-12);
}

TEST(CarriedMotion, NeedsNothingElseWhereEveryAxisIsTheHeads) {
  const CarriedMotion motion(head(), nullptr, {true, true});
  EXPECT_EQ(motion.pieces(), 2u);
  EXPECT_NEAR(motion.evaluate(2)[0][0], 1.5, 1e-12);
  EXPECT_NEAR(motion.evaluate(2)[0][1], 2, 1e-12);
}

TEST(CarriedMotion, OnCurvesACarriedAxisIsNoPolynomial) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, 100);
  b.arc({0, 0, 0}, {5, 0, 0}, true);
  const JointTask task = test::joint_task(b.finish(), test::md1());
  TimeLaw law;
  law.append({0, 1, 0, task.path->length(), task.path->length(), 0, 0, 0});
  const CarriedMotion motion(std::make_shared<const PathMotion>(task.path, std::move(law)), nullptr, {true, true});
  Polynomial p;
  EXPECT_FALSE(motion.polynomial(0, 0, p));
}

TEST(CarriedMotion, AxesAreAsManyAsTheHeads) {
  EXPECT_THROW(CarriedMotion(head(), spline(), {true}), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
