#include "core/motion/acceleration/acceleration_limited.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "tests/core/motion/same_bits.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

TimeLaw law(const Contour& contour, const AccelerationLimitedOptions& options = {}) {
  Progress progress;
  return plan_acceleration_limited(contour, bahnwerk::testing::two_axes(), options, progress).law;
}
double duration(const Contour& contour, const AccelerationLimitedOptions& options = {}) {
  return law(contour, options).duration();
}

Contour curve() {
  ContourBuilder b(2, {});
  b.line({30, 0, 0});
  b.arc({30, 10, 0}, {30, 5, 0}, true);
  b.polynomial({{30, -40, 30, -20}, {10, 0, 25, -10}});
  return b.finish();
}

TEST(AccelerationLimited, DurationIsConverged) {
  AccelerationLimitedOptions fine;
  fine.grid.angle = 5e-4;
  fine.tolerance = 1e-9;
  for (const bool reserve : {false, true}) {
    AccelerationLimitedOptions usual;
    usual.keep_reserve = fine.keep_reserve = reserve;
    const double converged = duration(curve(), fine);
    EXPECT_NEAR(duration(curve(), usual), converged, 1e-5 * converged) << reserve;
  }
}

TEST(AccelerationLimited, AReserveCostsTime) {
  AccelerationLimitedOptions reserve;
  reserve.keep_reserve = true;
  double before = duration(curve());
  // Errata of [Bock]: the time falls with K_b up to about 0.9 and grows again as the path acceleration vanishes.
  reserve.braking_reserve = 0.7;
  const double usual = duration(curve(), reserve);
  EXPECT_GT(usual, before * 1.001);
  reserve.braking_reserve = 0.5;
  EXPECT_GT(duration(curve(), reserve), usual);
  reserve.braking_reserve = 0.999;
  EXPECT_GT(duration(curve(), reserve), usual);
}

TEST(AccelerationLimited, InfiniteCurvatureAtAnEndIsPassable) {
  ContourBuilder b(2, {});
  b.polynomial({{0, 0, 10}, {0, 0, 0, 10}});  // (u², u³): starts in a cusp
  const double T = duration(b.finish());
  EXPECT_TRUE(std::isfinite(T));
  EXPECT_GT(T, 2 * std::sqrt(14.0 / 23000));
  EXPECT_LT(T, 0.2);
}

TEST(AccelerationLimited, TinyPiecesInALongSection) {
  ContourBuilder b(2, {});
  b.line({50, 0, 0});
  for (int i = 1; i <= 50; ++i) b.line({50 + i * 1e-5, 0, 0});
  b.line({100.0005, 0, 0});
  const double expected = 2 * std::sqrt(100.0005 / 16000);
  EXPECT_NEAR(duration(b.finish()), expected, 1e-9 * expected);
}

/// Arcs and lines without a stop.
Contour winding(int arcs, double feed = unlimited) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, feed);
  Vec at{};
  double heading = 0;
  for (int i = 0; i < arcs; ++i) {
    const double side = i % 3 ? 1 : -1, sweep = side * (0.4 + 1.2 * std::abs(std::sin(i))),
                 r = 4 + 3 * std::cos(2.0 * i);
    const Vec centre = at + r * Vec{std::cos(heading + side * M_PI / 2), std::sin(heading + side * M_PI / 2), 0};
    const Vec d = at - centre;
    at = centre + Vec{std::cos(sweep) * d.x - std::sin(sweep) * d.y, std::sin(sweep) * d.x + std::cos(sweep) * d.y, 0};
    heading += sweep;
    b.arc(at, centre, side > 0);
    if (i % 7 == 0) b.line(at = at + 5 * Vec{std::cos(heading), std::sin(heading), 0});
  }
  return b.finish();
}

TEST(AccelerationLimited, WindowsGiveTheLawOfTheWholeSection) {
  const Machine m = bahnwerk::testing::two_axes();
  Progress progress;
  const Contour contour = winding(400);
  for (const bool reserve : {false, true}) {
    AccelerationLimitedOptions whole, pieces;
    whole.keep_reserve = pieces.keep_reserve = reserve;
    const auto expected = plan_acceleration_limited(contour, m, whole, progress);
    for (const std::size_t window : {500u, 3000u, 20000u}) {
      pieces.window = window;
      const auto got = plan_acceleration_limited(contour, m, pieces, progress);
      EXPECT_NEAR(got.law.duration(), expected.law.duration(), 2e-6 * expected.law.duration()) << window;
      const auto& list = got.law.pieces();
      for (std::size_t i = 1; i < list.size(); ++i) {
        ASSERT_NEAR(list[i].v, list[i - 1].at(list[i - 1].duration).v, 1e-9 * (1 + list[i].v)) << i;
        ASSERT_EQ(list[i].s, list[i - 1].s_end);
      }
      EXPECT_NEAR(list.back().s_end, contour.path.length(), 1e-9);
    }
  }
}

