/// Slow and fast, short and long, near and far: feeds from 1e-4 to 1e5 mm/s over 1e-3 to 1e6 mm, hours of motion,
/// the lowest limits and the largest coordinates of the schema. Nothing but rounding scales with any of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/plan/random_contour.hpp"

namespace bahnwerk {
namespace {

constexpr std::array methods{PlanningMethod::time_optimal, PlanningMethod::braking_reserve,
                             PlanningMethod::jerk_limited};

enum class Shape { line, arc, nurbs, lines, mixed };
constexpr std::array shapes{Shape::line, Shape::arc, Shape::nurbs, Shape::lines, Shape::mixed};

/// About `size` mm long, from `at` on.
Contour contour(Shape shape, double size, double feed, Vec at = {}) {
  ContourBuilder b(2, at);
  b.block(Mode::cut, feed);
  const auto to = [&](double x, double y) { return at + size * Vec{x, y, 0}; };
  const auto curve = [&](Vec from) {
    b.nurbs(3,
            {from, from + size * Vec{0.2, 0.1, 0}, from + size * Vec{0.4, -0.1, 0}, from + size * Vec{0.5, 0.1, 0},
             from + size * Vec{0.6, 0.1, 0}},
            {1, 2, 0.5, 1, 1}, {0, 0, 0, 0, 0.4, 1, 1, 1, 1});
  };
  switch (shape) {
    case Shape::line:
      b.line(to(0.8, 0.6));
      break;
    case Shape::arc:
      b.arc(to(0.2, 0.2), to(0, 0.2), true);
      break;
    case Shape::nurbs:
      curve(at);
      break;
    case Shape::lines:  // a corner, a small bend that is passed
      b.line(to(0.3, 0));
      b.line(to(0.3, 0.3));
      b.line(to(0.3001, 0.6));
      break;
    case Shape::mixed:
      b.line(to(0.2, 0));
      b.arc(to(0.2, 0.2), to(0.2, 0.1), true);
      b.line(to(0.1, 0.2));
      curve(to(0.1, 0.2));
      break;
  }
  return b.finish();
}

struct Limits {
  double velocity = 1800, acceleration = 16000, jerk = 8e5;
};

Machine machine(const Limits& limits, double cycle_time) {
  Machine m;
  m.axes = {{"x", limits.velocity, limits.acceleration, limits.jerk},
            {"y", limits.velocity, limits.acceleration, limits.jerk}};
  m.cycle_time = cycle_time;
  return m;
}

/// By how much a duration may exceed its bound, relative. The bound for limited jerk is far too low where numbers are
/// at the ends of what doubles hold: `extreme`.
void expect_verified(const Contour& given, const Machine& m, PlanningMethod method, const std::string& what,
                     bool extreme = false) {
  Progress progress;
  ContourPlanning planning;
  planning.method = method;
  const ContourPlan plan = plan_contour(given, m, planning, progress);
  for (const Check& c : plan.verification.checks)
    EXPECT_TRUE(c.passed) << what << ": " << check_name(c) << ' ' << c.value << " against " << c.limit << " at "
                          << c.at;
  EXPECT_TRUE(plan.verification.passed) << what;
  if (method == PlanningMethod::time_optimal) {
    EXPECT_LE(plan.bound.gap, 1e-3) << what;
  }
  if (method == PlanningMethod::jerk_limited && !extreme) {
    EXPECT_LE(plan.bound.gap, 0.05) << what;
  }
}

std::string text(Shape shape, PlanningMethod method, double size, double feed) {
  char words[120];
  std::snprintf(words, sizeof words, "shape %d method %d size %g feed %g", static_cast<int>(shape),
                static_cast<int>(method), size, feed);
  return words;
}

/// Some thousand setpoints each, whatever the duration; that is up to 1e10 s.
double cycle(double size, double feed, const Limits& limits) {
  const double time = size / feed + 2 * std::sqrt(size / limits.acceleration) + std::cbrt(32 * size / limits.jerk);
  return std::max(1e-5, time / 3000);
}

class Speeds : public ::testing::TestWithParam<int> {};

TEST_P(Speeds, EveryFeedOverEveryLengthIsVerified) {
  const Limits limits{2e5, 16000, 8e5};
  for (const Shape shape : shapes)
    for (const PlanningMethod method : methods)
      for (double size = 1e-3; size <= 1e6; size *= 10) {
        const double feed = 1e-4 * std::pow(10, GetParam());
        expect_verified(contour(shape, size, feed), machine(limits, cycle(size, feed, limits)), method,
                        text(shape, method, size, feed));
      }
}

INSTANTIATE_TEST_SUITE_P(Feed1e, Speeds, ::testing::Range(0, 10));

TEST(Speeds, TheCasesThatWereRefused) {
  for (const PlanningMethod method : methods)
    for (const auto& [length, feed] : {std::pair{100.0, 0.1}, {10.0, 0.1}, {1e4, 1.0}, {0.5, 1e-4}}) {
      ContourBuilder b(2, {});
      b.block(Mode::cut, feed);
      b.line({length, 0, 0});
      expect_verified(b.finish(), machine({}, length > 1e3 ? 0.01 : 0.001), method,
                      text(Shape::line, method, length, feed));
    }
}

TEST(Speeds, FarFromTheOrigin) {
  for (const Shape shape : shapes)
    for (const PlanningMethod method : methods)
      for (const double size : {0.1, 10.0, 1000.0})
        for (const double feed : {1e-2, 1.0, 400.0})
          for (const Vec at : {Vec{1e6, -1e6, 0}, Vec{-9.9e6, 3, 0}})
            expect_verified(contour(shape, size, feed, at), machine({}, cycle(size, feed, {})), method,
                            text(shape, method, size, feed) + " far off", true);
}

TEST(Speeds, LimitsAtTheEndsOfTheSchema) {
  for (const Shape shape : shapes)
    for (const PlanningMethod method : methods)
      for (const double size : {0.1, 100.0})
        for (const Limits& limits : {Limits{1e-6, 1e-6, 1e-6}, Limits{1e-6, 1e9, 1e12}, Limits{1e7, 1e-6, 1e-6},
                                     Limits{1e7, 1e9, 1e12}, Limits{1800, 1e9, 1e-3}, Limits{0.01, 5, 1000}}) {
          const double time =
              size / limits.velocity + 2 * std::sqrt(size / limits.acceleration) + std::cbrt(32 * size / limits.jerk);
          expect_verified(contour(shape, size, unlimited), machine(limits, time / 2000), method,
                          text(shape, method, size, limits.velocity) + " A " + std::to_string(limits.acceleration),
                          true);
        }
}

TEST(Speeds, FeedsThatDifferByDecadesFromBlockToBlock) {
  for (const PlanningMethod method : methods) {
    ContourBuilder b(2, {});
    double x = 0;
    for (const double feed : {1000.0, 1e-3, 300.0, 0.05, 1e5, 2e-2}) {
      b.block(Mode::cut, feed);
      x += std::min(100.0, 200 * feed);
      b.line({x, 0, 0});
      b.block(Mode::position, feed);
      b.arc({x, 0, 0}, {x, std::min(10.0, 2 * feed), 0}, true);
    }
    expect_verified(b.finish(), machine({2e5, 16000, 8e5}, 0.1), method,
                    "decades " + std::to_string(static_cast<int>(method)));
  }
}

/// Random contours, each block at a feed of its own, at any scale, near the origin and far off.
TEST(Speeds, RandomContoursAtAnyScale) {
  const int cases = testing::cases(60);
  for (int n = 0; n < cases; ++n) {
    Random random(static_cast<std::uint64_t>(40'000 + n));
    auto outline = testing::random_outline(random, 1 + random.below(6), 2);
    const double scale = std::pow(10, random.uniform(-2, 3));
    outline = testing::scaled(outline, scale);
    double feed = unlimited;
    for (double& f : outline.feeds) f = feed = random.chance(0.5) ? std::pow(10, random.uniform(-4, 5)) : feed;
    Machine m = testing::random_machine(random, 2);
    for (AxisLimits& axis : m.axes) axis.jerk = axis.acceleration * std::pow(10, random.uniform(0.5, 3));
    const Contour given = testing::build(outline);
    double time = 0;
    for (std::size_t i = 0; i < given.path.size(); ++i)
      time += given.path[i].length() / std::min(given.feeds()[i], 100.0) + 0.1;
    m.cycle_time = std::max(1e-5, time / 5000);
    for (const PlanningMethod method : methods)
      expect_verified(given, m, method,
                      "seed " + std::to_string(40'000 + n) + " method " + std::to_string(static_cast<int>(method)));
  }
}

}  // namespace
}  // namespace bahnwerk
