#include "core/plan/contour/contour_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk {
namespace {

const Machine machine{{{"x", 1800, 16000}, {"y", 1800, 16000}, {"z", 600, 5000}}, 0.001};

Contour random_contour(unsigned seed, std::size_t segments, double feed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-50, 50);
  ContourBuilder builder(2, {});
  Vec last;
  for (std::size_t i = 0; i < segments; ++i) {
    if (i % 5 == 0) builder.block(i % 10 == 0 ? Mode::cut : Mode::position, feed);
    const Vec to{uniform(random), uniform(random), 0};
    if (i % 3 == 0)
      builder.arc(to, 0.5 * (last + to), i % 2 == 0);
    else
      builder.line(to);
    last = to;
  }
  return builder.finish();
}

double distance(Vec p, Vec a, Vec b) {
  const Vec way = b - a;
  const double t = std::clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0);
  return norm(p - (a + t * way));
}

TEST(ContourOutline, IsWithinItsToleranceAndItsNumberOfVertices) {
  Progress progress;
  for (const std::size_t most : {2U, 10U, 100U, 5000U}) {
    const Contour contour = random_contour(1, 100, 100);
    const Outline shape = outline(contour, most, progress);
    ASSERT_LE(shape.vertices.size(), most);
    ASSERT_EQ(shape.vertices.size(), shape.cut.size());
    for (double s = 0; s < contour.path.length(); s += 17.3) {
      double nearest = HUGE_VAL;
      for (std::size_t i = 1; i < shape.vertices.size(); ++i)
        nearest = std::min(nearest, distance(contour.path.at(s).value, shape.vertices[i - 1], shape.vertices[i]));
      ASSERT_LE(nearest, shape.tolerance) << s << " of " << most;
    }
  }
}

TEST(ContourOutline, TellsWhereSomethingIsCut) {
  Progress progress;
  ContourBuilder builder(2, {});
  builder.block(Mode::cut, 100);
  builder.line({10, 0, 0});
  builder.line({20, 0, 0});
  builder.block(Mode::position, unlimited);
  builder.line({30, 0, 0});
  const Outline shape = outline(builder.finish(), 100, progress);
  ASSERT_EQ(shape.vertices.size(), 3U);
  EXPECT_EQ(shape.cut, (std::vector<bool>{false, true, false}));
  EXPECT_NEAR(shape.vertices[1].x, 20, 1e-9);
}

TEST(ContourOutline, ThinsPolylines) {
  Progress progress;
  std::vector<Vec> circle;
  for (int i = 0; i <= 20000; ++i)
    circle.push_back({50 * std::cos(std::numbers::pi * i / 1e4), 50 * std::sin(std::numbers::pi * i / 1e4), 0});
  const Outline shape = outline(circle, 5000, progress);
  EXPECT_LE(shape.vertices.size(), 5000U);
  EXPECT_LE(shape.tolerance, 0.01);
  EXPECT_EQ(outline({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 3, progress).vertices.size(), 3U);
}

TEST(DurationEstimate, IsThatOfAPlanWithinAFifth) {
  Progress progress;
  for (const double feed : {20.0, 200.0, unlimited}) {
    const Contour contour = random_contour(3, 20, feed);
    ContourPlanning planning;
    planning.method = PlanningMethod::time_optimal;
    const ContourPlan plan = plan_contour(contour, machine, planning, progress);
    const DurationEstimate estimate = estimate_duration(contour, CartesianAxisPath(contour.path, machine.dimension()),
                                                        machine, planning.corner_angle, progress);
    EXPECT_NEAR((estimate.cut_time + estimate.position_time) / plan.duration, 1, 0.2) << feed;
    EXPECT_NEAR(estimate.cut_time / plan.cut_time, 1, 0.25) << feed;
  }
}

}  // namespace
}  // namespace bahnwerk
