// Places of setpoints on known curves: lines, circles, ellipses, a space curve in pieces; the order of every
// interpolator, and that slices are the whole.
#include "core/motion/interpolation/interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "tests/core/motion/interpolation/moved.hpp"

namespace bahnwerk {
namespace {

constexpr Interpolator all[] = {Interpolator::exact, Interpolator::taylor1, Interpolator::taylor2,
                                Interpolator::quartic};

Interpolation interpolate(const test::Moved& moved, Interpolator interpolator) {
  Progress progress;
  ProgressScope stage_progress(progress, "interpolate");
  return {moved.motion, interpolator, moved.cycle_time, moved.cycles, stage_progress};
}

FeedFluctuation fluctuation(const test::Moved& moved, Interpolator interpolator) {
  return interpolate(moved, interpolator).fluctuation();
}

TEST(Interpolation, AllInterpolatorsAreExactAtConstantSpeedOnALine) {
  const auto moved =
      test::at_constant_speed(test::path_of({std::make_shared<const Line>(Vec{1, 2, 3}, Vec{31, 42, 3})}), 123, 0.002);
  for (const Interpolator interpolator : all) {
    const FeedFluctuation f = fluctuation(moved, interpolator);
    EXPECT_LE(f.largest, 1e-11);
    EXPECT_LE(f.chord_largest, 1e-11);
    EXPECT_LE(f.lag, 1e-11);
    EXPECT_LE(std::abs(f.drift), 1e-11);
  }
}

TEST(Interpolation, FirstOrderLacksTheAccelerationOnALine) {
  const auto moved =
      test::from_rest_to_rest(test::path_of({std::make_shared<const Line>(Vec{0, 0, 0}, Vec{100, 0, 0})}), 400, 0.002);
  // The largest acceleration of the law, in its quarters; what v T lacks is a T²/2.
  const double quarter = 0.2, most = 100 / (2 * quarter * quarter);
  EXPECT_NEAR(fluctuation(moved, Interpolator::taylor1).lag, most * 0.002 * 0.002 / 2, 0.02 * most * 2e-6);
  // and a T²/2 leaves out the jerk.
  EXPECT_NEAR(fluctuation(moved, Interpolator::taylor2).lag, most / quarter * 8e-9 / 6,
              0.02 * most / quarter * 8e-9 / 6);
  EXPECT_LE(fluctuation(moved, Interpolator::quartic).lag, 1e-12);
}

TEST(Interpolation, ArcExceedsTheQuarticsChordOnACircleAsKnown) {
  // The chord of a rational circle is exact: 2 r sin(l/2r) = aim.
  const double r = 20;
  const auto moved = test::at_constant_speed(test::path_of({test::quarter_ellipse(r, r)}), 160, 0.002);
  const double step = moved.path->length() / 160;
  const FeedFluctuation quartic = fluctuation(moved, Interpolator::quartic);
  // But for the last step, which goes onto the end along the arc.
  EXPECT_NEAR(quartic.chord_largest, step * step / (24 * r * r), 0.03 * step * step / (24 * r * r));
  EXPECT_NEAR(quartic.chord_mean, quartic.chord_largest / 160, 1e-12);
  EXPECT_NEAR(quartic.mean, step * step / (24 * r * r), 0.03 * step * step / (24 * r * r));
  const FeedFluctuation exact = fluctuation(moved, Interpolator::exact);
  EXPECT_LE(exact.largest, 1e-12);
  EXPECT_NEAR(exact.chord_mean, 1 - std::sin(step / 2 / r) / (step / 2 / r), 1e-11);
}

/// In parts the chords are shorter, and with them what the arc exceeds them by: as the square.
TEST(Interpolation, LongStepsOfTheQuarticAreGoneInParts) {
  const double r = 20;
  const auto moved = test::at_constant_speed(test::path_of({test::quarter_ellipse(r, r)}), 8, 0.002);
  const double step = moved.path->length() / 8, whole = step * step / (24 * r * r);
  const FeedFluctuation quartic = fluctuation(moved, Interpolator::quartic);
  EXPECT_NEAR(quartic.mean, whole / 64, 0.4 * whole / 64);  // 8 parts of what is left, of 1/64 each
  EXPECT_NEAR(fluctuation(moved, Interpolator::exact).chord_mean, whole, 0.01 * whole);
}

TEST(Interpolation, AnArcsParameterIsItsLength) {
  const auto moved = test::at_constant_speed(
      test::path_of({std::make_shared<const Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, 9, 4.0, 7)}), 200, 0.002);
  EXPECT_LE(fluctuation(moved, Interpolator::taylor1).largest, 1e-11);
  EXPECT_LE(fluctuation(moved, Interpolator::taylor2).largest, 1e-11);
}

/// By how much the mean error falls when the cycle is halved: 2^order.
double gain(const std::shared_ptr<const Path>& path, Interpolator interpolator) {
  constexpr std::size_t cycles = 640;
  return fluctuation(test::at_constant_speed(path, cycles, 0.002), interpolator).mean /
         fluctuation(test::at_constant_speed(path, 2 * cycles, 0.001), interpolator).mean;
}

TEST(Interpolation, OrdersOfTheInterpolators) {
  for (const auto& path : {test::path_of({test::quarter_ellipse(30, 12)}), test::path_of({test::quintic()})}) {
    EXPECT_NEAR(gain(path, Interpolator::taylor1), 2, 0.1);
    EXPECT_NEAR(gain(path, Interpolator::taylor2), 4, 0.3);
    EXPECT_NEAR(gain(path, Interpolator::quartic), 4, 0.3);
  }
}

TEST(Interpolation, FluctuationOfACurveOfHighDegree) {
  const auto moved = test::from_rest_to_rest(test::path_of({test::quintic()}), 400, 0.002);
  const FeedFluctuation exact = fluctuation(moved, Interpolator::exact),
                        first = fluctuation(moved, Interpolator::taylor1),
                        second = fluctuation(moved, Interpolator::taylor2),
                        quartic = fluctuation(moved, Interpolator::quartic);
  EXPECT_LE(exact.largest, 1e-6);
  EXPECT_LE(quartic.mean, 1e-3);
  EXPECT_LE(10 * quartic.mean, first.mean);
  EXPECT_LE(10 * second.mean, first.mean);
}

std::vector<std::shared_ptr<const Path>> paths() {
  // A curve, a line that goes on with another parametric speed, and short pieces of which a cycle passes several.
  const auto points = [](double x, double end, int n) {
    std::vector<std::shared_ptr<const Curve>> lines;
    for (int i = 0; i < n; ++i)
      lines.push_back(
          std::make_shared<const Line>(Vec{x + (end - x) * i / n, 26, -2}, Vec{x + (end - x) * (i + 1) / n, 26, -2}));
    return lines;
  };
  Path pieces;
  pieces.append(test::quintic(), 0);
  for (const auto& line : points(40, 60, 3)) pieces.append(line, 1);
  for (const auto& line : points(60, 61, 50)) pieces.append(line, 2);
  return {test::path_of({test::quintic()}), std::make_shared<const Path>(std::move(pieces))};
}

TEST(Interpolation, PlacesGoForwardAndEndOnTheEnd) {
  for (const auto& path : paths())
    for (const Interpolator interpolator : all) {
      const auto moved = test::at_constant_speed(path, 700, 0.002);
      const Interpolation rows = interpolate(moved, interpolator);
      EXPECT_EQ(rows.row(0).place.s, 0);
      double before = 0, off = 0;
      for (auto row = rows.row(0); row.index < moved.cycles;) {
        rows.advance(row);
        EXPECT_GE(row.place.s, before);
        EXPECT_NEAR((*path)[row.place.segment].arc_length(row.place.u), row.place.s, 1e-12);
        off = std::max(off, std::abs(row.place.s - row.law.s));
        before = row.place.s;
      }
      EXPECT_EQ(before, path->length());
      EXPECT_EQ(off, rows.fluctuation().lag);
      // What uncorrected steps of the first order would add up to is more than any place is off.
      if (interpolator == Interpolator::taylor1) {
        EXPECT_GT(std::abs(rows.fluctuation().drift), 2 * off);
      }
    }
}

TEST(Interpolation, RowsAreTheSameFromWhereverTheyAreRead) {
  for (const auto& path : paths())
    for (const Interpolator interpolator : all) {
      const Interpolation rows = interpolate(test::at_constant_speed(path, 1500, 0.001), interpolator);
      auto walked = rows.row(0);
      for (std::size_t k = 0; k <= 1500; ++k) {
        if (k % 37 == 0 || k > 1490) {
          const auto read = rows.row(k);
          EXPECT_EQ(read.place.u, walked.place.u);
          EXPECT_EQ(read.place.s, walked.place.s);
          EXPECT_EQ(read.place.segment, walked.place.segment);
          EXPECT_EQ(read.piece, walked.piece);
          EXPECT_EQ(read.index, k);
        }
        rows.advance(walked);
      }
    }
}

TEST(Interpolation, LongStepsPassManyPieces) {
  const auto path = paths()[1];
  const auto moved = test::at_constant_speed(path, 9, 0.05);
  for (const Interpolator interpolator : all) {
    const Interpolation rows = interpolate(moved, interpolator);
    EXPECT_EQ(rows.row(9).place.s, path->length());
    EXPECT_LT(rows.fluctuation().lag, 3) << static_cast<int>(interpolator);  // of steps of 7 mm
  }
}

}  // namespace
}  // namespace bahnwerk
