#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/base/read_rows.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

CoarseFinePlan plan(Contour contour, const CoarseFineMachine& machine, const ContourPlanning& planning = {},
                    const RedundancyOptions& options = {}) {
  Progress progress;
  return plan_coarse_fine(std::move(contour), machine, planning, options, progress);
}

void expect_verified(const CoarseFinePlan& p) {
  for (const Check& c : p.contour.verification.checks)
    EXPECT_TRUE(c.passed) << check_name(c) << ": " << c.value << " against " << c.limit << " at " << c.at;
  EXPECT_TRUE(p.contour.verification.passed);
  EXPECT_GE(p.contour.bound.gap, -1e-9);
}

double check_value(const CoarseFinePlan& p, const std::string& name) {
  for (const Check& c : p.contour.verification.checks)
    if (check_name(c) == name) return c.value;
  ADD_FAILURE() << "no check " << name;
  return NAN;
}

CoarseFineMachine with_jerk(CoarseFineMachine machine) {
  for (CoarseFineAxis& axis : machine.axes) axis.coarse.jerk = 1.6e6, axis.fine.jerk = 6e6;
  return machine;
}

TEST(CoarseFinePlan, HolesAreVerifiedAndAsQuickAsTheBoundAllows) {
  const CoarseFinePlan p = plan(test::holes(4, 4, 12, 2), test::md2());
  expect_verified(p);
  EXPECT_LE(p.contour.bound.gap, 1e-5);
  EXPECT_EQ(p.trades.size(), std::size(stretches));
  EXPECT_EQ(p.energy.size(), 2u);
  EXPECT_NEAR(p.energy[0], p.trades[0].energy[0], 1e-3 * p.trades[0].energy[0]);
  EXPECT_LE(p.peak_coarse_acceleration[0], 16000 * (1 + 1e-9));
}

/// The bound is a check of the verification: no plan is shorter.
TEST(CoarseFinePlan, LongMovesAreNotMuchLongerThanTheBoundThatKnowsTheStroke) {
  Random random(16);
  for (int i = 0; i < testing::cases(3); ++i) {
    CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    if (i % 3 == 0)
      for (CoarseFineAxis& axis : machine.axes) {
        axis.stroke = random.uniform(4, 60);
        axis.coarse.acceleration = random.uniform(3000, 30000);
        axis.fine.velocity = random.uniform(500, 3000);
      }
    RedundancyOptions options;
    options.compare = false;
    const CoarseFinePlan p = plan(test::random_contour(random, 600), machine, {}, options);
    expect_verified(p);
    EXPECT_LE(p.contour.bound.gap, 0.1) << i;
  }
}

TEST(CoarseFinePlan, JerkLimitsHoldOfBothAxes) {
  const CoarseFinePlan p = plan(test::holes(3, 3, 12, 2), with_jerk(test::md2()));
  expect_verified(p);
  EXPECT_LE(check_value(p, "jerk xc"), 1.6e6 * (1 + 1e-9));
  EXPECT_LE(check_value(p, "jerk xf"), 6e6 * (1 + 1e-9));
}

TEST(CoarseFinePlan, RoundedCornersStayInTheTube) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, 400);
  for (int i = 1; i < 20; ++i) b.line({6.0 * i, i % 2 == 0 ? 0.0 : 5.0, 0});
  const Contour contour = b.finish();
  ContourPlanning planning;
  const CoarseFinePlan stops = plan(contour, test::md1(), planning);
  planning.corner_mode = CornerMode::blend;
  planning.blend_tolerance = 0.1;
  const CoarseFinePlan rounded = plan(contour, test::md1(), planning);
  expect_verified(stops);
  expect_verified(rounded);
  EXPECT_LT(rounded.contour.duration, stops.contour.duration);
  EXPECT_LE(check_value(rounded, "deviation from contour"), 0.1);
}

