#include "core/geometry/spline/length_spline.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "core/geometry/path/arc_length.hpp"
#include "core/geometry/spline/link.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

/// A link as on a winding head: from a slot of 60 mm into an arc behind it.
BezierPiece winding_link(double beta) {
  const auto slot = BezierPiece::line({40, 0, -30, 0, 0}, {40, 0, 30, 0, 0});
  const auto head = spline_arc({52, 6, 40, 0, 1.5}, {}, {0, 0, 1}, 1.2, {0, 0, 0, 1.2, 0}).front();
  return link(3, {slot.at(1), head.at(0)}, {{beta, 0, 0, 0}, {beta, 0, 0, 0}, {}});
}

TEST(LengthSpline, KeepsItsToleranceAgainstTheExactLength) {
  for (const double beta : {0.5, 1.0, 2.0, 5.0}) {
    const auto piece = winding_link(beta);
    const ArcLength exact(place_curve(piece));
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
      const LengthSpline spline(piece, tolerance);
      EXPECT_NEAR(spline.length(), exact.length(), tolerance) << beta << ' ' << tolerance;
      double at_points = 0, between = 0;
      for (std::size_t i = 0; i < spline.parameters().size(); ++i)
        at_points = std::max(at_points, std::abs(spline.values()[i] - exact.at(spline.parameters()[i])));
      for (int j = 0; j <= 5000; ++j)
        between = std::max(between, std::abs(spline.at(j / 5000.0) - exact.at(j / 5000.0)));
      EXPECT_LE(at_points, tolerance);
      EXPECT_LE(between, 50 * tolerance);
      std::printf("[ length ] beta %g tolerance %g: %zu points, off by %.2g at them, %.2g between\n", beta, tolerance,
                  spline.parameters().size(), at_points, between);
    }
  }
}

TEST(LengthSpline, LinesAreExactAndArcsNearlySo) {
  const LengthSpline line(BezierPiece::line({1, 2, 3, 0, 0}, {4, 6, 3, 1, 1}), 1e-6);
  EXPECT_NEAR(line.length(), 5, 1e-14);
  EXPECT_NEAR(line.at(0.3), 1.5, 1e-14);
  EXPECT_LE(line.parameters().size(), 5u);
  const LengthSpline arc(spline_arc({10}, {}, {0, 0, 1}, std::numbers::pi / 2).front(), 1e-6);
  EXPECT_NEAR(arc.length(), 5 * std::numbers::pi, 1e-6);
}

TEST(LengthSpline, InverseFindsTheParameterAgain) {
  const LengthSpline spline(winding_link(1.5), 1e-6);
  for (int j = 0; j <= 1000; ++j) EXPECT_NEAR(spline.inverse(spline.at(j / 1000.0)), j / 1000.0, 1e-12);
  EXPECT_EQ(spline.at(-1), 0);
  EXPECT_EQ(spline.inverse(1e9), 1);
}

TEST(LengthSpline, RefusesATooSmallTolerance) {
  EXPECT_THROW(LengthSpline(BezierPiece::line({}, {1}), 0), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
