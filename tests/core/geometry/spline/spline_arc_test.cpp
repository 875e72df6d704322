#include "core/geometry/spline/spline_arc.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

TEST(SplineArc, LiesOnTheCircle) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const auto from = testing::random_pose(random);
    const Vec centre{random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)};
    const Vec normal{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Vec n = normal / norm(normal), r = place(from) - centre - dot(place(from) - centre, n) * n;
    const double sweep = random.uniform(-2 * pi, 2 * pi), radius = norm(r);
    const SplinePoint change{0, 0, random.chance(0.5) ? 5.0 : 0.0, random.chance(0.5) ? 1.5 : 0.0, 0};
    const auto pieces = spline_arc(from, centre, normal, sweep, change, 1 + random.below(4));
    EXPECT_EQ(pieces.size(), static_cast<std::size_t>(std::ceil(std::abs(sweep) / (pi / 2))));
    for (const auto& piece : pieces)
      for (int j = 0; j <= 16; ++j) {
        const Vec q = place(piece.at(j / 16.0)[0]) - centre;
        EXPECT_NEAR(norm(q - dot(q, n) * n), radius, 1e-12 * 200) << i;
        if (change[2] == 0) {
          EXPECT_NEAR(dot(q, n), dot(place(from) - centre, n), 1e-12 * 200);
        }
      }
    const auto end = pieces.back().at(1)[0];
    const Vec expected =
        centre + dot(place(from) - centre, n) * n + change[2] * n + std::cos(sweep) * r + std::sin(sweep) * cross(n, r);
    EXPECT_LE(norm(place(end) - expected), 1e-12 * 200);
    EXPECT_NEAR(end[3], from[3] + change[3], 1e-13 * 10);
  }
}

// The angle's distance from linear over a quarter turn, relative to its change: the figures in the header.
TEST(SplineArc, AnglesFollowTheTurn) {
  const double limits[] = {0, 1.3e-3, 5e-5, 3e-6, 2e-7};
  for (std::size_t k = 1; k <= 4; ++k) {
    const auto piece = spline_arc({10, 0, 0, 0, 0}, {}, {0, 0, 1}, pi / 2, {0, 0, 0, 1, -2}, k).front();
    double worst = 0;
    for (int j = 0; j <= 1000; ++j) {
      const auto p = piece.at(j / 1000.0)[0];
      const double turn = std::atan2(p[1], p[0]) / (pi / 2);
      worst = std::max(worst, std::abs(p[3] - turn));
      EXPECT_NEAR(p[4], -2 * p[3], 1e-13);
    }
    EXPECT_LE(worst, limits[k]) << k;
    EXPECT_GE(worst, limits[k] / 10) << k;
  }
}

TEST(SplineArc, PiecesJoinWithTheirContinuityInAllCoordinates) {
  for (std::size_t k = 1; k <= 4; ++k) {
    const auto pieces = spline_arc({40, 5, -31, 0.3, 0}, {1, 2, 0}, {0, 0, -1}, 1.7 * pi, {0, 0, 12, 5.3, 1}, k);
    const auto peak = testing::peaks(pieces);
    ASSERT_EQ(pieces.size(), 4u);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
      for (std::size_t n = 0; n <= k; ++n)
        EXPECT_LE(testing::jump(pieces[i], pieces[i + 1], n, peak[n]), 1e-11) << k << ' ' << n;
  }
}

TEST(SplineArc, RefusesWhatIsNoArc) {
  EXPECT_THROW(spline_arc({1}, {}, {}, 1), std::invalid_argument);
  EXPECT_THROW(spline_arc({1}, {}, {0, 0, 1}, 0), std::invalid_argument);
  EXPECT_THROW(spline_arc({0, 0, 7}, {}, {0, 0, 1}, 1), std::invalid_argument);
  EXPECT_THROW(spline_arc({1}, {}, {0, 0, 1}, 1, {}, 5), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