TEST(AccelerationLimited, WindowsStaySmallAtASteadyFeed) {
  Progress progress;
  const Contour contour = winding(1000, 20);
  AccelerationLimitedOptions whole, windows;
  whole.window = 1 << 20;
  windows.window = 5000;
  const auto expected = plan_acceleration_limited(contour, bahnwerk::testing::two_axes(), whole, progress);
  const auto got = plan_acceleration_limited(contour, bahnwerk::testing::two_axes(), windows, progress);
  ASSERT_GT(expected.window, 10 * windows.window);
  EXPECT_LE(got.window, 2 * windows.window);
  EXPECT_NEAR(got.law.duration(), expected.law.duration(), 1e-9 * expected.law.duration());
}

TEST(AccelerationLimited, CellsGetWiderWhereThereAreTooMany) {
  Progress progress;
  const Machine m = bahnwerk::testing::two_axes();
  const Contour contour = winding(400);
  AccelerationLimitedOptions fine, wide;
  const auto exact = plan_acceleration_limited(contour, m, fine, progress);
  double before = exact.law.duration();
  for (const double cells : {30000.0, 12000.0, 1000.0}) {
    wide.usual_cells = cells;
    const auto got = plan_acceleration_limited(contour, m, wide, progress);
    EXPECT_LT(got.cells, exact.cells / 2) << cells;
    EXPECT_GT(got.law.duration(), before * (1 - 1e-6)) << cells;
    EXPECT_LT(got.law.duration(), exact.law.duration() * (1 + 5e-4)) << cells;
    before = got.law.duration();
  }
}

TEST(AccelerationLimited, CellsAreAsWideAsAsked) {
  Progress progress;
  const Machine m = bahnwerk::testing::two_axes();
  const Contour contour = winding(40);
  const auto exact = plan_acceleration_limited(contour, m, {}, progress);
  AccelerationLimitedOptions wide;
  for (const double width : {2.0, 4.0, 8.0}) {
    wide.width = width;
    const auto got = plan_acceleration_limited(contour, m, wide, progress);
    EXPECT_LT(static_cast<double>(got.cells), 1.5 / width * static_cast<double>(exact.cells)) << width;
    EXPECT_NEAR(got.law.duration(), exact.law.duration(), 5e-4 * exact.law.duration()) << width;
  }
}

TEST(AccelerationLimited, StopsWhenAsked) {
  struct Impatient final : ProgressSink {
    void report(std::string_view, double, std::string_view) override { throw Stopped(StopReason::cancelled); }
  } impatient;
  EXPECT_THROW(plan_acceleration_limited(curve(), bahnwerk::testing::two_axes(), {}, impatient), Stopped);
}

TEST(AccelerationLimited, RefusesLimitsThatAreNone) {
  Machine m = bahnwerk::testing::two_axes();
  m.axes[1].acceleration = 0;
  Progress progress;
  EXPECT_THROW(plan_acceleration_limited(curve(), m, {}, progress), InvalidInput);
}

TEST(AccelerationLimited, AStraightMoveIsItsClosedForm) {
  ContourBuilder far(2, {}), near(2, {});
  far.line({3000, 0, 0}), near.line({1, 0, 0});
  EXPECT_NEAR(duration(far.finish()), 3000.0 / 1800 + 1800.0 / 16000, 1e-12);
  EXPECT_NEAR(duration(near.finish()), 2 * std::sqrt(1.0 / 16000), 1e-12);
}

TEST(AccelerationLimited, RefusesAPathThatTurnsTooMuch) {
  ContourBuilder b(2, {});
  for (int i = 0; i < 30'000; ++i) b.arc({}, {5, 0, 0}, true);  // 2π each: 188 496 rad
  try {
    law(b.finish());
    FAIL();
  } catch (const InvalidInput& e) {
    ASSERT_EQ(e.faults.size(), 1u);
    EXPECT_EQ(e.faults[0].place, std::vector<std::string>{"contour"});
  }
}

TEST(AccelerationLimited, SameInputSameBits) { testing::expect_same_bits(law(curve()), law(curve())); }

}  // namespace
}  // namespace bahnwerk
