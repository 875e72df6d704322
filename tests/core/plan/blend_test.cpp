/// Blending from end to end: random contours stay in the tube, and durations do what blending is for.
#include "core/contour/blend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/polyline.hpp"
#include "core/geometry/curve/curvature.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/numeric/random.hpp"
#include "core/verify/geometry/tube.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = 3.14159265358979323846;

Machine machine(std::size_t dimension = 2) {
  Machine m;
  for (const char* name : {"x", "y", "z"})
    if (m.axes.size() < dimension) m.axes.push_back({name, 1800, 16000, unlimited});
  return m;
}

Contour blended(const Contour& given, double tolerance) {
  Progress progress;
  return blend(given, {tolerance}, machine(given.dimension), progress);
}

double duration(const Contour& contour) {
  Progress progress;
  return plan_acceleration_limited(contour, machine(contour.dimension), {}, progress).law.duration();
}

Check tube(const Contour& given, const Contour& path, double tolerance) {
  Progress progress;
  return tube_checks(given, path, tolerance, progress).back();
}

/// What every blended contour owes: ends and blocks kept, joints continuous to the third derivative unless they stop.
void expect_sound(const Contour& given, const Contour& path, double tolerance, double corner_angle = 0.1 * pi / 180) {
  ASSERT_FALSE(path.path.empty());
  const Check check = tube(given, path, tolerance);
  EXPECT_TRUE(check.passed) << check.value << " at " << check.at;
  EXPECT_LE(norm(path.path.at(0).value - given.path.at(0).value), 1e-9);
  EXPECT_LE(norm(path.path.at(path.path.length()).value - given.path.at(given.path.length()).value), 1e-9);
  ASSERT_EQ(path.blocks.size(), given.blocks.size());
  std::size_t at = 0;
  for (std::size_t b = 0; b < path.blocks.size(); ++b) {
    EXPECT_EQ(path.blocks[b].mode, given.blocks[b].mode);
    EXPECT_EQ(path.blocks[b].feed, given.blocks[b].feed);
    EXPECT_EQ(path.blocks[b].first, at);
    at = path.blocks[b].last;
  }
  EXPECT_EQ(at, path.path.size());
  for (std::size_t i = 0; i < path.path.size(); ++i) {
    const Segment& s = path.path[i];
    for (const double x : {0.0, 0.3, 1.0}) {
      const Jet h = s.at_parameter(s.curve().begin() + x * (s.curve().end() - s.curve().begin()));
      ASSERT_TRUE(std::isfinite(norm(h.value) + norm(h.d1) + norm(h.d2) + norm(h.d3))) << i;
    }
    if (i > 0) {
      EXPECT_LE(norm(s.curve().at(s.curve().begin()).value -
                     path.path[i - 1].curve().at(path.path[i - 1].curve().end()).value),
                1e-8)
          << i;
    }
  }
  const auto mode = [&](std::size_t segment) {
    for (const Block& b : path.blocks)
      if (segment < b.last) return b.mode;
    return Mode::cut;
  };
  // Between two rests where a run had to be cut a small jump may stay; it is rare and noted.
  std::size_t left = 0;
  for (const Joint& joint : joints(path.path))
    if (joint.angle <= corner_angle && mode(joint.next) == mode(joint.next - 1) && joint.angle > 1e-6) ++left;
  EXPECT_LE(left, given.path.size() / 50);
  if (left > 0) {
    bool noted = false;
    for (const std::string& note : path.notes) noted = noted || note.ends_with("below the corner angle left");
    EXPECT_TRUE(noted);
  }
}

/// Points of a smooth closed curve, 60 by 40 mm.
Vec smooth_curve(double t) {
  return {60 * std::cos(t) + 12 * std::cos(5 * t + 0.3), 40 * std::sin(2 * t) + 8 * std::sin(7 * t), 0};
}
Vec smooth_slope(double t) {
  return {-60 * std::sin(t) - 60 * std::sin(5 * t + 0.3), 80 * std::cos(2 * t) + 56 * std::cos(7 * t), 0};
}

