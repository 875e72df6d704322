#include "core/motion/jerk/peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

/// h″ = (2 + s − s³/4, s⁵/20 − s²), h′ its integral from (0.5, −1).
JerkStation<2> quintic(double s) {
  return {Lanes<2>{0.5 + 2 * s + s * s / 2 - s * s * s * s / 16, -1 + std::pow(s, 6) / 120 - s * s * s / 3},
          Lanes<2>{2 + s - s * s * s / 4, std::pow(s, 5) / 20 - s * s},
          Lanes<2>{1 - 0.75 * s * s, std::pow(s, 4) / 4 - 2 * s}};
}

TEST(JerkPeaks, ACellWhoseCurvatureIsAQuinticIsExact) {
  constexpr double h = 1.7;
  for (const double sm : {0.5 * h, 0.3 * h, 0.8 * h}) {
    const CellPath<2> path(quintic(0), quintic(sm), quintic(h), sm, h);
    for (const double s : {0.0, 0.1, 0.77, 1.2, 1.7}) {
      const JerkStation<2> found = path.at(s), expected = quintic(s);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(found.d1[k], expected.d1[k], 1e-12);
        EXPECT_NEAR(found.d2[k], expected.d2[k], 1e-12);
        EXPECT_NEAR(found.d3[k], expected.d3[k], 1e-11);
      }
    }
  }
}

TEST(JerkPeaks, OnALineTheyAreThoseOfTheLaw) {
  // A line with q′ = (0.6, 0.8); v from 10 by a = 20 + 300 t for 0.1 s.
  const LawPiece law{0, 0.1, 0, 0, 10, 20, 300, 0};
  JerkStation<2> line;
  line.d1 = Lanes<2>{0.6, 0.8};
  RowLimits<2> limit;
  limit.inverse_velocity2 = {1e-4, 1e-4}, limit.inverse_acceleration = {0.01, 0.02}, limit.inverse_jerk = {1e-3, 1e-3};
  const CellPlaces path{line, line, law.at(0.1).s, [&](double) { return line; }};
  const auto peaks = cell_peaks(law, path, limit, 1 / 400.0);
  EXPECT_NEAR(peaks.acceleration[0], 0.6 * 50 * 0.01, 1e-12);
  EXPECT_NEAR(peaks.acceleration[1], 0.8 * 50 * 0.02, 1e-12);
  EXPECT_NEAR(peaks.jerk[1], 0.8 * 300 * 1e-3, 1e-12);
  EXPECT_NEAR(peaks.velocity, 13.5 * 13.5 / 400, 1e-12);  // the feed, 20 mm/s, counts more than the axes' 100 mm/s
  EXPECT_NEAR(peaks.most(), 0.8, 1e-12);
  EXPECT_GE(peaks.doubt, peaks.most());
}

TEST(JerkPeaks, TheFastestPlaceMayLieInside) {
  // v = 10 + 40 t − 200 t²/2: its peak is 14 at 0.2 s.
  EXPECT_NEAR(peak_speed2({0, 0.3, 0, 0, 10, 40, -200, 0}), 14 * 14, 1e-12);
  EXPECT_NEAR(peak_speed2({0, 0.1, 0, 0, 10, 40, -200, 0}), 13 * 13, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