TEST(CoarseFinePlan, APlanarContourLeavesTheThirdAxisWhereItIs) {
  CoarseFineMachine machine = test::md2();
  machine.axes.push_back(machine.axes[0]);
  machine.axes[2].name = "z";
  const CoarseFinePlan p = plan(test::holes(2, 2, 12, 2), machine);
  expect_verified(p);
  const SetpointSource& rows = *p.contour.setpoints;
  const std::size_t zc = column_index(rows.columns(), "zc"), zf = column_index(rows.columns(), "zf");
  for_each_row(
      rows,
      [&](std::size_t, const double* row) {
        ASSERT_EQ(row[zc], 0);
        ASSERT_EQ(row[zf], 0);
      },
      [](std::size_t, std::size_t) {});
}

TEST(CoarseFinePlan, AHelixInSpaceIsVerified) {
  CoarseFineMachine machine = test::md2();
  machine.axes.push_back(machine.axes[0]);
  machine.axes[2].name = "z";
  ContourBuilder b(3, {10, 0, 0});
  b.block(Mode::cut, 400);
  b.arc({10, 0, 6}, {0, 0, 0}, true);
  b.block(Mode::position, unlimited);
  b.line({40, 30, 20});
  expect_verified(plan(b.finish(), machine));
}

TEST(CoarseFinePlan, SetpointsAreTheSumInEveryRow) {
  const CoarseFinePlan p = plan(test::holes(3, 2, 12, 2), test::md2());
  const auto& columns = p.contour.setpoints->columns();
  const char* names[] = {"x",  "y",  "vx", "vy",  "ax",  "ay",  "s",   "v",   "mode", "block", "xc",
                         "yc", "xf", "yf", "vxc", "vyc", "vxf", "vyf", "axc", "ayc",  "axf",   "ayf"};
  ASSERT_EQ(columns.size(), std::size(names));
  for (std::size_t i = 0; i < columns.size(); ++i) EXPECT_EQ(columns[i].name, names[i]);
  for_each_row(
      *p.contour.setpoints,
      [](std::size_t, const double* row) {
        for (const std::size_t k : {0, 1}) {
          ASSERT_NEAR(row[10 + k] + row[12 + k], row[k], 1e-12);
          ASSERT_LE(std::abs(row[12 + k]), 20);
          ASSERT_LE(std::abs(row[20 + k]), 60000 * (1 + 1e-9));
        }
      },
      [](std::size_t, std::size_t) {});
}

/// Cuts that meet under 0.05°, where the gantry of a machine without fine axes need not rest, and go on in an arc whose
/// curvature jumps: fine axes too short to be used, which stand still, take nothing from that, wherever the contour
/// lies.
TEST(CoarseFinePlan, UnderFineAxesThatStandStillSmallTangentJumpsArePassedAsWithoutThem) {
  const double bend = 0.05 * M_PI / 180;
  for (const double jerk : {0.0, 380.0})
    for (const RedundancyMethod method : {RedundancyMethod::joint, RedundancyMethod::iterative}) {
      double without = 0;
      for (const double stroke : {0.0, 0.003})
        for (const Vec at : {Vec{0, 0, 0}, Vec{31.25, -17.5, 0}}) {
          CoarseFineMachine machine = jerk > 0 ? test::with_jerk(test::md2(), jerk) : test::md2();
          for (CoarseFineAxis& axis : machine.axes) axis.stroke = stroke;
          if (!(stroke > 0))
            for (CoarseFineAxis& axis : machine.axes) axis = coarse_alone(axis);
          ContourBuilder b(2, at);
          b.block(Mode::cut, 400);
          b.line(at + Vec{4, 0, 0});
          b.line(at + Vec{4 + 4 * std::cos(bend), 4 * std::sin(bend), 0});
          const Vec along{std::cos(bend), std::sin(bend), 0}, across{-along.y, along.x, 0};
          const Vec end = at + Vec{4, 0, 0} + 4 * along;
          b.arc(end + 2 * along + 2 * across, end + 2 * across, true);
          RedundancyOptions options;
          options.method = method;
          options.compare = false;
          const CoarseFinePlan p = plan(b.finish(), machine, {}, options);
          expect_verified(p);
          if (without == 0) without = p.contour.duration;
          EXPECT_NEAR(p.contour.duration, without, 1e-6 * without) << "stroke " << stroke << ", jerk " << jerk;
        }
    }
}

