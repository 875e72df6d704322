#include "core/redundant/joint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/numeric/peak.hpp"
#include "core/numeric/random.hpp"
#include "core/redundant/iterative/iterative.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/fine_motion.hpp"

namespace bahnwerk {
namespace {

JointResult plan(const JointTask& task, const JointOptions& options = {}) {
  SilentProgress progress;
  return plan_joint(task, options, progress);
}

/// Peaks between samples of every axis, found by the sweep that knows nothing of the planner; what the coarse motion
/// jumps by where its pieces meet; rest at both ends; and the sum of both axes at `samples` times.
void expect_valid(const JointTask& task, const JointResult& r, int samples = 500) {
  const std::size_t axes = task.machine.axes.size();
  const bool jerk = task.machine.limits_jerk();
  const double T = r.chosen.duration;
  const std::shared_ptr<const Motion> fine = test::fine_motion(r.head, *r.coarse);
  EXPECT_DOUBLE_EQ(r.head->duration(), T);
  EXPECT_DOUBLE_EQ(r.coarse->duration(), T);
  EXPECT_DOUBLE_EQ(fine->duration(), T);
  EXPECT_GE(T, r.fastest * (1 - 1e-12));
  std::vector<double> limits;
  for (const CoarseFineAxis& a : task.machine.axes)
    for (const double limit :
         {a.coarse.velocity, a.coarse.acceleration, a.stroke, a.fine.velocity, a.fine.acceleration})
      limits.push_back(limit);
  if (jerk)
    for (const CoarseFineAxis& a : task.machine.axes)
      for (const double limit : {a.coarse.jerk, a.fine.jerk}) limits.push_back(limit);
  PeakSweep sweep(limits);
  std::size_t coarse_piece = 0;
  for (std::size_t piece = 0; piece < fine->pieces(); ++piece) {
    const double begin = fine->begin(piece), end = fine->end(piece);
    if (!(end > begin)) continue;
    while (coarse_piece + 1 < r.coarse->pieces() && r.coarse->begin(coarse_piece + 1) <= begin) ++coarse_piece;
    sweep.sweep(begin, end, false, piece, [&](PeakSamples& s) {
      const auto n = static_cast<std::size_t>(s.rule.points);
      for (std::size_t i = 0; i < n; ++i) {
        const double t = s.at(static_cast<int>(i));
        const MotionState c = r.coarse->in_piece(coarse_piece, t), f = fine->in_piece(piece, t);
        for (std::size_t k = 0; k < axes; ++k) {
          const double values[] = {c.velocity[k], c.acceleration[k], f.position[k], f.velocity[k], f.acceleration[k]};
          for (std::size_t q = 0; q < 5; ++q) s.values[(5 * k + q) * n + i] = values[q];
          if (jerk) {
            s.values[(5 * axes + 2 * k) * n + i] = c.jerk[k];
            s.values[(5 * axes + 2 * k + 1) * n + i] = f.jerk[k];
          }
        }
      }
      return true;
    });
  }
  for (std::size_t c = 0; c < limits.size(); ++c) EXPECT_LE(sweep[c].value, limits[c] * (1 + 1e-8)) << c;

  for (std::size_t k = 0; k < axes; ++k) {
    const double scale = task.machine.axes[k].coarse.velocity;
    for (const MotionState& x : {r.coarse->in_piece(0, 0), r.coarse->final_state(), fine->in_piece(0, 0)}) {
      EXPECT_NEAR(x.velocity[k], 0, 1e-9 * scale);
      if (jerk) {
        EXPECT_NEAR(x.acceleration[k], 0, 1e-7 * task.machine.axes[k].coarse.acceleration);
      }
    }
    for (std::size_t i = 1; i < r.coarse->pieces(); ++i) {
      const double t = r.coarse->begin(i);
      const MotionState a = r.coarse->in_piece(i - 1, t), b = r.coarse->in_piece(i, t);
      ASSERT_NEAR(a.position[k], b.position[k], 1e-9);
      ASSERT_NEAR(a.velocity[k], b.velocity[k], 1e-9 * scale);
      if (jerk) {
        ASSERT_NEAR(a.acceleration[k], b.acceleration[k], 1e-6 * task.machine.axes[k].coarse.acceleration);
      }
    }
  }
  std::size_t h = 0, c = 0, f = 0;
  for (int i = 0; i <= samples; ++i) {
    const double t = T * i / samples;
    const MotionState x = r.head->evaluate(t, h), xc = r.coarse->evaluate(t, c), xf = fine->evaluate(t, f);
    for (std::size_t k = 0; k < axes; ++k) ASSERT_NEAR(xc.position[k] + xf.position[k], x.position[k], 1e-12);
  }
}

/// ∫a² of all axes; Gauss' rule is exact for polynomials of degree 5.
double energy(const Motion& coarse) {
  constexpr double node[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double weight[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  double sum = 0;
  for (std::size_t i = 0; i < coarse.pieces(); ++i) {
    const double half = 0.5 * (coarse.end(i) - coarse.begin(i)), middle = coarse.begin(i) + half;
    if (!(half > 0)) continue;
    for (std::size_t q = 0; q < 4; ++q) {
      const MotionState x = coarse.in_piece(i, middle + half * node[q]);
      for (std::size_t k = 0; k < coarse.axes(); ++k) sum += half * weight[q] * x.acceleration[k] * x.acceleration[k];
    }
  }
  return sum;
}

CoarseFineMachine random_machine(Random& random) {
  CoarseFineMachine machine;
  for (const char* name : {"x", "y"}) {
    CoarseFineAxis axis;
    axis.name = name;
    axis.coarse.velocity = std::pow(10, random.uniform(2.7, 3.5));
    axis.coarse.acceleration = std::pow(10, random.uniform(3.5, 4.5));
    axis.fine.velocity = std::pow(10, random.uniform(2.7, 3.5));
    axis.fine.acceleration = std::pow(10, random.uniform(4, 5));
    axis.stroke = std::pow(10, random.uniform(0.7, 2));
    machine.axes.push_back(axis);
  }
  return machine;
}

/// With the summed limits the coarse axes have to accelerate wherever the fine ones could not alone. Where time is left
/// the head asks less of them.
TEST(Joint, RandomContoursAreSmootherThanByTheIterativeMethodAtItsDuration) {
  Random random(5);
  for (int i = 0; i < 8; ++i) {
    const CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    const Contour contour = i < 2 ? test::holes(3, 3, 12, 2) : test::random_contour(random, i < 6 ? 40 : 90);
    SilentProgress progress;
    const RedundancyResult iterative = plan_iterative(test::redundancy_task(contour, machine), {}, progress, 0, 1);
    if (iterative.fallbacks > 0) continue;
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

TEST(Joint, SmallHolesAreCutAsFastAsBothAxesTogetherCan) {
  const JointTask task = test::joint_task(test::holes(4, 4, 12, 2), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r);
  EXPECT_EQ(r.slowed, 0u);
  EXPECT_EQ(r.chosen.duration, r.fastest);
}

TEST(Joint, OneHoleInsideTheStrokeHardlyMovesTheCoarseAxes) {
  ContourBuilder b(2, {5, 0, 0});
  b.block(Mode::cut, 300);  // 300²/5 = 18 000 mm/s²: the fine axes can do that alone
  b.arc({5, 0, 0}, {0, 0, 0}, true);
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r);
  EXPECT_EQ(r.chosen.duration, r.fastest);
  for (int i = 0; i <= 100; ++i) {  // what moves it are the few milliseconds in which the head uses both axes fully
    const MotionState x = r.coarse->evaluate(r.chosen.duration * i / 100);
    EXPECT_LT(std::abs(x.position[0] - r.coarse->evaluate(0).position[0]), 5);
  }
}

/// The coarse axis, from rest to rest, has to go 2 strokes less than the tool.
TEST(Joint, ALongMoveLastsNoShorterThanTheCoarseAxisTakesForAllButTwoStrokes) {
  for (const double way : {300.0, 600.0, 1000.0}) {
    const JointTask task = test::joint_task(test::straight(way, 0), test::md2());
    const JointResult r = plan(task);
    expect_valid(task, r);
    const double least = (way - 40) / 1800 + 1800.0 / 16000;
    EXPECT_EQ(r.slowed, 1u);
    EXPECT_GE(r.certified, 1u);
    EXPECT_GT(r.chosen.duration, least);
    EXPECT_LT(r.chosen.duration, least * (1 + 1e-8));
  }
}

/// Coarse axes that are hardly free in anything once ended in no numbers.
TEST(Joint, MovesOverAMetreWithACircleBetweenAreFollowed) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::position, unlimited);
  b.line({1250, 0, 0});
  b.block(Mode::cut, 400);
  b.arc({1250, 0, 0}, {1254, 0, 0}, true);
  b.block(Mode::position, unlimited);
  b.line({0, 0, 0});
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r, 50);
  EXPECT_FALSE(r.gave_way);
  EXPECT_LT(r.chosen.duration, 1.62);
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

/// The coarse axes do what the head does, within their limits, at 400 times.
void expect_fine_axes_stand_still(const JointTask& task, const JointResult& r) {
  ASSERT_DOUBLE_EQ(r.head->duration(), r.coarse->duration());
  for (int i = 0; i <= 400; ++i) {
    const MotionState x = r.head->evaluate(r.chosen.duration * i / 400),
                      c = r.coarse->evaluate(r.chosen.duration * i / 400);
    for (std::size_t k = 0; k < task.machine.axes.size(); ++k) {
      const Limits& coarse = task.machine.axes[k].coarse;
      ASSERT_NEAR(x.position[k], c.position[k], 1e-12);
      ASSERT_NEAR(x.velocity[k], c.velocity[k], 1e-9);
      EXPECT_LE(std::abs(c.velocity[k]), coarse.velocity * (1 + 1e-9));
      EXPECT_LE(std::abs(c.acceleration[k]), coarse.acceleration * (1 + 1e-9));
      EXPECT_LE(std::abs(c.jerk[k]), coarse.jerk * (1 + 1e-6));
    }
  }
}

/// The fine axes stand still, and the coarse ones do what the head does.
TEST(Joint, TheCoarseAxesAloneAreTheLastResort) {
  for (const double per_second : {0.0, 150.0}) {
    CoarseFineMachine machine = test::md1();
    if (per_second > 0) machine = test::with_jerk(machine, per_second);
    const JointTask task = test::joint_task(test::slot(60, 8, 200), machine);
    JointOptions options;
    options.coarse_alone = true;
    const JointResult r = plan(task, options);
    EXPECT_TRUE(r.gave_way);
    expect_fine_axes_stand_still(task, r);
  }
}

/// Cells as short as such strokes ask for would be millions.
TEST(Joint, AFineAxisOfAMicrometreStandsStill) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.stroke = 0.001;
  const JointTask task = test::joint_task(test::holes(2, 2, 40, 3), machine);
  const JointResult r = plan(task);
  expect_fine_axes_stand_still(task, r);
  EXPECT_FALSE(r.gave_way);
  EXPECT_EQ(r.cells, 0u);
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
    EXPECT_FALSE(r.gave_way);
    EXPECT_NEAR(r.chosen.duration, least * stretch_of(0.25), 1e-3 * least);
  }
}

TEST(Joint, AMoveAtASlowFeedHoldsItWithALargeStroke) {
  const CoarseFineAxis axis{"x", {1800, 16000, 3418851.8}, {2000, 60000, 15370936.3}, 25};
  CoarseFineMachine machine{{axis, axis}, 0.001};
  machine.axes[1].name = "y";
  const JointTask task = test::joint_task(test::straight(48.2996, 48.2996, 19.446867615109927), machine);
  const JointResult r = plan(task);
  expect_valid(task, r, 50);
  EXPECT_LT(r.chosen.duration, 3.5142);
}

/// What the coarse axes can do by themselves is always there, the fine ones standing still.
TEST(Joint, RandomContoursAreNeverSlowerThanTheCoarseAxesAlone) {
  Random random(14);
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    const JointTask task = test::joint_task(test::random_contour(random, 800), random_machine(random));
    const JointResult r = plan(task);
    expect_valid(task, r);
    Machine coarse = head_limits(task.machine);
    for (std::size_t k = 0; k < 2; ++k) {
      coarse.axes[k].velocity = task.machine.axes[k].coarse.velocity;
      coarse.axes[k].acceleration = task.machine.axes[k].coarse.acceleration;
    }
    SilentProgress progress;
    double alone = 0;
    for (const Rest& rest : task.dwells) alone += rest.seconds;
    alone +=
        plan_acceleration_limited(PathTask{*task.path, coarse, task.feeds, task.rests}, {}, progress).law.duration();
    EXPECT_LE(r.chosen.duration, alone * (1 + 1e-4));
  }
}

