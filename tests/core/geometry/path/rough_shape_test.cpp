// Equal for what is only moved, other for what is not.
#include "core/geometry/path/rough_shape.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

Path bow(Vec at, double radius, double sweep) {
  Path path;
  const Vec corner = at + Vec{5, 0, 0};
  path.append(std::make_shared<Line>(at, corner), 0);
  path.append(std::make_shared<Arc>(corner + Vec{0, radius, 0}, Vec{0, -1, 0}, Vec{1, 0, 0}, radius, sweep), 1);
  return path;
}

TEST(RoughShape, IsThatOfMovedCopies) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const std::uint64_t shape = rough_shape(bow({}, 2.5, 1.3), 0, 2);
  int other = 0;
  for (int i = 0; i < 10000; ++i)
    other += rough_shape(bow({1000 * uniform(random), 1000 * uniform(random), 0}, 2.5, 1.3), 0, 2) != shape;
  EXPECT_LE(other, 10);
}

TEST(RoughShape, IsAnotherOfOtherCurves) {
  const std::uint64_t shape = rough_shape(bow({}, 2.5, 1.3), 0, 2);
  EXPECT_NE(rough_shape(bow({}, 2.5, 1.4), 0, 2), shape);
  EXPECT_NE(rough_shape(bow({}, 2.5, -1.3), 0, 2), shape);
  EXPECT_NE(rough_shape(bow({}, 2.6, 1.3), 0, 2), shape);
  EXPECT_NE(rough_shape(bow({}, 2.5, 1.3), 0, 1), shape);
}

TEST(RoughShape, LengthsNextToAPowerOfTwoAreAlike) {
  const auto of = [](double length) {
    Path path;
    path.append(std::make_shared<Line>(Vec{}, Vec{length, 0, 0}), 0);
    return rough_shape(path, 0, 1);
  };
  for (const double power : {0.25, 1.0, 8.0}) {
    EXPECT_EQ(of(power * (1 - 1e-15)), of(power));
    EXPECT_EQ(of(power * (1 + 1e-15)), of(power));
    EXPECT_NE(of(power * (1 - 1e-5)), of(power));
  }
}

TEST(RoughIndex, KeepsTheLatest) {
  RoughIndex index;
  EXPECT_TRUE(index.of(7).empty());
  for (std::size_t i = 0; i < 10; ++i) index.add(7, i);
  index.add(8, 99);
  ASSERT_FALSE(index.of(7).empty());
  EXPECT_EQ(index.of(7)[0], 9u);
  EXPECT_EQ(index.of(7)[1], 8u);
  EXPECT_LE(index.of(7).size(), 8u);
  EXPECT_EQ(index.of(8).size(), 1u);
}

}  // namespace
}  // namespace bahnwerk