TEST(CoarseFinePlan, ALongMoveIsVerifiedAndNotBelowItsBound) {
  const CoarseFinePlan p = plan(test::straight(600, 200), test::md1());
  expect_verified(p);
  EXPECT_GE(p.contour.duration, p.contour.bound.value);
}

/// The filter lets the head wait at both ends, which is not a dwell of the contour.
TEST(CoarseFinePlan, DwellsKeepTheirBlocksWhereTheHeadWaitsForAFilter) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::position, unlimited);
  for (int k = 1; k <= 8; ++k) b.line({2.0 * k, k % 2 == 0 ? 0.0 : 3.0, 0});
  b.block(Mode::cut, 300);
  b.dwell(0.05);
  for (int k = 9; k <= 16; ++k) b.line({2.0 * k, k % 2 == 0 ? 0.0 : 3.0, 0});
  b.dwell(0.02);
  for (const RedundancyMethod method : {RedundancyMethod::filter, RedundancyMethod::lag_compensation})
    for (const bool again : {false, true}) {
      RedundancyOptions options;
      options.method = method;
      options.reparametrise = again;
      ContourBuilder copy = b;
      const CoarseFinePlan p = plan(copy.finish(), test::md2(), {}, options);
      expect_verified(p);
      EXPECT_EQ(p.gave_way.size(), 0u);
      ASSERT_EQ(p.contour.blocks.size(), 2u);
      EXPECT_GT(p.contour.blocks[0].end_time - p.contour.blocks[0].start_time, 0.02);
      EXPECT_GT(p.contour.blocks[1].end_time - p.contour.blocks[1].start_time, 0.07);
    }
}

/// What a slow filter leaves to the fine axes is nearly all of the motion, and they are slow.
TEST(CoarseFinePlan, WhereAMethodFindsNothingTheJointPlannerPlans) {
  RedundancyOptions options;
  options.method = RedundancyMethod::filter;
  options.taps = 301;
  options.cutoff = 0.1;
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.fine.velocity = 5;
  const CoarseFinePlan p = plan(test::straight(600, 200), machine, {}, options);
  expect_verified(p);
  EXPECT_EQ(p.gave_way.size(), 1u);
  EXPECT_LT(p.contour.duration, 2);
}

/// A plan on less is one on more: lone moves of any length on machines of any stroke, with limited jerk or without.
TEST(CoarseFinePlan, RandomLoneMovesAreVerifiedAndNeverSlowerWithMoreStrokeOrAcceleration) {
  Random random(3516);
  for (int i = 0; i < testing::cases(12); ++i) {
    CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    if (i % 4 > 1) machine = test::with_jerk(machine, random.uniform(30, 400));
    const double way = std::pow(10, random.uniform(0.5, 3.4)), angle = i % 3 == 0 ? 0 : random.uniform(0, 6.28);
    RedundancyOptions options;
    options.compare = false;
    const auto time = [&](const CoarseFineMachine& m) {
      const CoarseFinePlan p = plan(test::straight(way * std::cos(angle), way * std::sin(angle)), m, {}, options);
      expect_verified(p);
      EXPECT_EQ(p.gave_way.size(), 0u);
      return p.contour.duration;
    };
    double before = 1e9;
    for (const double stroke : {0.0, 0.001, 0.7, 12.0, 300.0}) {
      CoarseFineMachine other = machine;
      for (CoarseFineAxis& axis : other.axes) {
        axis.stroke = stroke;
        if (!(stroke > 0)) axis = coarse_alone(axis);
      }
      const double now = time(other);
      EXPECT_LE(now, before * (1 + 2e-6)) << "stroke " << stroke << ", way " << way;
      before = now;
    }
    before = 1e9;
    for (const double factor : {0.5, 1.0, 2.0}) {
      CoarseFineMachine other = machine;
      for (CoarseFineAxis& axis : other.axes) axis.fine.acceleration *= factor;
      const double now = time(other);
      EXPECT_LE(now, before * (1 + 2e-6)) << "fine acceleration " << factor << ", way " << way;
      before = now;
    }
  }
}

