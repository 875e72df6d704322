#include "core/motion/acceleration/cell_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(CellLaw, CoversTheCellAndEndsAtItsSpeeds) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const double h = std::pow(10, random.uniform(-3, 1)), v1 = random.uniform(1, 100), v2 = v1 * random.uniform(0.5, 2),
                 b1 = v1 * v1, b2 = v2 * v2, g = b1 + (b2 - b1) * random.uniform(0.3, 0.7);
    const CellLaw law = cell_law(b1, v1, g, v2, h);
    const LawState begin = law.at(0), end = law.at(law.duration);
    EXPECT_EQ(begin.s, 0);
    EXPECT_EQ(begin.v, v1);
    EXPECT_NEAR(begin.a, (g - b1) / h, 1e-12 * b1 / h);
    EXPECT_NEAR(end.s, h, 1e-12 * h);
    EXPECT_NEAR(end.v, v2, 1e-11 * v2);
    EXPECT_EQ(end.j, law.j);
  }
}

TEST(CellLaw, HalfTheRiseIsConstantAcceleration) {
  // g halfway between b1 and b2: v² is linear in s.
  const CellLaw law = cell_law(9, 3, 17, 5, 2);
  EXPECT_DOUBLE_EQ(law.duration, 0.5);
  EXPECT_DOUBLE_EQ(law.a, 4);
  EXPECT_NEAR(law.j, 0, 1e-12);
}

TEST(CellLaw, FromRestAndToRest) {
  const CellLaw start = cell_law(0, 0, 8, 4, 2);  // a = 4: constant, 1 s
  EXPECT_NEAR(start.at(start.duration).s, 2, 1e-14);
  EXPECT_NEAR(start.at(start.duration).v, 4, 1e-14);
  const CellLaw stop = cell_law(16, 4, 8, 0, 2);
  EXPECT_NEAR(stop.at(stop.duration).s, 2, 1e-12);
  EXPECT_NEAR(stop.at(stop.duration).v, 0, 1e-12);
  EXPECT_NEAR(stop.a, -4, 1e-12);
}

TEST(CellLaw, PeaksOfSamplesLieBetweenThem) {
  // A parabola with its vertex between two of five samples.
  std::array<double, 5> f{};
  for (std::size_t i = 0; i < 5; ++i) f[i] = 1 - 0.4 * std::pow(static_cast<double>(i) / 4 - 0.4, 2);
  EXPECT_NEAR(cell_law_detail::peak(f), 1, 1e-3);
  EXPECT_GE(cell_law_detail::peak(f), *std::max_element(f.begin(), f.end()));
  EXPECT_DOUBLE_EQ(cell_law_detail::peak({0.1, -0.5, 0.2, 0.3, 0.1}), 0.5) << "far below the limit: the largest sample";
}

}  // namespace
}  // namespace bahnwerk
