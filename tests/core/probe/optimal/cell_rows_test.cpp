#include "core/probe/optimal/cell_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace bahnwerk {
namespace {

TEST(CellRows, OffsetsAreFromTheNearestPointOfTheSegment) {
  const Capsule<2> c = capsule<2>({1, 1}, {4, 5}, 0.5);
  EXPECT_DOUBLE_EQ(c.length, 5);
  EXPECT_DOUBLE_EQ(c.radius2, 0.25);
  bool cap = false;
  const double beside[] = {2.5 - 0.8, 3 + 0.6}, before[] = {1 - 3, 1 - 4}, behind[] = {4, 7};
  std::array<double, 2> d = offset(c, beside, cap);
  EXPECT_FALSE(cap);
  EXPECT_NEAR(d[0], -0.8, 1e-14);
  EXPECT_NEAR(d[1], 0.6, 1e-14);
  d = offset(c, before, cap);
  EXPECT_TRUE(cap);
  EXPECT_NEAR(std::hypot(d[0], d[1]), 5, 1e-14);
  d = offset(c, behind, cap);
  EXPECT_TRUE(cap);
  EXPECT_DOUBLE_EQ(d[1], 2);
  const Capsule<2> point = capsule<2>({1, 1}, {1, 1}, 0.5);
  d = offset(point, beside, cap);
  EXPECT_TRUE(cap);
  EXPECT_DOUBLE_EQ(d[0], 0.7);
}

/// A quartic has one in a cell of four: Bézier points of its pieces are those of the polynomial cut at quarters.
TEST(CellRows, AQuarticIsReproducedWithItsDerivatives) {
  const double base = 1e5, h = 1.6;
  const auto x = [](double t) {
    return std::array<double, 5>{3 + t * (2 - t * (1 - t * (0.5 - t))), 2 - t * (2 - t * (1.5 - 4 * t)),
                                 -2 + t * (3 - 12 * t), 3 - 24 * t, -24};
  };
  ChainNode<1> a, b;
  for (std::size_t p = 0; p < 4; ++p)
    a.state[p][0] = x(0)[p] + (p == 0 ? base : 0), b.state[p][0] = x(h)[p] + (p == 0 ? base : 0);
  CellValues<1> v;
  evaluate_cell(a, b, h, v);
  for (std::size_t piece = 0; piece < CellBasis::pieces; ++piece) {
    const double t = h * static_cast<double>(piece) / 4;
    for (std::size_t order = 0; order < 4; ++order)
      EXPECT_NEAR(v.q[CellBasis::first[order] + (4 - order) * piece][0] - (order == 0 ? base : 0), x(t)[order], 1e-9)
          << piece << ' ' << order;
    EXPECT_NEAR(v.q[CellBasis::first[4] + piece][0], -24, 1e-9) << piece;
    // The second point of a piece lies on the tangent at its begin.
    EXPECT_NEAR(v.q[4 * piece + 1][0] - base, x(t)[0] + h / 16 * x(t)[1], 1e-10) << piece;
  }
  EXPECT_NEAR(v.q[16][0] - base, x(h)[0], 1e-10);
  EXPECT_DOUBLE_EQ(v.power[3], 1 / (h * h * h));
}

}  // namespace
}  // namespace bahnwerk