/// The bound of a lone move is what its coarse axis needs, with its jerk; the closed form needs no cells, however small
/// the stroke is.
TEST(CoarseFinePlan, TheBoundOfALoneMoveKnowsStrokeAndJerk) {
  for (const double stroke : {0.001, 0.5, 12.0}) {
    CoarseFineMachine machine = test::with_jerk(test::md2(), 80);
    for (CoarseFineAxis& axis : machine.axes) axis.stroke = stroke;
    const CoarseFinePlan p = plan(test::straight(430, 0), machine);
    expect_verified(p);
    EXPECT_LE(p.contour.bound.gap, 1e-6);
  }
}

/// A stroke of 9 µm is worth a half of the time that a move of 18 µm takes: whether there are cells for it does not
/// depend on the coarse axes' acceleration.
TEST(CoarseFinePlan, OnTinyStrokesMoreCoarseAccelerationIsNeverSlower) {
  RedundancyOptions options;
  options.compare = false;
  for (const bool jerk : {false, true}) {
    double before = 1e9;
    for (const double acceleration : {2000.0, 6000.0, 9000.0, 40000.0}) {
      CoarseFineMachine machine = test::md1();
      for (CoarseFineAxis& axis : machine.axes) axis.stroke = 0.009, axis.coarse.acceleration = acceleration;
      if (jerk)
        for (CoarseFineAxis& axis : machine.axes) axis.coarse.jerk = 2e6, axis.fine.jerk = 2e7;
      const CoarseFinePlan p = plan(test::straight(0.018, 0), machine, {}, options);
      expect_verified(p);
      EXPECT_LE(p.contour.duration, before * (1 + 1e-6)) << acceleration;
      before = p.contour.duration;
    }
  }
}

/// With 2.5 µm of stroke the filter's motion along 0.45 mm takes 0.34 s where the gantry alone takes 0.015 s: it is the
/// filter's that was asked for, and a note has both figures. With 1 µm it finds none.
TEST(CoarseFinePlan, AMethodThatFiltersKeepsItsPlanWhereTheGantryAloneIsQuicker) {
  RedundancyOptions options;
  options.method = RedundancyMethod::filter;
  for (const double stroke : {0.001, 0.0025}) {
    CoarseFineMachine machine = test::md1();
    for (CoarseFineAxis& axis : machine.axes) axis.stroke = stroke;
    const CoarseFinePlan p = plan(test::straight(0.4501, 0), machine, {}, options);
    expect_verified(p);
    const double alone = 2 * std::sqrt(0.4501 / 8000);
    if (stroke < 0.002) {
      ASSERT_EQ(p.gave_way.size(), 1u);
      EXPECT_EQ(p.gave_way[0].reason, GivingWay::no_motion);
      EXPECT_LE(p.contour.duration, alone * (1 + 1e-6));
      continue;
    }
    EXPECT_TRUE(p.gave_way.empty());
    EXPECT_GT(p.contour.duration, alone);
    char figure[40];
    std::snprintf(figure, sizeof figure, "take %.6g s", alone);
    EXPECT_NE(p.contour.notes.back().find(figure), std::string::npos) << p.contour.notes.back();
  }
}

