#include "core/motion/setpoints/path_setpoints.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

TEST(PathSetpoints, PlaceAndSpeedOfTheToolFollowTheAxesAndTheLastRowIsTheEnd) {
  Path path;
  path.append(std::make_shared<const Line>(Vec{0, 0, 0}, Vec{3, 4, 0}), 0);
  TimeLaw law;  // 5 mm with 20 mm/s² up and down
  law.append({0, 0.5, 0, 2.5, 0, 20, 0, 0, 0});
  law.append({0, 0.5, 2.5, 5, 10, -20, 0, 0, 0});
  const auto motion = std::make_shared<const PathMotion>(std::make_shared<const CartesianAxisPath>(path, 2), law);
  const PathSetpoints rows(motion, {{AxisLimits("x", 99), AxisLimits("y", 99)}, 0.125}, 8);
  ASSERT_EQ(rows.columns().size(), 8u);
  EXPECT_EQ(rows.columns()[6].name, "s");
  EXPECT_EQ(rows.columns()[7].name, "v");
  std::vector<double> all(9 * 8);
  rows.read(0, 9, all.data());
  for (std::size_t k = 0; k <= 8; ++k) {
    const double t = 0.125 * static_cast<double>(k), left = 1 - t;
    const double s = t < 0.5 ? 10 * t * t : 5 - 10 * left * left, v = t < 0.5 ? 20 * t : 20 * left;
    const double* row = &all[8 * k];
    EXPECT_NEAR(row[6], s, 1e-14) << k;
    EXPECT_NEAR(row[7], v, 1e-14) << k;
    EXPECT_NEAR(row[0], 0.6 * s, 1e-14) << k;
    EXPECT_NEAR(row[3], 0.8 * v, 1e-14) << k;
    EXPECT_NEAR(row[4], k == 8 ? 0 : t < 0.5 ? 12 : -12, 1e-12) << k;
  }
  EXPECT_EQ(all[8 * 8 + 6], path.length());
  EXPECT_EQ(all[8 * 8 + 7], 0);
}

}  // namespace
}  // namespace bahnwerk