TEST(Joint, AMoveWithinReachIsNotSlowed) {
  // √(35/76000) s each way; two strokes are 40 mm.
  const JointTask task = test::joint_task(test::straight(35, 20), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r);
  EXPECT_EQ(r.slowed, 0u);
  EXPECT_NEAR(r.chosen.duration, 2 * std::sqrt(35.0 / 76000), 1e-6);
}

TEST(Joint, RandomContoursOnRandomMachinesHoldAllLimits) {
  Random random(11);
  std::size_t slowed = 0;
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    const JointTask task = test::joint_task(test::random_contour(random, 400), random_machine(random));
    JointOptions options;
    options.smoothness = i % 3 == 0 ? random.uniform() : 0;
    const JointResult r = plan(task, options);
    expect_valid(task, r);
    slowed += r.slowed;
    EXPECT_GE(r.chosen.duration, r.fastest * stretch_of(options.smoothness) * (1 - 1e-12));
  }
  EXPECT_GT(slowed, 3u);
}

TEST(Joint, LimitedJerkIsHeldToo) {
  Random random(12);
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    CoarseFineMachine machine = random_machine(random);
    for (CoarseFineAxis& axis : machine.axes) {
      axis.coarse.jerk = axis.coarse.acceleration / random.uniform(0.002, 0.02);
      axis.fine.jerk = axis.fine.acceleration / random.uniform(0.002, 0.02);
    }
    const JointTask task = test::joint_task(test::random_contour(random, 60), machine);
    const JointResult r = plan(task);
    expect_valid(task, r);
    EXPECT_LE(r.chosen.duration, 1.3 * r.fastest);
  }
}

