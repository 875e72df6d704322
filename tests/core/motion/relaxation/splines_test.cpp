// Quadratic B-splines over uneven nodes: what makes them test functions.
#include "core/motion/relaxation/splines.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

constexpr double nodes[] = {0, 0.3, 1.7, 1.9, 2.6, 4.1, 4.2};

std::array<SplinePart, 3> parts(std::size_t i) {
  return spline_parts(nodes[i] - nodes[i - 1], nodes[i + 1] - nodes[i], nodes[i + 2] - nodes[i + 1]);
}

TEST(Splines, SumToOneAndAreNotNegative) {
  for (std::size_t i = 1; i < 5; ++i) {
    const double h = nodes[i + 1] - nodes[i];
    double integral = 0;
    for (const SplinePart& p : parts(i)) integral += p.integral(h);
    EXPECT_NEAR(integral, h, 1e-15);
    for (double x = 0; x <= h; x += h / 16) {
      double sum = 0, slope = 0, second = 0;
      for (const SplinePart& p : parts(i)) {
        EXPECT_GE(p.at(x), -1e-15);
        sum += p.at(x), slope += p.slope(x), second += p.second;
      }
      EXPECT_NEAR(sum, 1, 1e-14);
      EXPECT_NEAR(slope, 0, 1e-13);
      EXPECT_NEAR(second, 0, 1e-13);
    }
  }
}

TEST(Splines, AreContinuouslyDifferentiable) {
  for (std::size_t i = 1; i < 4; ++i) {
    const auto left = parts(i), right = parts(i + 1);
    const double h = nodes[i + 1] - nodes[i];
    for (std::size_t r = 0; r < 3; ++r) {  // place r on the right cell is place r + 1 on the left one
      const double value = r < 2 ? left[r + 1].at(h) : 0, slope = r < 2 ? left[r + 1].slope(h) : 0;
      EXPECT_NEAR(right[r].at(0), value, 1e-14);
      EXPECT_NEAR(right[r].slope(0), slope, 1e-13);
    }
    EXPECT_NEAR(left[0].at(h), 0, 1e-15);
    EXPECT_NEAR(left[0].slope(h), 0, 1e-13);
  }
}

}  // namespace
}  // namespace bahnwerk
