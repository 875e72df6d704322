#include "core/motion/acceleration_limited.hpp"

#include <gtest/gtest.h>

#include "core/contour/builder.hpp"
#include "core/errors.hpp"
#include "two_axes.hpp"

namespace bahnwerk {
namespace {

double duration(const Contour& contour, const AccelerationLimitedOptions& options = {}) {
  SilentProgress progress;
  return plan_acceleration_limited(contour, bahnwerk::testing::two_axes(), options, progress).law.duration();
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

TEST(AccelerationLimited, TinyPiecesInALongRun) {
  ContourBuilder b(2, {});
  b.line({50, 0, 0});
  for (int i = 1; i <= 50; ++i) b.line({50 + i * 1e-5, 0, 0});
  b.line({100.0005, 0, 0});
  const double expected = 2 * std::sqrt(100.0005 / 16000);
  EXPECT_NEAR(duration(b.finish()), expected, 1e-9 * expected);
}

TEST(AccelerationLimited, StopsWhenAsked) {
  struct Impatient final : Progress {
    void report(std::string_view, double, std::string_view) override { throw Stopped(StopReason::cancelled); }
  } impatient;
  EXPECT_THROW(plan_acceleration_limited(curve(), bahnwerk::testing::two_axes(), {}, impatient), Stopped);
}

TEST(AccelerationLimited, RefusesLimitsThatAreNone) {
  Machine m = bahnwerk::testing::two_axes();
  m.axes[1].acceleration = 0;
  SilentProgress progress;
  EXPECT_THROW(plan_acceleration_limited(curve(), m, {}, progress), InvalidInput);
}

TEST(AccelerationLimited, SameInputSameBits) { EXPECT_EQ(duration(curve()), duration(curve())); }

}  // namespace
}  // namespace bahnwerk
