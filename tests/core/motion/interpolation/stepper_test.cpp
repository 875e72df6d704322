#include "core/motion/interpolation/stepper.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/geometry/curve/line.hpp"
#include "tests/core/motion/interpolation/moved.hpp"

namespace bahnwerk {
namespace {

std::shared_ptr<const Path> two_lines() {
  return test::path_of({std::make_shared<const Line>(Vec{0, 0, 0}, Vec{3, 0, 0}),
                        std::make_shared<const Line>(Vec{3, 0, 0}, Vec{3, 4, 0})});
}

TEST(Stepper, StepsOfALineAreTheTermsOfTheirOrder) {
  const auto path = two_lines();
  const double T = 0.01;
  const LawState law{1, 20, 300, 4e4};
  const double next = 1 + 20 * T + 300 * T * T / 2 + 4e4 * T * T * T / 6;
  const PathPlace from{0, path->operator[](0).parameter(1), 1};
  EXPECT_NEAR(Stepper(*path, Interpolator::taylor1, T).next(from, law, next).s, 1.2, 1e-13);
  EXPECT_NEAR(Stepper(*path, Interpolator::taylor2, T).next(from, law, next).s, 1.215, 1e-13);
  EXPECT_NEAR(Stepper(*path, Interpolator::quartic, T).next(from, law, next).s, next, 1e-12);
  EXPECT_EQ(Stepper(*path, Interpolator::exact, T).next(from, law, next).s, next);
}

TEST(Stepper, AStepMakesUpForThePlaceBehindTheLawAndNeverGoesBack) {
  const auto path = two_lines();
  const Stepper stepper(*path, Interpolator::taylor1, 0.01);
  const PathPlace from{0, path->operator[](0).parameter(1), 1};
  EXPECT_NEAR(stepper.next(from, {1.25, 20, 0, 0}, 1.45).s, 1.45, 1e-13);
  const PathPlace stays = stepper.next(from, {0.5, 20, 0, 0}, 0.7);
  EXPECT_EQ(stays.s, 1);
  EXPECT_EQ(stays.u, from.u);
}

TEST(Stepper, TheRestOfAStepGoesOnBehindTheJointAndEndsWithThePath) {
  const auto path = two_lines();
  for (const Interpolator interpolator : {Interpolator::taylor1, Interpolator::quartic, Interpolator::exact}) {
    const Stepper stepper(*path, interpolator, 0.1);
    const PathPlace at = stepper.next({0, path->operator[](0).parameter(2.5), 2.5}, {2.5, 10, 0, 0}, 3.5);
    EXPECT_EQ(at.segment, 1u);
    EXPECT_NEAR(at.s, 3.5, 1e-12);
    EXPECT_EQ(stepper.next(at, {3.5, 100, 0, 0}, 7).s, path->length());
  }
}

}  // namespace
}  // namespace bahnwerk
