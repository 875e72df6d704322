#include "core/contour/dxf/read/drawn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<Drawn> samples() {
  return {DrawnLine{{1, 2, 3}, {4, -5, 6}}, DrawnArc{{1, 2, 0}, {3, 4, 0}, {-4, 3, 0}, 0.3, 2.5},
          DrawnArc{{1, 2, 5}, {3, 4, 1}, {-1, 3, 2}, 0.3, -5.5},
          drawn_spline(3, {{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 0}, {5, 1, 0}}, {1, 2, 1, 3, 1},
                       {0, 0, 0, 0, 1, 3, 3, 3, 3}),
          drawn_spline(2, {{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 0}}, {}, {0, 1, 2, 3, 4, 5, 6})};
}

double away(Vec a, Vec b) { return norm(a - b); }

TEST(Drawn, EndsAndDirectionsAgreeWithPoints) {
  for (const Drawn& d : samples()) {
    EXPECT_LT(away(first_point(d), point_at(d, 0)), 1e-14);
    EXPECT_LT(away(last_point(d), point_at(d, 1)), 1e-14);
    const double h = 1e-7;
    EXPECT_LT(angle_between(first_direction(d), point_at(d, h) - point_at(d, 0)), 1e-5);
    EXPECT_LT(angle_between(last_direction(d), point_at(d, 1) - point_at(d, 1 - h)), 1e-5);
    EXPECT_NEAR(norm(first_direction(d)), 1, 1e-14);
    double length = 0;
    for (int i = 0; i < 100; ++i) length += away(point_at(d, i * 0.01), point_at(d, (i + 1) * 0.01));
    EXPECT_GE(extent(d) * (1 + 1e-12), length);
  }
}

TEST(Drawn, ReversedIsTheSameCurve) {
  for (const Drawn& d : samples()) {
    const Drawn r = reversed(d);
    for (double u = 0; u <= 1; u += 0.125) EXPECT_LT(away(point_at(r, u), point_at(d, 1 - u)), 1e-13);
    EXPECT_LT(away(first_direction(r), -last_direction(d)), 1e-13);
    EXPECT_LT(away(last_direction(r), -first_direction(d)), 1e-13);
  }
}

TEST(Drawn, MapsCommuteWithPoints) {
  const Affine turn{{0, 2, 0}, {-3, 0, 0.5}, {0, 0.1, -1}, {10, 20, 30}};
  const Affine shear{{1, 0.5, 0}, {0, 1, 0}, {0.3, 0, 1}, {-1, 0, 0}};
  for (const Drawn& d : samples()) {
    const Drawn mapped_once = mapped(turn * shear, d);
    for (double u = 0; u <= 1; u += 0.125) {
      EXPECT_LT(away(point_at(mapped_once, u), turn.point(shear.point(point_at(d, u)))), 1e-12);
    }
    EXPECT_LT(angle_between(first_direction(mapped_once), turn.direction(shear.direction(first_direction(d)))), 1e-7);
  }
}

TEST(Drawn, AnEllipticArcIsExactlyARationalSpline) {
  for (const double sweep : {0.1, 1.5, -pi / 2, 3.0, -4.0, 2 * pi}) {
    const DrawnArc arc{{1, 2, 5}, {3, 4, 1}, {-1, 3, 2}, 0.7, sweep};
    const Drawn spline = drawn_spline(arc);
    EXPECT_LT(away(first_point(spline), arc.at(0.7)), 1e-14);
    EXPECT_LT(away(last_point(spline), arc.at(0.7 + sweep)), 1e-13);
    EXPECT_LT(angle_between(first_direction(spline), first_direction(arc)), 1e-14);
    // In the plane of a and b every point p has (p·a*)² + (p·b*)² = 1 with the dual basis.
    const Vec n = cross(arc.a, arc.b), dual_a = cross(arc.b, n) / dot(n, n), dual_b = cross(n, arc.a) / dot(n, n);
    for (double u = 0; u <= 1; u += 0.01) {
      const Vec p = point_at(spline, u) - arc.centre;
      EXPECT_NEAR(std::hypot(dot(p, dual_a), dot(p, dual_b)), 1, 1e-13);
      EXPECT_NEAR(dot(p, n), 0, 1e-12);
    }
  }
}

TEST(Drawn, CircularOnlyIfItIs) {
  EXPECT_TRUE((DrawnArc{{}, {3, 4, 0}, {4, -3, 0}, 0, 1}.circular()));
  EXPECT_FALSE((DrawnArc{{}, {3, 4, 0}, {4, -3.001, 0}, 0, 1}.circular()));
  EXPECT_FALSE((DrawnArc{{}, {5, 0, 0}, {3, 4, 0}, 0, 1}.circular()));
}

TEST(Drawn, RiseAndRange) {
  EXPECT_EQ(rise(DrawnLine{{0, 0, 2}, {1, 0, -1}}), 3);
  EXPECT_EQ(rise(DrawnArc{{0, 0, 7}, {1, 0, 0}, {0, 1, 0}, 0, 1}), 0);
  EXPECT_FALSE(within_range(DrawnLine{{0, 0, 0}, {2e9, 0, 0}}));
  EXPECT_FALSE(within_range(DrawnArc{{HUGE_VAL, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0, 1}));
  EXPECT_FALSE(within_range(DrawnLine{{0, 0, 0}, {std::nan(""), 0, 0}}));
  for (const Drawn& d : samples()) EXPECT_TRUE(within_range(d));
}

TEST(Drawn, SplinesAreChecked) { EXPECT_THROW(drawn_spline(3, {{0, 0, 0}, {1, 0, 0}}, {}, {0, 1}), InvalidInput); }

}  // namespace
}  // namespace bahnwerk
