#include "core/winding/fill.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/numeric/random.hpp"

namespace bahnwerk::winding {
namespace {

TEST(Fill, FactorsAreAreasOfCircles) {
  const Wire wire{0.9, 0.989, 0.03};
  EXPECT_NEAR(electrical_fill(82, wire, 83.0), 82 * std::numbers::pi * 0.45 * 0.45 / 83.0, 1e-15);
  EXPECT_NEAR(mechanical_fill(82, wire, 73.2), 82 * std::numbers::pi * 0.4945 * 0.4945 / 73.2, 1e-15);
}

TEST(Fill, SharedAreaEqualsACountOfCells) {
  for (const double d : {0.1, 0.7, 1.5, 1.9, 1.99}) {
    const int n = 2000;
    double inside = 0;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const double x = -1 + 3.0 * (i + 0.5) / n, y = -1 + 2.0 * (k + 0.5) / n;
        inside += x * x + y * y < 1 && (x - d) * (x - d) + y * y < 1;
      }
    EXPECT_NEAR(shared_area(1, d), inside * 3.0 / n * 2.0 / n, 1e-4) << d;
  }
  EXPECT_EQ(shared_area(1, 2), 0);
  EXPECT_NEAR(shared_area(1, 0), std::numbers::pi, 1e-12);
}

TEST(Fill, OverlapsEqualASumOverAllPairs) {
  Random random(4);
  for (int k = 0; k < 20; ++k) {
    std::vector<Point> wires;
    for (int i = 0; i < 60; ++i) wires.push_back({random.uniform(0, 10), random.uniform(0, 10)});
    double deepest = 0, area = 0;
    for (std::size_t i = 0; i < wires.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        deepest = std::max(deepest, 1.2 - distance(wires[i], wires[j]));
        area += shared_area(0.6, distance(wires[i], wires[j]));
      }
    const Overlaps found = overlaps(wires, 0.6);
    EXPECT_NEAR(found.deepest, deepest, 1e-12);
    EXPECT_NEAR(found.area, area, 1e-12);
  }
}

TEST(Fill, TurnsTakeWholeMultiples) {
  const Turns free = turns(83, std::nullopt, 4);
  EXPECT_EQ(free.serial, 20u);
  EXPECT_EQ(free.wires, 80u);
  EXPECT_NEAR(free.loss, 3.0 / 83, 1e-15);
  const Turns strands = turns(83, 10, std::nullopt);
  EXPECT_EQ(strands.parallel, 8u);
  EXPECT_EQ(strands.wires, 80u);
  const Turns both = turns(83, 10, 8);
  EXPECT_EQ(both.wires, 80u);
  EXPECT_EQ(turns(83, 12, 7).wires, 0u) << "84 do not fit";
  EXPECT_FALSE(turns(83, 12, 7).fits);
  EXPECT_EQ(turns(83, 12, 7).loss, 0) << "nothing is laid that could be lost";
  EXPECT_FALSE(turns(3, std::nullopt, 4).fits) << "less than a turn";
  EXPECT_TRUE(both.fits);
  EXPECT_EQ(turns(0, std::nullopt, std::nullopt).wires, 0u);
  EXPECT_EQ(turns(83, std::nullopt, std::nullopt).wires, 83u);
}

TEST(Fill, ResistanceOfCopper) {
  const Wire wire{2 / std::sqrt(std::numbers::pi), 1.2, 0};  // 1 mm²
  EXPECT_NEAR(resistance_per_metre(wire, 1, 20), 1 / 58.0, 1e-15);
  EXPECT_NEAR(resistance_per_metre(wire, 2, 120), 1.393 / 116, 1e-15);
}

}  // namespace
}  // namespace bahnwerk::winding
