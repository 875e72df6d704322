// The packings that the literature knows: the table, and what the search makes of them.
#include "tests/core/winding/layout/best_known.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/winding/layout/potential.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;
using std::numbers::pi;

struct Instance {
  std::string name;
  Region usable_area;
  std::size_t count;
  double radius;
};
std::vector<Instance> known_packings() {
  std::vector<Instance> list;
  for (int n = 5; n <= 60; ++n) {
    list.push_back({"square", square(), static_cast<std::size_t>(n), testing::square_radius[n - 5]});
    list.push_back({"circle", circle(), static_cast<std::size_t>(n), 1 / testing::circle_ratio[n - 5]});
  }
  for (const auto& [n, d] : testing::triangle_distance)
    list.push_back({"triangle", triangle(), static_cast<std::size_t>(n), 1 / (2 / d + 2 * std::sqrt(3.0))});
  return list;
}

TEST(BestKnown, AgreesWithClosedForms) {
  const auto in_square = [](int n) { return testing::square_radius[n - 5]; };
  const auto in_circle = [](int n) { return testing::circle_ratio[n - 5]; };
  EXPECT_NEAR(in_square(5), (std::sqrt(2.0) - 1) / 2, 1e-13);
  // Least distances m of points in a unit square: r = m / (2 (1 + m)).
  EXPECT_NEAR(in_square(6), std::sqrt(13.0) / 6 / (2 + std::sqrt(13.0) / 3), 1e-13);
  EXPECT_NEAR(in_square(7), 1 / (4 + std::sqrt(3.0)), 1e-13);
  EXPECT_NEAR(in_square(8), 1 / (2 + std::sqrt(2.0) + std::sqrt(6.0)), 1e-13);
  for (int k = 3; k <= 6; ++k) EXPECT_NEAR(in_square(k * k), 0.5 / k, 1e-13);
  EXPECT_NEAR(in_square(12), 1 / (2 + 30 / std::sqrt(34.0)), 1e-13);
  EXPECT_NEAR(in_square(14), 1 / (6 + std::sqrt(3.0)), 1e-13);
  EXPECT_NEAR(in_circle(5), 1 + std::sqrt(2 * (1 + 1 / std::sqrt(5.0))), 1e-12);
  EXPECT_NEAR(in_circle(6), 3, 1e-12);
  EXPECT_NEAR(in_circle(7), 3, 1e-12);
  EXPECT_NEAR(in_circle(8), 1 + 1 / std::sin(pi / 7), 1e-12);
  EXPECT_NEAR(in_circle(9), 1 + std::sqrt(2 * (2 + std::sqrt(2.0))), 1e-12);
  EXPECT_NEAR(in_circle(11), 1 + 1 / std::sin(pi / 9), 1e-12);
  EXPECT_NEAR(in_circle(13), 2 + std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(in_circle(19), 1 + std::sqrt(2.0) + std::sqrt(6.0), 1e-12);
  for (const auto& [n, d] : testing::triangle_distance) {
    for (int k = 2; k <= 11; ++k) {
      double closed = d;
      if (n == k * (k + 1) / 2 || n == k * (k + 1) / 2 - 1) closed = 1.0 / (k - 1);
      if (n == 2 * k * (k + 1)) closed = 1 / (2 * k - 2 + std::sqrt(3.0));
      if (n == (k + 1) * (k + 2) + k * (k + 1) - 1) closed = 1 / (2 * k - 1 + std::sqrt(3.0));
      EXPECT_NEAR(d, closed, 1e-14) << n;
    }
  }
}

TEST(BestKnown, MoreWiresAreNotLarger) {
  for (std::size_t i = 1; i < testing::square_radius.size(); ++i) {
    EXPECT_LE(testing::square_radius[i], testing::square_radius[i - 1]);
    EXPECT_GE(testing::circle_ratio[i], testing::circle_ratio[i - 1]);
  }
  for (std::size_t i = 1; i < testing::triangle_distance.size(); ++i)
    EXPECT_LE(testing::triangle_distance[i].second, testing::triangle_distance[i - 1].second);
}

TEST(Pack, FindsBestKnownPackings) {
  const std::vector<Instance> all = known_packings();
  std::size_t found = 0;
  std::string missed;
  for (const Instance& it : all) {
    const double radius = it.radius * (1 - 0.002);
    PotentialOptions options;
    options.effort = 2;
    const auto wires = pack(it.usable_area, radius, it.count, {}, options, silent);
    if (!wires) {
      missed += " " + it.name + " " + std::to_string(it.count);
      continue;
    }
    ++found;
    ASSERT_EQ(wires->size(), it.count);
    ASSERT_TRUE(packed(it.usable_area, radius, 0, *wires)) << it.name << it.count;
  }
  EXPECT_GE(all.size(), 150u);
  EXPECT_GE(static_cast<double>(found), 0.95 * static_cast<double>(all.size())) << "missed:" << missed;
}

TEST(Pack, FindsNothingLargerThanBestKnown) {
  // Either of the two would be wrong: the table, or the check of what was found. All of them in a long run.
  const std::vector<Instance> all = known_packings();
  const std::size_t step = bahnwerk::testing::case_factor() >= 5 ? 1 : 5;
  for (std::size_t i = 0; i < all.size(); i += step) {
    PotentialOptions options;
    options.effort = step == 1 ? 1 : 0.02;
    EXPECT_FALSE(pack(all[i].usable_area, all[i].radius * (1 + 1e-6), all[i].count, {}, options, silent))
        << all[i].name << all[i].count;
  }
}

TEST(Pack, CircleOfArcsAndOfChordsAgree) {
  // The polygon with 180 sides around the circle is wider by at most 1.5e-4 at its corners.
  for (const int n : {7, 19, 30}) {
    const double radius = 0.998 / testing::circle_ratio[n - 5];
    const auto wires = pack(gon(180), radius, static_cast<std::size_t>(n), {}, {}, silent);
    ASSERT_TRUE(wires) << n;
    expect_allowed(gon(180), radius, 0, *wires);
  }
}

// Small and odd usable areas.

}  // namespace
}  // namespace bahnwerk::winding
