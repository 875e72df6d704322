#include "core/cam/optimal/task/extrema.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk::cam {
namespace {

/// Two extrema within a hundredth of each other count, and the values at ends that are next to nothing.
TEST(Extrema, LargestExtremumIsTheEnclosedMaximum) {
  Random random(11);
  std::vector<Extremum> extrema;
  for (int k = 0; k < 3000; ++k) {
    std::vector<double> b(2 + random.below(20));
    for (double& value : b) value = random.uniform(-1, 1) * (random.chance(0.1) ? 1e-38 : 1);
    find_extrema(b, extrema);
    double high = -2, size = 0;
    for (const Extremum& each : extrema) {
      high = std::max(high, each.value);
      size = std::max(size, std::abs(each.value));
      EXPECT_NEAR(each.value, evaluate_bernstein(b, each.at), 1e-14);
    }
    EXPECT_NEAR(high, greatest_value(b).value, 1e-12);
    EXPECT_NEAR(size, greatest_magnitude(b).value, 1e-12);
    EXPECT_GE(greatest_value(b).value, high - 1e-14);
  }
}

TEST(Extrema, CloseExtremaAreBothFound) {
  // slope (x − 0.02)(x − 0.03)(x − 0.95)
  const double a = 0.02, c = 0.03, d = 0.95;
  const std::vector<double> power{-a * c * d, a * c + a * d + c * d, -(a + c + d), 1};
  std::vector<double> b(5, 0);  // of the integral, degree 4: b_i = Σ_j C(i,j)/C(4,j) p_j
  const std::vector<double> integral{0, power[0], power[1] / 2, power[2] / 3, power[3] / 4};
  const double choose[5][5] = {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j <= i; ++j) b[i] += choose[i][j] / choose[4][j] * integral[j];
  std::vector<Extremum> extrema;
  find_extrema(b, extrema);
  ASSERT_EQ(extrema.size(), 5u);
  EXPECT_NEAR(extrema[1].at, a, 1e-9);
  EXPECT_NEAR(extrema[2].at, c, 1e-9);
  EXPECT_NEAR(extrema[3].at, d, 1e-9);
}

}  // namespace
}  // namespace bahnwerk::cam
