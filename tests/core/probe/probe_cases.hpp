#pragma once
/// Problems of probe paths for tests, and what every plan has to keep.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"
#include "core/verify/probe/probe_checks.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk::probe_cases {

/// All axes alike; in the plane where every z is 0 and `dimension` is 2.
inline ProbeProblem problem(std::vector<Vec> points, double tolerance, std::size_t dimension = 2, double speed = 20,
                            double a = 200, double j = 4000, double s = 200000) {
  ProbeProblem p;
  p.given = std::move(points);
  p.tolerance = tolerance;
  p.speed = speed;
  for (std::size_t k = 0; k < dimension; ++k) {
    AxisLimits axis(std::string(1, "xyz"[k]), unlimited, a, j);
    axis.snap = s;
    p.machine.axes.push_back(axis);
  }
  merge_points(p);
  return p;
}

inline std::vector<Vec> circle(std::size_t n, double radius) {
  std::vector<Vec> points;
  for (std::size_t i = 0; i <= n; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(n);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return points;
}

/// Every check of the verifier passes.
inline void expect_right(const ProbeProblem& problem, const ProbeMotion& plan, const std::string& name = "") {
  Progress silent;
  for (const Check& check : probe_checks({problem, *plan.motion, plan.times}, silent))
    EXPECT_TRUE(check.passed) << name << " " << check_name(check) << ": " << check.value << " of " << check.limit
                              << " at " << check.at;
  ASSERT_EQ(plan.times.size(), problem.points.size()) << name;
}

/// Points of one of several kinds, 3 to 500 of them, with spacings from 0.01 to 100 mm, tubes from 0 to ten spacings,
/// and limits over four decades; in the plane or in space.
struct RandomSet {
  ProbeProblem problem;
  std::string words;

  explicit RandomSet(std::uint64_t seed) : random_(seed + 1) {
    const std::size_t dimension = in(0, 1) < 0.5 ? 2 : 3;
    const auto n = static_cast<std::size_t>(3 * std::pow(500.0 / 3, in(0, 1)));
    const double spacing = std::pow(10, in(-2, 2));
    static constexpr const char* kinds[] = {"walk", "smooth", "zigzag", "reversing", "grid", "noisy line", "mixed"};
    const auto kind = static_cast<std::size_t>(in(0, 6.999));
    std::vector<Vec> points = make(kind, n, spacing, dimension);
    const double tolerance = in(0, 1) < 0.2 ? 0 : spacing * std::pow(10, in(-3, 1));
    ProbeProblem p = probe_cases::problem(points, tolerance, dimension, spacing * std::pow(10, in(-1, 1.5)));
    for (AxisLimits& axis : p.machine.axes) {
      // From what the speed would need within a few spacings.
      const double time = spacing / p.speed * std::pow(10, in(-1, 1));
      axis.acceleration = p.speed / time * std::pow(10, in(-1, 1));
      axis.jerk = p.speed / time / time * std::pow(10, in(-1, 1));
      axis.snap = p.speed / time / time / time * std::pow(10, in(-1, 1));
    }
    problem = p;
    char text[200];
    std::snprintf(text, sizeof text, "%s n=%zu dim=%zu spacing=%.3g delta=%.3g speed=%.3g", kinds[kind], n, dimension,
                  spacing, tolerance, p.speed);
    words = text;
  }

 private:
  double in(double low, double high) { return low + (high - low) * random_.uniform(); }
  Vec direction(std::size_t dimension) {
    for (;;) {
      const Vec d{in(-1, 1), in(-1, 1), dimension == 3 ? in(-1, 1) : 0};
      if (norm(d) > 0.1 && norm(d) <= 1) return d / norm(d);
    }
  }
  std::vector<Vec> make(std::size_t kind, std::size_t n, double spacing, std::size_t dimension) {
    std::vector<Vec> list;
    Vec at{in(-50, 50), in(-50, 50), dimension == 3 ? in(-50, 50) : 0}, d = direction(dimension);
    const Vec side = direction(dimension);
    for (std::size_t i = 0; i < n; ++i) {
      list.push_back(at);
      double step = spacing;
      switch (kind) {
        case 0:
          d = direction(dimension), step *= std::pow(10, in(-0.5, 0.5));
          break;
        case 1: {
          const Vec next = d + 0.1 * side + 0.2 * direction(dimension);
          d = next / norm(next);
          break;
        }
        case 2:
          d = (i % 2 == 0 ? 1.0 : -1.0) * side + 0.3 * direction(dimension);
          break;
        case 3:
          if (in(0, 1) < 0.3) d = -d;
          break;
        case 4:
          if (in(0, 1) < 0.3) d = Vec{i % 2 == 0 ? 1.0 : 0.0, i % 2 == 0 ? 0.0 : 1.0, 0};
          if (in(0, 1) < 0.1) step = 0;
          break;
        case 5:
          list.back() += 1e-4 * spacing * direction(dimension);
          break;
        default:
          if (in(0, 1) < 0.3) d = direction(dimension);
          if (in(0, 1) < 0.1) step = 0;
          if (in(0, 1) < 0.1) d = -d;
      }
      at += step * d;
    }
    if (norm(list.back() - list.front()) == 0) list.back().x += spacing;
    return list;
  }

  Random random_;
};

}  // namespace bahnwerk::probe_cases
