#include "core/geometry/curve/line.hpp"

#include "tests/core/geometry/support.hpp"

namespace bahnwerk {
namespace {

TEST(Line, EndsAreExactAndDerivativesConstant) {
  const Line line({0.1, 0.2, 0.3}, {1e4 + 0.7, -3.3, 12.1});
  EXPECT_EQ(line.at(0).value, line.from());
  EXPECT_EQ(line.at(1).value, line.to());
  EXPECT_EQ(line.at(0.3).d1, line.to() - line.from());
  EXPECT_EQ(line.at(0.3).d2, Vec{});
  EXPECT_EQ(line.speed(0.7), norm(line.to() - line.from()));
  testing::expect_near(line.at(0.25).value, line.from() + 0.25 * (line.to() - line.from()), 1e-11);
}

}  // namespace
}  // namespace bahnwerk
