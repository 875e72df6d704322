#include "core/probe/optimal/point_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

std::vector<Vec> arc(int n, double noise) {
  std::vector<Vec> points;
  Random random(7);
  for (int i = 0; i < n; ++i) {
    const double angle = 1.5 * i / (n - 1), e = i > 0 && i + 1 < n ? noise : 0, way = 2 * M_PI * random.uniform();
    points.push_back({3 * std::cos(angle) + e * std::cos(way), 3 * std::sin(angle) + e * std::sin(way), 0});
  }
  return points;
}

std::vector<double> lengths(std::size_t n) {
  std::vector<double> along;
  for (std::size_t i = 0; i < n; ++i) along.push_back(4.5 * static_cast<double>(i) / static_cast<double>(n - 1));
  return along;
}

TEST(PointFit, PointsOfASmoothCurveAreMet) {
  const std::vector<Vec> points = arc(201, 0);
  const PointFit fit = fit_points(points, lengths(201), 1e-6, lengths(21), true, true);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(norm(fit.off[i]), 1e-6) << i;
    EXPECT_LT(norm(points[i] - fit.at[i] - fit.off[i]), 1e-4) << i;
  }
  EXPECT_EQ(fit.at.front(), points.front());
  EXPECT_EQ(fit.at.back(), points.back());
}

TEST(PointFit, TheLargestDistanceIsHardlyMoreThanThatOfTheCurveWithoutNoise) {
  const PointFit fit = fit_points(arc(401, 1e-3), lengths(401), 1e-3, {0, 1, 2, 3, 4.5}, true, true);
  for (std::size_t i = 0; i < fit.at.size(); ++i) {
    EXPECT_LT(norm(fit.off[i]), 1.02e-3) << i;
    EXPECT_NEAR(norm(fit.at[i]), 3, 4e-4) << i;
  }
}

}  // namespace
}  // namespace bahnwerk