/// Pieces of the head's law are short there, and between some its jerk goes from one end of its limits to the other.
TEST(Joint, LimitedJerkAlongFreeShapes) {
  Random random(15);
  for (const double per_second : {100.0, 400.0})
    for (const CoarseFineMachine& machine : {test::md1(), test::md2()})
      for (int i = 0; i < 2; ++i) {
        SCOPED_TRACE(std::to_string(per_second) + " " + std::to_string(i));
        std::vector<double> radii;
        for (int k = 0; k < 8; ++k) radii.push_back(random.uniform(2.5, 4));
        const JointTask task = test::joint_task(test::free_shape(radii, 400), test::with_jerk(machine, per_second));
        const JointResult r = plan(task);
        expect_valid(task, r);
        EXPECT_LE(r.chosen.duration, 1.002 * r.fastest);
      }
}

/// Where curvature jumps the head's acceleration does, too: the fine axes have to take that.
TEST(Joint, LimitedJerkAlongSlots) {
  for (const double per_second : {100.0, 400.0})
    for (const double radius : {0.5, 2.0, 10.0}) {
      SCOPED_TRACE(std::to_string(per_second) + " " + std::to_string(radius));
      const JointTask task =
          test::joint_task(test::slot(2 * radius, radius, 500), test::with_jerk(test::md2(), per_second));
      const JointResult r = plan(task);
      expect_valid(task, r);
      EXPECT_LE(r.chosen.duration, 1.002 * r.fastest);
    }
}

