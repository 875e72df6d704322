#include "core/motion/setpoints/needle_setpoints.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/plan/winding/wound_turn.hpp"

namespace bahnwerk {
namespace {

using test::failed, test::Wound;

TEST(NeedleSetpoints, PassBothChecks) {
  const Wound wound;
  EXPECT_EQ(failed(wound.needle_checks_of(*wound.rows)), "");
  EXPECT_EQ(failed(wound.setpoint_checks_of(*wound.rows)), "");
}

std::vector<double> all_rows(const SetpointSource& source) {
  std::vector<double> all(source.count() * source.columns().size());
  source.read(0, source.count(), all.data());
  return all;
}

TEST(NeedleSetpoints, SteppedRowsAreTheSameInEverySliceAndOffTheLawByTheirLag) {
  const Wound wound;
  Progress progress;
  ProgressScope stage_progress(progress, "interpolate");
  const std::size_t cycles = wound.rows->count() - 1;
  for (const Interpolator interpolator : {Interpolator::taylor1, Interpolator::taylor2, Interpolator::quartic}) {
    const auto stepped =
        std::make_shared<const Interpolation>(wound.motion, interpolator, 0.002, cycles, stage_progress);
    const NeedleSetpoints rows(
        wound.motion, wound.machine.axes, wound.limits,
        WireForces{[](std::size_t, double, const LawState&) { return 25.0; }, [](double, double) { return 26.0; }},
        {cycles, stepped});
    EXPECT_EQ(failed(wound.needle_checks_of(rows)), "");
    EXPECT_EQ(failed(wound.setpoint_checks_of(rows)), "setpoints path");
    EXPECT_EQ(failed(wound.setpoint_checks_of(rows, 0.5)), "");
    const std::vector<double> all = all_rows(rows), exact = all_rows(*wound.rows);
    const std::size_t width = rows.columns().size();
    std::vector<double> slice(100 * width);
    for (std::size_t first = 0; first + 100 < cycles; first += 97) {
      rows.read(first, 100, slice.data());
      for (std::size_t i = 0; i < slice.size(); ++i) ASSERT_EQ(slice[i], all[first * width + i]);
    }
    double lag = 0;
    for (std::size_t k = 0; k <= cycles; ++k)
      lag = std::max(lag, std::abs(all[k * width + 25] - exact[k * width + 25]));
    EXPECT_NEAR(lag, stepped->fluctuation().lag, 1e-9);
    EXPECT_GT(lag, 1e-6);
  }
}

TEST(NeedleSetpoints, RatesOfThePoseAreItsDerivatives) {
  const Wound wound;
  const std::vector<double> all = all_rows(*wound.rows);
  const std::size_t width = wound.rows->columns().size();
  ASSERT_EQ(width, 34u);
  for (std::size_t c = 0; c < 5; ++c) {
    EXPECT_EQ(wound.rows->columns()[28 + c].name, "v" + wound.rows->columns()[20 + c].name);
    double off = 0, largest = 0;
    for (std::size_t k = 1; k + 1 < wound.rows->count(); ++k) {
      const double difference = (all[(k + 1) * width + 20 + c] - all[(k - 1) * width + 20 + c]) / 0.004;
      off = std::max(off, std::abs(difference - all[k * width + 28 + c]));
      largest = std::max(largest, std::abs(difference));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LE(off, 1e-3 * largest) << c;
  }
}

TEST(NeedleSetpoints, JerkIsTheDerivativeOfAcceleration) {
  const Wound wound;
  const std::size_t width = wound.rows->columns().size();
  std::vector<double> all(wound.rows->count() * width);
  wound.rows->read(0, wound.rows->count(), all.data());
  const double h = wound.rows->cycle_time();
  for (std::size_t k = 0; k < 5; ++k) {
    double largest = 0, off = 0;
    for (std::size_t i = 2; i + 2 < wound.rows->count(); ++i) {
      const auto j = [&](std::size_t row) { return all[row * width + 15 + k]; };
      const double slope = (all[(i + 1) * width + 10 + k] - all[(i - 1) * width + 10 + k]) / (2 * h);
      // Within the jerks around it: it may jump from one piece of the law to the next.
      const double low = std::min({j(i - 1), j(i), j(i + 1)}), high = std::max({j(i - 1), j(i), j(i + 1)});
      largest = std::max(largest, std::abs(j(i)));
      off = std::max(off, std::max(low - slope, slope - high));
    }
    EXPECT_LE(off, 0.05 * largest) << k;
  }
}

}  // namespace
}  // namespace bahnwerk
