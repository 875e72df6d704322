#include "core/redundant/joint/joint_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/redundant/iterative/iterative.hpp"
#include "tests/core/redundant/joint_plans.hpp"

namespace bahnwerk {
namespace {

using test::energy, test::expect_valid, test::plan;

/// With the summed limits the coarse axes have to accelerate wherever the fine ones could not alone. Where time is left
/// the head asks less of them.
TEST(Joint, RandomContoursAreSmootherThanByTheIterativeMethodAtItsDuration) {
  Random random(5);
  for (int i = 0; i < 8; ++i) {
    const CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    const Contour contour = i < 2 ? test::holes(3, 3, 12, 2) : test::random_contour(random, i < 6 ? 40 : 90);
    Progress progress;
    const Expected<RedundancyResult, NoPlan> found =
        plan_iterative(test::redundancy_task(contour, machine), {}, progress);
    if (!found) continue;
    const RedundancyResult& iterative = *found;
    const JointTask task = test::joint_task(contour, machine);
    JointOptions options;
    options.stretch = iterative.head->duration() / plan(task).chosen.duration;
    ASSERT_GE(options.stretch, 1);
    const JointResult joint = plan(task, options);
    expect_valid(task, joint);
    EXPECT_NEAR(joint.chosen.duration, iterative.head->duration(), 1e-6 * joint.chosen.duration);
    // A mean square of a thousandth of the limits is what the solver's tolerance leaves of standing still.
    double still = 0;
    for (const CoarseFineAxis& axis : machine.axes)
      still += 1e-6 * axis.coarse.acceleration * axis.coarse.acceleration * joint.chosen.duration;
    EXPECT_LT(energy(*joint.coarse), std::max(energy(*iterative.coarse), still)) << i;
  }
}

/// A longer duration leaves a lone move some freedom, and the solver finds what it is good for.
TEST(Joint, ALoneMoveIsSlowedEvenlyAndSmoothlyForSmoothness) {
  const JointTask task = test::joint_task(test::straight(940, 0), test::md2());
  JointOptions options;
  options.smoothness = 0.75;
  const JointResult r = plan(task, options);
  expect_valid(task, r, 50);
  const double least = (900.0 / 1800 + 1800.0 / 16000) * 1.02;
  EXPECT_NEAR(r.chosen.duration, least, 1e-6 * least);
  EXPECT_LT(energy(*r.coarse), 2 * 1800 * 16000.0);
}

/// Its coarse axis is an ordinary one, which gentler limits of the others have nothing to give to.
TEST(Joint, AMoveWithOneFineAxisIsSmoothedToo) {
  CoarseFineMachine machine = test::md1();
  machine.axes[0] = coarse_alone(machine.axes[0]);
  JointOptions options;
  options.smoothness = 0.25;
  for (const auto& [contour, least] : {std::pair{test::straight(0, 1787.2), (1787.2 - 90) / 1600 + 1600.0 / 8000},
                                       std::pair{test::straight(209, 209, 50), 209 * std::sqrt(2) / 50}}) {
    const JointResult r = plan(test::joint_task(contour, machine), options);
    EXPECT_NEAR(r.chosen.duration, least * stretch_of(0.25), 1e-3 * least);
  }
}

TEST(Joint, MoreTimeTakesLessEnergy) {
  const JointTask task = test::joint_task(test::holes(4, 3, 60, 8), test::md2());
  JointOptions options;
  options.compare = true;
  options.smoothness = 0.75;
  const JointResult r = plan(task, options);
  expect_valid(task, r);
  ASSERT_EQ(r.trades.size(), std::size(stretches));
  for (std::size_t i = 0; i < r.trades.size(); ++i) {
    EXPECT_DOUBLE_EQ(r.trades[i].duration, r.trades[0].duration * stretches[i]);
    for (std::size_t k = 0; i > 0 && k < 2; ++k) EXPECT_LT(r.trades[i].energy[k], r.trades[i - 1].energy[k]);
  }
  EXPECT_EQ(r.chosen.stretch, 1.02);
  EXPECT_EQ(r.chosen.energy, r.trades[3].energy);
  // ∫a² of the pieces themselves
  for (std::size_t k = 0; k < 2; ++k) {
    double energy = 0;
    for (std::size_t i = 0; i < r.coarse->pieces(); ++i) {
      const double a = r.coarse->in_piece(i, r.coarse->begin(i))[2][k];
      energy += a * a * (r.coarse->end(i) - r.coarse->begin(i));
    }
    EXPECT_NEAR(r.chosen.energy[k], energy, 1e-9 * energy);
  }
}

/// Most of the time nothing accelerates: what time is added goes where the coarse axes work.
TEST(Joint, AddedTimeGoesWhereCoarseAxesWorkHardest) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, 10);
  b.line({100, 0, 0});
  b.block(Mode::cut, 400);
  for (int i = 0; i < 4; ++i) b.line({i % 2 == 0 ? 160.0 : 100.0, 10.0 * i, 0});
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const auto energy = [&](double stretch) {
    JointOptions options;
    options.stretch = stretch;
    const JointResult r = plan(task, options);
    expect_valid(task, r);
    EXPECT_NEAR(r.chosen.duration, stretch * r.fastest, 1e-9 * r.fastest);
    return r.chosen.energy[0] + r.chosen.energy[1];
  };
  const double calm = energy(1.001);
  EXPECT_LT(energy(1.02), 0.5 * calm);  // evenly slowed it would be 0.94
  EXPECT_LT(energy(1.2), 0.05 * calm);
}

TEST(Joint, SmoothnessStandsForAStretch) {
  EXPECT_EQ(stretch_of(0), 1);
  EXPECT_EQ(stretch_of(0.5), 1.01);
  EXPECT_EQ(stretch_of(1), 1.05);
  EXPECT_DOUBLE_EQ(stretch_of(0.875), 1.035);
}

}  // namespace
}  // namespace bahnwerk
