#include "core/verify/bound/bound_node.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::verify {
namespace {

TEST(BoundNode, SquaresAreBoundedOnBothSidesOfRounding) {
  BoundNode<2> node;
  node.tangent = {-0.6, 1e-9};
  node.rounding_error = 1e-6;
  EXPECT_LT(node.least(0), 0.36);
  EXPECT_GT(node.most(0), 0.36);
  EXPECT_NEAR(node.least(0), 0.36 - 1.2e-6, 1e-11);
  EXPECT_NEAR(node.most(0), 0.36 + 1.2e-6, 1e-11);
  EXPECT_EQ(node.least(1), 0);  // it may be 0
  EXPECT_GT(node.most(1), 1e-12);
}

TEST(BoundNode, DirectionsHaveAsManyCoordinatesAsAxes) {
  EXPECT_EQ(direction(std::array<double, 2>{3, 4}), (Vec{3, 4, 0}));
  EXPECT_EQ(direction(std::array<double, 3>{3, 4, 12}), (Vec{3, 4, 12}));
  EXPECT_EQ(length_of(std::array<double, 3>{3, 4, 12}), 13);
}

TEST(BoundNode, LengthsAreLessCertainFartherAlongThePath) {
  EXPECT_GT(rounding_of(0), 0);
  EXPECT_GT(rounding_of(1e6), 1e5 * rounding_of(0));
}

}  // namespace
}  // namespace bahnwerk::verify