Contour chords(int n, double rounding) {
  std::vector<Vec> points;
  for (int i = 0; i <= n; ++i) {
    Vec p = smooth_curve(2 * pi * i / n);
    if (rounding > 0) p = {std::round(p.x / rounding) * rounding, std::round(p.y / rounding) * rounding, 0};
    points.push_back(p);
  }
  return polyline(2, points, false, unlimited);
}

/// The curve itself, as cubic pieces that agree with it to 1e-9 mm.
double smooth_duration() {
  constexpr int n = 4000;
  std::vector<Vec> points{smooth_curve(0)};
  std::vector<double> knots{0};
  for (int i = 0; i < n; ++i) {
    const double a = 2 * pi * i / n, b = 2 * pi * (i + 1) / n, third = (b - a) / 3;
    points.push_back(smooth_curve(a) + third * smooth_slope(a));
    points.push_back(smooth_curve(b) - third * smooth_slope(b));
    points.push_back(smooth_curve(b));
    knots.insert(knots.end(), 3, i);
  }
  knots.insert(knots.end(), 4, n);
  ContourBuilder b(2, points.front());
  b.block(Mode::cut, unlimited);
  b.nurbs(3, points, {}, knots);
  return duration(b.finish());
}

TEST(BlendDuration, TenThousandChordsWithinOnePercentOfTheCurve) {
  const double best = smooth_duration();
  for (const double rounding : {0.0, 1e-3}) {
    const Contour given = chords(10000, rounding), path = blended(given, 0.01);
    expect_sound(given, path, 0.01);
    EXPECT_LE(duration(path), 1.01 * best) << rounding;
    EXPECT_LT(path.path.size(), 2000u);
  }
}

Contour walk(std::uint64_t seed, int n, double turn, double shortest, double longest) {
  Random random(seed);
  std::vector<Vec> points{{}};
  double heading = 0;
  for (int i = 0; i < n; ++i) {
    heading += random.uniform(-turn, turn);
    const double length = random.uniform(shortest, longest);
    points.push_back(points.back() + length * Vec{std::cos(heading), std::sin(heading), 0});
  }
  return polyline(2, points, false, unlimited);
}

/// Distance of a point from a polyline, by trying every line: shares nothing with the check of the tube.
double nearest_line(const std::vector<Vec>& points, Vec p) {
  double best = HUGE_VAL;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec way = points[i] - points[i - 1], d = p - points[i - 1];
    const Vec off = d - std::clamp(dot(d, way) / dot(way, way), 0.0, 1.0) * way;
    best = std::min(best, dot(off, off));
  }
  return std::sqrt(best);
}

TEST(BlendDuration, ThreeThousandSegmentsTakeLessThanHalf) {
  const Contour given = walk(7, 3000, 0.3, 0.2, 2), path = blended(given, 0.02);
  expect_sound(given, path, 0.02);
  std::vector<Vec> points{given.path.at(0).value};
  for (std::size_t i = 0; i < given.path.size(); ++i) points.push_back(given.path[i].curve().at(1).value);
  double worst = 0;
  for (int i = 0; i <= 20000; ++i)
    worst = std::max(worst, nearest_line(points, path.path.at(path.path.length() * i / 20000).value));
  EXPECT_LE(worst, 0.02);
  EXPECT_GE(worst, 0.01);  // the tolerance is used
  EXPECT_LE(duration(path), 0.5 * duration(given));
}

TEST(BlendDuration, NeverLongerThanStopping) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Contour given = walk(seed, 40, 3, 0.05, 5), path = blended(given, 0.02);
    expect_sound(given, path, 0.02);
    EXPECT_LE(duration(path), duration(given) * (1 + 1e-6)) << seed;
  }
}

/// A spiral of tangent arcs from 5 mm radius on.
Contour spiral(int arcs, double grows) {
  ContourBuilder b(2, {5, 0, 0});
  Vec centre;
  double angle = 0, radius = 5;
  for (int i = 0; i < arcs; ++i) {
    angle += 0.5 + std::abs(std::sin(i));
    const Vec out{std::cos(angle), std::sin(angle), 0};
    b.arc(centre + radius * out, centre, true);
    radius += grows;
    centre += -grows * out;
  }
  return b.finish();
}