/// A closed form may use the jerks of both axes in full, which a head that is planned by itself does not where one of
/// them takes longer to build up its acceleration: its coarse axes are made smoother within what it really does.
TEST(CoarseFinePlan, ALoneMoveWithUnevenJerksMayBeSmoother) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.coarse.jerk = 1e6, axis.fine.jerk = 8e6, axis.stroke = 1;
  RedundancyOptions options;
  options.compare = false;
  const CoarseFinePlan quick = plan(test::straight(0.01, 0), machine, {}, options);
  options.smoothness = 0.25;
  const CoarseFinePlan smooth = plan(test::straight(0.01, 0), machine, {}, options);
  expect_verified(quick);
  expect_verified(smooth);
  EXPECT_EQ(smooth.gave_way.size(), 0u);
  EXPECT_LE(smooth.energy[0], quick.energy[0]);
}

/// x has a fine axis, y has none.
TEST(CoarseFinePlan, OneRedundantAxisIsEnough) {
  CoarseFineMachine machine = test::md2(), alone = machine;
  machine.axes[1] = coarse_alone(machine.axes[1]);
  for (CoarseFineAxis& axis : alone.axes) axis = coarse_alone(axis);
  RedundancyOptions options;
  options.compare = false;
  const CoarseFinePlan p = plan(test::holes(2, 1, 12, 2), machine, {}, options),
                       slow = plan(test::holes(2, 1, 12, 2), alone, {}, options);
  expect_verified(p);
  expect_verified(slow);
  EXPECT_EQ(p.gave_way.size(), 0u);
  EXPECT_LE(check_value(p, "stroke yf"), 1e-9);
  EXPECT_GT(check_value(p, "stroke xf"), 0.1);
  EXPECT_LT(p.contour.duration, slow.contour.duration);
}

/// A helix with z on the coarse axis alone: its coarse axis does what the tool does, and limits the climb.
TEST(CoarseFinePlan, HeightMayBeACoarseAxisAlone) {
  CoarseFineMachine machine = test::md1();
  machine.axes.push_back(coarse_alone({"z", {60, 2000}, {}, 0}));
  ContourBuilder b(3, {10, 0, 0});
  b.block(Mode::cut, 400);
  b.arc({10, 0, 9}, {0, 0, 0}, true);
  b.line({30, 0, 0});
  RedundancyOptions options;
  options.compare = false;
  const CoarseFinePlan p = plan(b.finish(), machine, {}, options);
  expect_verified(p);
  EXPECT_EQ(p.gave_way.size(), 0u);
  EXPECT_LE(check_value(p, "stroke zf"), 1e-9);
  EXPECT_GT(check_value(p, "stroke xf"), 0.1);
  EXPECT_NEAR(check_value(p, "velocity zc"), 60, 0.5);  // z is what limits the motion
}

/// With less acceleration a head may have more jerk, so more acceleration of one axis alone must not take that away.
TEST(CoarseFinePlan, WithLimitedJerkMoreAccelerationIsNotSlower) {
  RedundancyOptions options;
  options.compare = false;
  for (Limits CoarseFineAxis::*stage : {&CoarseFineAxis::coarse, &CoarseFineAxis::fine}) {
    double before = 1e9;
    for (const double factor : {1.0, 1.6, 2.5}) {
      CoarseFineMachine machine = test::with_jerk(test::md1(), 60);
      for (CoarseFineAxis& axis : machine.axes) (axis.*stage).acceleration *= factor;
      const CoarseFinePlan p = plan(test::holes(2, 1, 12, 2), machine, {}, options);
      expect_verified(p);
      EXPECT_LE(p.contour.duration, before * (1 + 1e-6)) << factor;
      before = p.contour.duration;
    }
  }
}

/// Another method asks for two axes of every coordinate.
TEST(CoarseFinePlan, WhereAnAxisHasNoFineOneTheJointPlannerPlans) {
  CoarseFineMachine machine = test::md1();
  machine.axes[0] = coarse_alone(machine.axes[0]);
  RedundancyOptions options;
  options.method = RedundancyMethod::iterative;
  const CoarseFinePlan p = plan(test::holes(2, 1, 12, 2), machine, {}, options);
  expect_verified(p);
  EXPECT_EQ(p.gave_way.size(), 1u);
}

}  // namespace
}  // namespace bahnwerk
