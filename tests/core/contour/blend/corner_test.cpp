#include "core/contour/blend/corner.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/polyline.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/curvature.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

std::vector<ElementRun> corner(double turn) {
  static Contour kept;
  kept = polyline(2, {{}, {10, 0, 0}, {10 + 10 * std::cos(turn), 10 * std::sin(turn), 0}}, false, 1);
  return element_runs(kept.path, 0, 2, {0, 0}, {1e-6, 3}, silent_scope());
}

TEST(BlendCorner, ReachBetweenLinesIsExact) {
  for (const double turn : {0.05, 0.5, 1.5, 2.7}) {
    const auto s = corner(turn);
    const Element &a = s[0].elements[0], &b = s[0].elements[1];
    const Reach r = reach(joint_shape(a, b), 0.01, {1800, 16000, HUGE_VAL, 0});
    EXPECT_LE(r.wanted, r.allowed);
    const Rational curve = corner_curve(a, r.allowed, b, r.allowed);
    const CornerFit fit = corner_fit(curve, a, r.allowed, b, r.allowed, 0.01);
    EXPECT_NEAR(fit.deviation, 0.01, 1e-9) << turn;
    EXPECT_EQ(fit.joint, 0.5);
    EXPECT_NEAR(norm(curve.at(0.5).value - Vec{10, 0, 0}), 0.01, 1e-9) << turn;
  }
}

TEST(BlendCorner, ThreeDerivativesInCommon) {
  Contour c;
  c.path.append(std::make_shared<Arc>(Arc({0, 5, 0}, {0, -1, 0}, {1, 0, 0}, 5, 1.2)), 0);
  const Vec end = c.path[0].curve().at(1).value;
  c.path.append(std::make_shared<Arc>(Arc(end - Vec{8, 0, 0}, {1, 0, 0}, {0, -1, 0}, 8, 0.7)), 0);
  const auto s = element_runs(c.path, 0, 2, {0, 0}, {1e-6, 3}, silent_scope());
  const Element &a = s[0].elements[0], &b = s[0].elements[1];
  const Rational curve = corner_curve(a, 0.4, b, 0.3);
  const Jet begin = by_arc_length(curve.at(0)), finish = by_arc_length(curve.at(1));
  const Jet left = a.at(a.length - 0.4), right = b.at(0.3);
  for (const auto& [x, y] : {std::pair{begin, left}, std::pair{finish, right}}) {
    EXPECT_LE(norm(x.value - y.value), 1e-12);
    EXPECT_LE(norm(x.d1 - y.d1), 1e-11);
    EXPECT_LE(norm(x.d2 - y.d2), 1e-9);
    EXPECT_LE(norm(x.d3 - y.d3), 1e-7);
  }
}

TEST(BlendCorner, CurvatureJumpStaysWithinItsEstimate) {
  Contour c = polyline(2, {{}, {20, 0, 0}}, false, 1);
  c.path.append(std::make_shared<Arc>(Arc({20, 10, 0}, {0, -1, 0}, {1, 0, 0}, 10, 1.5)), 1);
  const auto s = element_runs(c.path, 0, 2, {0, 0}, {1e-6, 3}, silent_scope());
  const Element &a = s[0].elements[0], &b = s[0].elements[1];
  const JointShape shape = joint_shape(a, b);
  EXPECT_EQ(shape.turn, 0);
  EXPECT_NEAR(shape.curvature_jump, 0.1, 1e-12);
  const Reach r = reach(shape, 1e-4, {1800, 16000, HUGE_VAL, 0});
  const Rational curve = corner_curve(a, r.allowed, b, r.allowed);
  EXPECT_LE(corner_fit(curve, a, r.allowed, b, r.allowed, 1.1e-4).deviation, 1.1e-4);
  EXPECT_GT(corner_fit(curve, a, r.allowed, b, r.allowed, 0.8e-4).deviation, 0.8e-4);
}

TEST(BlendCorner, ALopsidedBlendOfLinesIsMeasured) {
  // Cut back unequally the curve first runs past the corner; its middle says nothing.
  const auto s = corner(1.5);
  const Element &a = s[0].elements[0], &b = s[0].elements[1];
  const Rational curve = corner_curve(a, 0.2, b, 4);
  double off = 0;
  for (int i = 0; i <= 1000; ++i) {
    const Vec p = curve.at(i / 1000.0).value;
    double near = HUGE_VAL;
    for (int k = 0; k <= 1000; ++k) {
      near = std::min(near, norm(p - a.at(a.length * k / 1000).value));
      near = std::min(near, norm(p - b.at(b.length * k / 1000).value));
    }
    off = std::max(off, near);
  }
  EXPECT_GT(corner_fit(curve, a, 0.2, b, 4, 0.9 * off).deviation, 0.9 * off);
  const CornerFit fit = corner_fit(curve, a, 0.2, b, 4, 10);
  EXPECT_GE(fit.deviation, off - 0.02);
  EXPECT_LE(norm(curve.at(fit.joint).value - Vec{10, 0, 0}), fit.deviation + 1e-12);
}

TEST(BlendCorner, WantsNoMoreThanSpeedAndJerkAskFor) {
  JointShape shape;
  shape.turn = 1e-3;
  const Reach calm = reach(shape, 1, {10, 16000, HUGE_VAL, 0});
  const Reach fast = reach(shape, 1, {1000, 16000, HUGE_VAL, 0});
  const Reach jerky = reach(shape, 1, {1000, 16000, 1e5, 0});
  EXPECT_LT(calm.wanted, fast.wanted + 1);
  EXPECT_LT(fast.wanted, jerky.wanted);
  EXPECT_LE(jerky.wanted, jerky.allowed);
  EXPECT_EQ(reach({}, 1, {1000, 16000, 1e5, 0}).wanted, 0);
}

TEST(BlendCorner, JointsThatJerkPassesStayAsGiven) {
  // Steps of 1000 mm/s² (jerk · cycle) pass a jump of curvature of 1e-3/mm at 1000 mm/s, one of 0.1/mm at 100 mm/s.
  const Ability able{1000, 16000, 1e6, 1, 23000, 2e-3};
  JointShape small, large;
  small.curvature_jump = 0.9e-3, small.tightest = 0.1;
  large.curvature_jump = 0.1, large.tightest = 0.1;
  EXPECT_EQ(reach(small, 0.02, able).wanted, 0);
  const Reach wanted = reach(large, 0.02, able);
  EXPECT_GT(wanted.wanted, 0);
  EXPECT_NEAR(wanted.least, 0.1, 1e-9);  // Δκ v³/d = jerk at those 100 mm/s
  // A kink takes its share of the step, and beyond the corner's angle the motion would rest.
  small.turn = 1e-3;
  EXPECT_EQ(reach(small, 0.02, able).wanted, 0);
  small.turn = 1e-2;
  EXPECT_GT(reach(small, 0.02, able).wanted, 0);
  // Without a limit of jerk blends cost nothing.
  small.turn = 0;
  EXPECT_GT(reach(small, 0.02, {1000, 16000, HUGE_VAL, 1, 23000, 2e-3}).wanted, 0);
}

}  // namespace
}  // namespace bahnwerk::blending