/// As long as positioning moves stay below 0.1 m what both axes can do together is reached but for 0.2 %.
TEST(Joint, ShortMovesLoseHardlyAnything) {
  Random random(13);
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    const JointTask task = test::joint_task(test::random_contour(random, 100), i % 2 == 0 ? test::md1() : test::md2());
    const JointResult r = plan(task);
    expect_valid(task, r);
    EXPECT_LE(r.chosen.duration, 1.002 * r.fastest);
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
      const double a = r.coarse->in_piece(i, r.coarse->begin(i)).acceleration[k];
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

TEST(Joint, JerkOfSomeAxesOnlyIsRefused) {
  CoarseFineMachine machine = test::md2();
  machine.axes[0].coarse.jerk = 1e6;
  EXPECT_THROW(plan(test::joint_task(test::straight(10, 0), machine)), std::invalid_argument);
}

TEST(Joint, StopsWhenToldTo) {
  struct Stop final : Progress {
    void report(std::string_view, double, std::string_view) override {
      if (++calls == 20) throw Stopped(StopReason::cancelled);
    }
    int calls = 0;
  } stop;
  EXPECT_THROW(plan_joint(test::joint_task(test::holes(4, 4, 40, 8), test::md2()), {}, stop), Stopped);
}

}  // namespace
}  // namespace bahnwerk