TEST(BlendDuration, TangentArcsAreRoundedWhereJerkAllowsIt) {
  Progress progress;
  for (const double grows : {0.02, 0.15})
    for (const double jerk : {1e5, 1e6, 1e7, 1e9}) {
      const Contour given = spiral(60, grows);
      Machine jerky = machine();
      for (AxisLimits& axis : jerky.axes) axis.jerk = jerk;
      const Contour path = blend(given, {0.02}, jerky, progress);
      const auto time = [&](const Contour& c) { return plan_jerk_limited(c, jerky, {}, progress).law.duration(); };
      EXPECT_LE(time(path), time(given) * (1 + 5e-4)) << grows << " " << jerk;
    }
}

/// Lines, arcs and splines of lengths over six decades, with everything that part files bring.
Contour random_contour(Random& random) {
  const std::size_t dimension = random.chance(0.3) ? 3 : 2;
  Vec at{random.uniform(-500, 500), random.uniform(-500, 500), 0};
  ContourBuilder b(dimension, at);
  const int blocks = 1 + static_cast<int>(random.uniform(0, 4));
  double heading = random.uniform(-pi, pi);
  for (int k = 0; k < blocks; ++k) {
    b.block(random.chance(0.3) ? Mode::position : Mode::cut, random.chance(0.5) ? unlimited : random.uniform(20, 600));
    const int n = 1 + static_cast<int>(std::pow(10, random.uniform(0, 2.4)));
    const double decades = random.uniform(0, 6), turn = std::pow(10, random.uniform(-3, 0.5));
    for (int i = 0; i < n; ++i) {
      heading += random.chance(0.03) ? pi : random.uniform(-turn, turn);
      const double length = std::pow(10, 1 - decades * random.uniform());
      const Vec ahead{std::cos(heading), std::sin(heading), 0};
      const double kind = random.uniform();
      if (kind < 0.7) {
        Vec to = at + length * ahead;
        if (dimension == 3) to.z += length * random.uniform(-0.5, 0.5);
        if (random.chance(0.05)) to = at;
        if (random.chance(0.05)) to += Vec{1e-7, -1e-7, 0};
        b.line(to);
      } else if (kind < 0.9) {
        const double side = random.chance(0.5) ? 1 : -1, sweep = random.uniform(0.05, 4), radius = length / sweep;
        const Vec centre = at + radius * side * Vec{-ahead.y, ahead.x, 0}, d = at - centre;
        const double c = std::cos(side * sweep), s = std::sin(side * sweep);
        Vec to = centre + Vec{c * d.x - s * d.y, s * d.x + c * d.y, d.z};
        if (dimension == 3 && random.chance(0.3)) to.z += 0.3 * length;
        if (norm(to - at) > 1e-5) {
          b.arc(to, centre, side > 0);
          heading += side * sweep;
        }
      } else {
        std::vector<Vec> points{at};
        for (int j = 0; j < 4; ++j)
          points.push_back(points.back() +
                           (length / 4) * Vec{std::cos(heading + 0.3 * j), std::sin(heading + 0.3 * j), 0});
        heading += 0.9;
        b.nurbs(2, points, {}, {0, 0, 0, 0.3, 0.7, 1, 1, 1});
      }
      at = b.position();
    }
  }
  return b.finish();
}

TEST(BlendProperty, RandomContoursStayInTheTube) {
  for (std::uint64_t seed = 0; seed < testing::cases(std::uint64_t{200}); ++seed) {
    Random random(seed);
    const double tolerance = std::pow(10, random.uniform(-4, 0));
    Contour given;
    try {
      given = random_contour(random);
    } catch (const InvalidInput&) {
      continue;  // nothing but dropped segments
    }
    SCOPED_TRACE(seed);
    const Contour path = blended(given, tolerance);
    expect_sound(given, path, tolerance);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace bahnwerk
