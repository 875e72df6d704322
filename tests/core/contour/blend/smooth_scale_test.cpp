#include "core/contour/blend/smooth_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contour/builder.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

/// A line of 20 mm, three quarters of a circle of 5 mm, a line of 20 mm.
struct Bent {
  Bent() {
    ContourBuilder b(2, {});
    b.line({20, 0, 0});
    b.arc({15, 5, 0}, {20, 5, 0}, true);
    b.line({15, -15, 0});
    contour = b.finish();
    stretch = element_runs(contour.path, 0, 3, {0, 0, 0}, {1e-6, 4.0}, silent_scope()).front();
  }
  Contour contour;
  ElementRun stretch;
};

TEST(TubeScale, OnAnArcItIsTheChordOfTheTolerance) {
  const Bent bent;
  const double length = bent.stretch.length(), middle = 20 + 5 * 0.75 * std::numbers::pi;
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const TubeScale scale(bent.stretch, 0, length, tolerance, silent_scope());
    const double chord = std::sqrt(8 * 5 * tolerance);
    EXPECT_LE(scale.at(middle), 1.01 * chord);
    EXPECT_GE(scale.at(middle), chord / 1.41) << "found by factors of 1.4";
    EXPECT_GT(scale.at(5), scale.at(middle)) << "a line is straight";
    for (double t = 0; t + 0.1 <= length; t += 0.1) EXPECT_LE(std::abs(scale.at(t + 0.1) - scale.at(t)), 0.0401) << t;
  }
}

TEST(TubeScale, BreaksAreHalfOfItApartAndRefinedTheyAreCloser) {
  const Bent bent;
  const double length = bent.stretch.length(), middle = 20 + 5 * 0.75 * std::numbers::pi;
  TubeScale scale(bent.stretch, 0, length, 0.01, silent_scope());
  const std::vector<double> breaks = scale.breaks();
  EXPECT_EQ(breaks.front(), 0);
  EXPECT_EQ(breaks.back(), length);
  const auto after = std::upper_bound(breaks.begin(), breaks.end(), middle);
  EXPECT_NEAR(*after - *(after - 1), scale.at(middle) / 2, 0.25 * scale.at(middle));
  const double before = scale.at(middle);
  EXPECT_TRUE(scale.refine({middle}));
  EXPECT_NEAR(scale.at(middle), before / 2, 0.01 * before);
  for (int i = 0; i < 30; ++i) scale.refine({middle});
  EXPECT_FALSE(scale.refine({middle}));
  EXPECT_DOUBLE_EQ(scale.at(middle), 0.01 / 16) << "a sixteenth of the tolerance";
}

TEST(TubeScale, PlacesOfAStretchAreThoseOfItsElements) {
  const Bent bent;
  EXPECT_LE(norm(point_of(bent.stretch, 12.5) - Vec{12.5, 0, 0}), 1e-12);
  EXPECT_LE(norm(point_of(bent.stretch, 20 + 5 * std::numbers::pi) - Vec{20, 10, 0}), 1e-9) << "half a turn on";
  EXPECT_LE(norm(point_of(bent.stretch, bent.stretch.length()) - Vec{15, -15, 0}), 1e-9);
}

}  // namespace
}  // namespace bahnwerk::blending
