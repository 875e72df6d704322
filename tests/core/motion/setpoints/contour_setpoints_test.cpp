#include "core/motion/setpoints/contour_setpoints.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/law/block_times.hpp"
#include "slowed.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

Machine machine(std::size_t axes = 2) { return testing::equal_axes(axes, 1800, 16000); }

using test::slowed;

struct Planned {
  Contour contour;
  Cycles cycles;
  std::shared_ptr<const PathMotion> motion;
};

Planned planned(const Machine& m) {
  ContourBuilder b(m.dimension(), {});
  b.block(Mode::cut, 400);
  b.line({20, 0, 0});
  b.arc({20, 20, 0}, {20, 10, 0}, true);
  b.nurbs(3, {{20, 20, 0}, {10, 20, 0}, {0, 30, 0}, {-10, 20, 0}, {-20, 20, 0}}, {1, 2, 1, 1, 1},
          {0, 0, 0, 0, 0.4, 1, 1, 1, 1});
  Planned p;
  p.contour = b.finish();
  Progress progress;
  const TimeLaw law = plan_acceleration_limited(p.contour, m, {}, progress).law;
  p.cycles = whole_cycles(law.duration(), m.cycle_time);
  p.motion = slowed(p.contour, m, law, p.cycles);
  return p;
}

TEST(PathMotion, VelocityAndAccelerationAreDerivatives) {
  const auto t = planned(machine()).motion;
  std::size_t piece = 0;
  const double d = 1e-6;
  int compared = 0;
  for (double at = 0.0107; at < t->duration() - 0.01; at += 0.0053) {
    const MotionState before = t->evaluate(at - d, piece), here = t->evaluate(at, piece),
                      after = t->evaluate(at + d, piece);
    if (t->law().find(at - d) != t->law().find(at + d)) continue;  // a joint of the law in between
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR((after[0][k] - before[0][k]) / (2 * d), here[1][k], 1e-4);
      EXPECT_NEAR((after[1][k] - before[1][k]) / (2 * d), here[2][k], 1);
    }
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(PathMotion, WritesWhatItsStatesAre) {
  for (const std::size_t axes : {2, 3}) {
    const auto t = planned(machine(axes)).motion;
    std::vector<double> out(3 * axes + 1, 12345.0);
    for (std::size_t piece = 0; piece < t->pieces(); ++piece) {
      const double at = t->begin(piece) + 0.3 * (t->end(piece) - t->begin(piece));
      t->write_driven(piece, t->along(piece, at), out.data());
      const MotionState state = t->in_piece(piece, at);
      for (std::size_t k = 0; k < axes; ++k) {
        EXPECT_EQ(out[k], state[0][k]);
        EXPECT_EQ(out[axes + k], state[1][k]);
        EXPECT_EQ(out[2 * axes + k], state[2][k]);
      }
    }
    EXPECT_EQ(out[3 * axes], 12345.0);
  }
}

TEST(ContourSetpoints, EndAtRestOnTheLastRowAndSlicesAgree) {
  const Machine m = machine();
  const Planned t = planned(m);
  const ContourSetpoints points(t.motion, t.contour, m, t.cycles.count);
  ASSERT_EQ(points.columns().size(), 10u);
  EXPECT_EQ(points.columns()[0].name, "x");
  EXPECT_EQ(points.columns()[3].name, "vy");
  EXPECT_EQ(points.columns()[4].unit, "mm/s²");
  EXPECT_EQ(points.columns()[6].name, "s");
  EXPECT_EQ(points.columns()[8].name, "mode");
  EXPECT_EQ(points.columns()[9].name, "block");
  std::vector<double> all(points.count() * 10), slice(3 * 10);
  points.read(0, points.count(), all.data());
  points.read(points.count() / 2, 3, slice.data());
  for (std::size_t i = 0; i < slice.size(); ++i) EXPECT_EQ(slice[i], all[points.count() / 2 * 10 + i]);
  const double* last = all.data() + (points.count() - 1) * 10;
  EXPECT_EQ(last[0], -20);
  EXPECT_EQ(last[1], 20);
  for (const int i : {2, 3, 4, 5, 7}) EXPECT_EQ(last[i], 0);
  EXPECT_EQ(last[6], t.contour.path.length());
  EXPECT_EQ(all[0], 0);
  EXPECT_EQ(all[7], 0);
}

TEST(ContourSetpoints, ThreeAxesHaveThirteenColumns) {
  const Machine m = machine(3);
  const Planned t = planned(m);
  EXPECT_EQ(ContourSetpoints(t.motion, t.contour, m, t.cycles.count).columns().size(), 13u);
}

/// The third axis of a planar contour stands at the contour's height, in every row.
TEST(ContourSetpoints, ThirdAxisStandsAtTheContoursHeight) {
  const Machine m = machine(3);
  Planned t = planned(machine());
  t.contour.height = 7.25;
  t.motion = slowed(t.contour, m, t.motion->law(), {t.cycles.count, 1});
  const ContourSetpoints points(t.motion, t.contour, m, t.cycles.count);
  std::vector<double> all(points.count() * 13);
  points.read(0, points.count(), all.data());
  for (std::size_t k = 0; k < points.count(); ++k) {
    ASSERT_EQ(all[13 * k + 2], 7.25);
    ASSERT_EQ(all[13 * k + 5], 0);
    ASSERT_EQ(all[13 * k + 8], 0);
  }
}

/// Rows of the columns mode and block, of 10 mm in each block.
TEST(ContourSetpoints, ModeAndBlockChangeWhereTheBlocksMeet) {
  ContourBuilder b(2, {});
  b.block(Mode::position, unlimited);  // left empty
  b.block(Mode::cut, 200);
  b.line({10, 0, 0});
  b.block(Mode::position, unlimited);
  b.line({20, 0, 0});
  b.block(Mode::cut, unlimited);  // left empty, too
  b.block(Mode::cut, 100);
  b.line({30, 0, 0});
  b.block(Mode::position, unlimited);
  const Contour contour = b.finish();
  ASSERT_EQ(contour.blocks.size(), 6u);
  const Machine m = machine();
  Progress progress;
  const TimeLaw law = plan_acceleration_limited(contour, m, {}, progress).law;
  const Cycles cycles = whole_cycles(law.duration(), m.cycle_time);
  const auto t = slowed(contour, m, law, cycles);
  const ContourSetpoints points(t, contour, m, cycles.count);
  const std::vector<BlockTime> times = block_times(contour, t->law());
  ASSERT_EQ(times.size(), 6u);
  EXPECT_EQ(times[0].end, 0);
  EXPECT_EQ(times[3].begin, times[3].end);
  EXPECT_EQ(times[5].end, t->duration());
  std::vector<double> rows(points.count() * 10);
  points.read(0, points.count(), rows.data());
  for (std::size_t k = 0; k < points.count(); ++k) {
    const double s = rows[10 * k + 6], at = static_cast<double>(k) * m.cycle_time;
    const std::size_t block = s < 10 ? 1 : s < 20 ? 2 : 4;
    ASSERT_EQ(rows[10 * k + 9], static_cast<double>(block)) << k;
    ASSERT_EQ(rows[10 * k + 8], block == 2 ? 0 : 1) << k;
    ASSERT_GE(at, times[block].begin) << k;
    ASSERT_LE(at, times[block].end * (1 + 1e-15)) << k;
  }
  // Any row by itself says the same.
  for (std::size_t k = 0; k < points.count(); ++k) {
    double row[10];
    points.read(k, 1, row);
    ASSERT_EQ(row[9], rows[10 * k + 9]) << k;
  }
}

}  // namespace
}  // namespace bahnwerk
