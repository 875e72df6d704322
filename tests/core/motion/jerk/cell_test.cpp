#include "core/motion/jerk/cell.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

JerkNode& entry(JerkNode& l, JerkNode& r, std::size_t i) { return i < 2 ? l : r; }

TEST(JerkCell, PieceMeetsBothEnds) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double v1 = random.uniform(1, 100), T = random.uniform(0.001, 0.02), j = random.uniform(-1, 1) * v1 / (T * T);
    const double a1 = random.uniform(-0.2, 0.2) * v1 / T, a2 = a1 + 0.3 * j * T, v2 = v1 + 0.5 * (a1 + a2) * T;
    const double h = T * (v1 + v2) / 2 + T * T * (a1 - a2) / 12;
    const JerkNode l{v1 * v1, a1}, r{v2 * v2, a2};
    const LawPiece p = jerk_piece(l, r, h);
    const LawState end = p.at(p.duration);
    ASSERT_NEAR(p.duration, T, 1e-9 * T);
    ASSERT_NEAR(end.s, h, 1e-12 * h);
    ASSERT_NEAR(end.v, v2, 1e-10 * v2);
    ASSERT_NEAR(end.a, a2, 1e-8 * v1 / T);
    const JerkCell c = jerk_cell(l, r, h);
    ASSERT_NEAR(c.j1, p.j, 1e-9 * v1 / (T * T));
    ASSERT_NEAR(c.j2, end.j, 1e-9 * v1 / (T * T));
  }
}

TEST(JerkCell, GradientsAreDerivatives) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const double h = random.uniform(0.1, 2);
    JerkNode l{random.uniform(50, 100), random.uniform(-5, 5)}, r{random.uniform(50, 100), random.uniform(-5, 5)};
    const JerkCell c = jerk_cell(l, r, h);
    for (std::size_t k = 0; k < 4; ++k) {
      JerkNode& node = entry(l, r, k);
      double& x = k % 2 ? node.a : node.b;
      const double x0 = x, d = 1e-5;
      x = x0 + d;
      const JerkCell up = jerk_cell(l, r, h);
      x = x0 - d;
      const JerkCell down = jerk_cell(l, r, h);
      x = x0;
      ASSERT_NEAR((up.T - down.T) / (2 * d), c.dT[k], 1e-7 * (std::abs(c.dT[k]) + c.T));
      ASSERT_NEAR((up.j1 - down.j1) / (2 * d), c.dj1[k], 1e-6 * (1 + std::abs(c.dj1[k])));
      ASSERT_NEAR((up.j2 - down.j2) / (2 * d), c.dj2[k], 1e-6 * (1 + std::abs(c.dj2[k])));
    }
  }
}

TEST(JerkCell, JerkIsConstantFromRest) {
  const double b = 9, h = 2, d = 1e-5;
  const LawPiece up = jerk_piece({}, {b, rest_tie(h) * b}, h), down = jerk_piece({b, -rest_tie(h) * b}, {}, h);
  EXPECT_EQ(up.snap, 0);
  EXPECT_NEAR(up.at(up.duration).s, h, 1e-14);
  EXPECT_NEAR(up.at(up.duration).v, 3, 1e-14);
  EXPECT_NEAR(up.at(up.duration).a, rest_tie(h) * b, 1e-14);
  EXPECT_NEAR(down.at(down.duration).s, h, 1e-14);
  EXPECT_NEAR(down.at(down.duration).v, 0, 1e-14);
  EXPECT_NEAR(down.at(down.duration).a, 0, 1e-14);
  for (const std::size_t moving : {std::size_t{0}, std::size_t{1}}) {
    const JerkCell c = rest_cell(b, h, moving), more = rest_cell(b + d, h, moving), less = rest_cell(b - d, h, moving);
    EXPECT_NEAR(c.j1, up.j, 1e-14);
    EXPECT_NEAR((more.T - less.T) / (2 * d), c.dT[2 * moving], 1e-9);
    EXPECT_NEAR((more.j2 - less.j2) / (2 * d), c.dj2[2 * moving], 1e-9);
  }
}

}  // namespace
}  // namespace bahnwerk
