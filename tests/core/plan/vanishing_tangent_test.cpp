/// Curves whose parametric tangent vanishes, as drawing programs write them at corner nodes: handles retracted to the
/// node, cusps inside. Every method plans them, and since limits do not know which way time runs, a contour run
/// backwards takes as long.
#include <gtest/gtest.h>

#include <string>

#include "core/base/progress.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/plan/random_contour.hpp"

namespace bahnwerk {
namespace {

using testing::Outline;
using testing::Shape;

constexpr double feed = 80;

Shape bezier(std::vector<Vec> points, std::vector<double> weights = {}) {
  Shape s;
  s.kind = Shape::nurbs;
  s.degree = static_cast<int>(points.size()) - 1;
  s.from = points.front(), s.to = points.back();
  s.knots.assign(points.size(), 0);
  s.knots.insert(s.knots.end(), points.size(), 1);
  s.points = std::move(points), s.weights = std::move(weights);
  return s;
}

Shape spline(std::size_t degree, std::vector<Vec> points) {
  Shape s;
  s.kind = Shape::nurbs;
  s.degree = static_cast<int>(degree);
  s.from = points.front(), s.to = points.back();
  const std::size_t inner = points.size() - degree - 1;
  s.knots.assign(degree + 1, 0);
  for (std::size_t i = 1; i <= inner; ++i) s.knots.push_back(static_cast<double>(i) / static_cast<double>(inner + 1));
  s.knots.insert(s.knots.end(), degree + 1, 1);
  s.points = std::move(points);
  return s;
}

Shape line(Vec from, Vec to) {
  Shape s;
  s.from = from, s.to = to;
  return s;
}

/// ((t − m)^p, (t − m)^q), moved to begin at the origin.
Shape cusp(double m, std::size_t p, std::size_t q, double size) {
  const std::size_t n = std::max(p, q);
  const auto row = [&](std::size_t power) {
    std::vector<double> a(n + 1, 0.0);
    for (std::size_t j = 1; j <= power; ++j)
      a[j] = size * testing::binomial(power, j) * std::pow(-m, static_cast<double>(power - j));
    return a;
  };
  const auto x = row(p), y = row(q);
  Shape s;
  s.kind = Shape::polynomial;
  for (std::size_t i = 0; i <= n; ++i) {
    Vec point;
    for (std::size_t j = 0; j <= i; ++j) {
      const double share = testing::binomial(i, j) / testing::binomial(n, j);
      point = point + Vec{share * x[j], share * y[j], 0};
    }
    s.points.push_back(point);
  }
  s.from = s.points.front(), s.to = s.points.back();
  return s;
}

Outline of(std::vector<Shape> shapes, double speed = feed) {
  Outline o{2, std::move(shapes), {}};
  o.feeds.assign(o.shapes.size(), speed);
  return o;
}

struct Case {
  std::string name;
  Outline outline;
};

std::vector<Case> cases() {
  const auto right_angle = [](double size) {
    return of({bezier({{0, 0}, {0, size}, {1.25 * size, size}, {1.25 * size, size}})});
  };
  Shape arc;
  arc.kind = Shape::arc;
  arc.from = {-6, 0}, arc.to = {0, 6}, arc.centre = {-6, 6}, arc.counter_clockwise = true;
  return {
      {"the handle of the end", of({bezier({{0, 0}, {9, 4}, {17, -6}, {17, -6}})})},
      {"the handles of both ends", of({bezier({{0, 0}, {0, 0}, {8, 5}, {8, 5}})})},
      {"both handles of a planar curve", of({bezier({{1, 1}, {1, 1}, {9, -2}, {14, 3}, {14, 3}})})},
      {"a right angle of 7 mm", right_angle(7)},
      {"a right angle of 30 µm", right_angle(0.03)},
      {"a right angle of 20 nm", right_angle(2e-5)},
      {"a quadratic curve", of({bezier({{0, 0}, {6, 2}, {6, 2}})})},
      {"two points of a quartic curve", of({bezier({{0, 0}, {3, 7}, {11, 4}, {11, 4}, {11, 4}})})},
      {"a quintic curve", of({bezier({{0, 0}, {4, 1}, {5, 5}, {9, 2}, {13, 6}, {13, 6}})})},
      {"a rational cubic curve", of({bezier({{0, 0}, {5, -3}, {12, 2}, {12, 2}}, {1, 0.5, 2.2, 0.9})})},
      {"the begin behind a line", of({line({0, 0}, {8, 5}), bezier({{8, 5}, {8, 5}, {8.7, 4.6}, {8.65, 4.5}})})},
      {"the begin behind an arc that ends in motion", of({arc, bezier({{0, 6}, {0, 6}, {0, 11}, {7, 13}})})},
      {"a control point of a spline, twice",
       of({spline(3, {{0, 0}, {2, 3}, {5, 4}, {5, 4}, {8, 1}, {12, 3}, {14, 0}})})},
      {"a control point of a spline, three times",
       of({spline(3, {{0, 0}, {2, 3}, {5, 4}, {5, 4}, {5, 4}, {8, 1}, {12, 3}})})},
      {"a cusp inside", of({cusp(0.4, 2, 3, 20)})},
      {"a cusp of third order inside", of({cusp(0.45, 3, 4, 20)})},
      {"handles of 1 nm", of({bezier({{0, 0}, {9, 4}, {17 + 1e-9, -6}, {17, -6}})})},
      {"handles of rounding", of({bezier({{50, 0}, {59, 4}, {67 + 4e-13, -6 + 3e-13}, {67, -6}})})},
      {"a handle of 1.5 µm behind 4 m",
       of({line({-4000, 3}, {0, 0}), bezier({{0, 0}, {0, 0}, {0.0008, 0.0006}, {0.0015, 0.0002}})}, 400)},
      {"a handle at the end of 2 µm behind 6 m",
       of({line({-6000, 3}, {0, 0}), bezier({{0, 0}, {0.0008, 0.0006}, {0.002, 0.0002}, {0.002, 0.0002}})}, 400)},
      // Beside their end these run along the diagonal, at the end itself along x.
      {"a handle of 20 fm along the diagonal", of({bezier({{0, 0}, {2, 1}, {12 - 2e-11, 11}, {12, 11}})})},
      {"a handle of 4 pm behind a line",
       of({line({-30, 0}, {0, 0}), bezier({{0, 0}, {2, 1}, {12 - 4e-9, 11}, {12, 11}})})},
      {"a handle of 20 pm", of({bezier({{0, 0}, {2, 1}, {12 - 2e-8, 11}, {12, 11}})})},
  };
}

ContourPlan plan(const Outline& outline, PlanningMethod method) {
  Progress progress;
  ContourPlanning planning;
  planning.method = method;
  Machine machine{{{"x", 900, 9000, 4e5}, {"y", 900, 9000, 4e5}, {"z", 900, 9000, 4e5}}, 0.001};
  machine.axes.resize(outline.dimension);
  return plan_contour(build(outline), machine, planning, progress);
}

/// Without limited jerk durations agree to `close`.
void expect_same_backwards(const Outline& outline, PlanningMethod method, double close = 1e-6) {
  double duration[2] = {};
  for (const bool back : {false, true}) {
    ContourPlan found;
    ASSERT_NO_THROW(found = plan(back ? testing::reversed(outline) : outline, method));
    for (const Check& c : found.verification.checks)
      EXPECT_TRUE(c.passed) << check_name(c) << " " << c.value << ", limit " << c.limit << ", backwards " << back;
    duration[back] = found.duration;
  }
  const double tolerance = method == PlanningMethod::jerk_limited ? 1e-3 : close;
  EXPECT_NEAR(duration[1], duration[0], tolerance * duration[0]);
}

constexpr PlanningMethod methods[] = {PlanningMethod::braking_reserve, PlanningMethod::time_optimal,
                                      PlanningMethod::jerk_limited};

TEST(VanishingTangent, EveryMethodPlansItAndBackwardsTakesAsLong) {
  for (const Case& one : cases())
    for (const PlanningMethod method : methods) {
      SCOPED_TRACE(one.name + ", method " + std::to_string(static_cast<int>(method)));
      expect_same_backwards(one.outline, method);
    }
}

/// Where the curvature stays bounded a motion passes: what vanishes there is the parameter's affair alone.
TEST(VanishingTangent, DoesNotSlowTheMotionOnAParabola) {
  Shape parabola;  // (15 x, 15 x²) for x = −0.064 … 0.216, as x = (t − 0.4)³ makes it
  parabola.kind = Shape::polynomial;
  parabola.points = {{0, 0}, {2.1, -0.2688}, {4.2, 0.6384}};
  parabola.from = parabola.points.front(), parabola.to = parabola.points.back();
  const Outline vanishing = of({cusp(0.4, 3, 6, 15)});
  for (const PlanningMethod method : methods) {
    SCOPED_TRACE(static_cast<int>(method));
    expect_same_backwards(vanishing, method);
    const double expected = plan(of({parabola}), method).duration;
    EXPECT_NEAR(plan(vanishing, method).duration, expected,
                (method == PlanningMethod::jerk_limited ? 1e-3 : 1e-6) * expected);
  }
}

/// Handles of some 50 mm that lead there and back: a curve that turns round within nanometres, in the middle of a
/// piece.
std::vector<Case> needles() {
  std::vector<Case> list;
  for (const double width : {1e-10, 3e-8, 1e-6, 2e-5, 4e-4, 2e-3}) {
    const std::string wide = " of " + std::to_string(1e6 * width) + " nm";
    list.push_back({"there and back" + wide, of({bezier({{0, 0}, {45, width / 2}, {0, width}})})});
    list.push_back({"an S" + wide, of({bezier({{0, 0}, {50, 0}, {50, width}, {10, width}})})});
    list.push_back({"all but a cusp" + wide, of({bezier({{0, 0}, {40, 40}, {width, 40}, {40 + width, 0}})})});
  }
  return list;
}

/// With limited accelerations a rest at the point costs next to nothing: as there and back on straight lines.
TEST(VanishingTangent, NeedlePointsAreTurnedAtRest) {
  for (const Case& one : needles())
    for (const PlanningMethod method : methods) {
      SCOPED_TRACE(one.name + ", method " + std::to_string(static_cast<int>(method)));
      expect_same_backwards(one.outline, method, 2e-6);
    }
  // 22.5 mm out and back at 80 mm/s and 9000 mm/s².
  const double expected = 2 * (22.5 / feed + feed / 9000);
  for (const double width : {1e-10, 3e-8, 1e-6, 2e-5, 4e-4})
    EXPECT_NEAR(plan(of({bezier({{0, 0}, {45, width / 2}, {0, width}})}), PlanningMethod::time_optimal).duration,
                expected, 1e-5 * expected)
        << width;
}

TEST(VanishingTangent, CostsNothingOnAStraightCurve) {
  // Rest to rest over 5 mm at 80 mm/s and, along (3, 4), 9000/0.8 mm/s².
  const Outline straight = of({bezier({{0, 0}, {0, 0}, {3, 4}, {3, 4}})});
  const double expected = 5 / feed + feed / (9000 / 0.8);
  EXPECT_NEAR(plan(straight, PlanningMethod::time_optimal).duration, expected, 1e-6 * expected);
}

/// The pipeline takes a plan that loses 5e-6 at most to its grid as it is: durations may differ by as much.
TEST(VanishingTangent, RandomContoursWithRetractedHandles) {
  Random random(35);
  for (int i = 0; i < 36; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Outline outline = testing::random_outline(random, 1 + random.below(4), random.chance(0.2) ? 3 : 2);
    for (Shape& s : outline.shapes) {
      const std::size_t n = s.points.size();
      if (n < 4) continue;
      if (random.chance(0.5)) s.points[1] = s.points[0];
      if (random.chance(0.5)) s.points[n - 2] = s.points[n - 1];
    }
    expect_same_backwards(outline, methods[i % 3], 5e-6);
  }
}

}  // namespace
}  // namespace bahnwerk
