#include "core/contour/blend.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/polyline.hpp"
#include "core/geometry/curve/curvature.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = 3.14159265358979323846;

Machine machine(double jerk = unlimited) {
  Machine m;
  m.axes = {{"x", 1800, 16000, jerk}, {"y", 1800, 16000, jerk}, {"z", 1800, 16000, jerk}};
  return m;
}

Contour blended(const Contour& given, double tolerance, double jerk = unlimited) {
  Progress progress;
  return blend(given, {tolerance}, machine(jerk), progress);
}

double distance_to(const Path& path, Vec p) {
  double best = HUGE_VAL;
  for (double s = 0; s <= path.length(); s += 1e-3) best = std::min(best, norm(path.at(s).value - p));
  return best;
}

/// Largest jumps over all joints: tangent, curvature and its rate, the latter relative to 1 + their size.
struct Jumps {
  double tangent = 0, curvature = 0, rate = 0;
};
Jumps jumps(const Path& path) {
  Jumps worst;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Jet a = path[i - 1].at_parameter(path[i - 1].curve().end());
    const Jet b = path[i].at_parameter(path[i].curve().begin());
    worst.tangent = std::max(worst.tangent, norm(a.d1 - b.d1));
    worst.curvature = std::max(worst.curvature, norm(a.d2 - b.d2) / (1 + norm(a.d2)));
    worst.rate = std::max(worst.rate, norm(a.d3 - b.d3) / (1 + norm(a.d3)));
  }
  return worst;
}
void expect_g3(const Path& path) {
  const Jumps j = jumps(path);
  EXPECT_LE(j.tangent, 1e-9);
  EXPECT_LE(j.curvature, 1e-8);
  EXPECT_LE(j.rate, 1e-5);
}

TEST(Blend, RightAngleUsesTheTolerance) {
  const Vec corner{50, 0, 0};
  const Contour path = blended(polyline(2, {{}, corner, {50, 40, 0}}, false, unlimited), 0.02);
  ASSERT_EQ(path.path.size(), 3u);
  expect_g3(path.path);
  const double off = distance_to(path.path, corner);
  EXPECT_LE(off, 0.02);
  EXPECT_GE(off, 0.96 * 0.02);  // no faster blend without more room
  EXPECT_TRUE(path.path[0].straight());
  EXPECT_TRUE(path.path[2].straight());
}

TEST(Blend, BlendsAreNoLongerThanTheMachineCanUse) {
  // 1e-4 rad: within 0.5 mm the blend could reach for kilometres.
  const Contour path = blended(polyline(2, {{}, {500, 0, 0}, {1000, 500e-4, 0}}, false, unlimited), 0.5);
  ASSERT_EQ(path.path.size(), 3u);
  EXPECT_LT(path.path[1].length(), 10);
  expect_g3(path.path);
}

TEST(Blend, TangentArcsKeepTheirShapeInTheMiddle) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({40, 0, 0});
  b.arc({50, 10, 0}, {40, 10, 0}, true);
  b.arc({70, 30, 0}, {70, 10, 0}, false);
  b.line({100, 30, 0});
  for (const double jerk : {unlimited, 1e6}) {
    const Contour given = b.finish();
    const Contour path = blended(given, 0.01, jerk);
    expect_g3(path.path);
    std::size_t arcs = 0;
    for (std::size_t i = 0; i < path.path.size(); ++i)
      if (path.path[i].curve().kind() == CurveKind::arc) {
        ++arcs;
        const double k = curvature(path.path[i].at_parameter(0.5));
        EXPECT_TRUE(std::abs(k - 0.1) < 1e-12 || std::abs(k - 0.05) < 1e-12) << k;
      }
    EXPECT_EQ(arcs, 2u);
    b = ContourBuilder(2, {});
    b.block(Mode::cut, 400);
    b.line({40, 0, 0});
    b.arc({50, 10, 0}, {40, 10, 0}, true);
    b.arc({70, 30, 0}, {70, 10, 0}, false);
    b.line({100, 30, 0});
  }
}

TEST(Blend, SharpCornersOfArcsAndSplinesInSpace) {
  ContourBuilder b(3, {});
  b.block(Mode::cut, unlimited);
  b.line({30, 0, 5});
  b.arc({30, 20, 10}, {30, 10, 5}, true);  // a helix
  b.nurbs(3, {{30, 20, 10}, {20, 25, 10}, {10, 30, 20}, {0, 10, 20}}, {}, {0, 0, 0, 0, 1, 1, 1, 1});
  b.line({0, 0, 0});
  const Contour given = b.finish(), path = blended(given, 0.05);
  expect_g3(path.path);
  for (const Joint& j : joints(given.path)) {
    const double off = distance_to(path.path, given.path.at(j.s).value);
    EXPECT_LE(off, 0.05);
    EXPECT_GE(off, 0.2 * 0.05);
  }
}

TEST(Blend, TinySegmentsBecomeOneSmoothRun) {
  std::vector<Vec> points;
  for (int i = 0; i <= 400; ++i) points.push_back({20 * std::cos(i * pi / 400), 20 * std::sin(i * pi / 400), 0});
  const Contour path = blended(polyline(2, points, false, unlimited), 0.01);
  expect_g3(path.path);
  EXPECT_LT(path.path.size(), 250u);
  for (std::size_t i = 0; i < path.path.size(); ++i) {
    const Jet middle = path.path[i].at_parameter(0.5);
    EXPECT_NEAR(norm(middle.value), 20, 0.01);
    EXPECT_NEAR(curvature(middle), 0.05, 0.01);
  }
}

TEST(Blend, ReversalsAndModeBordersStay) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({20, 0, 0});
  b.line({10, 0, 0});  // back on itself
  b.block(Mode::position, unlimited);
  b.line({10, 30, 0});
  b.line({40, 30, 0});
  const Contour path = blended(b.finish(), 0.05);
  ASSERT_EQ(path.blocks.size(), 2u);
  EXPECT_EQ(path.blocks[0].last, 2u);
  EXPECT_EQ(path.blocks[1].last, path.path.size());
  EXPECT_EQ(path.path.size(), 5u);
  EXPECT_NEAR(path.path.at(20).value.x, 20, 1e-12);
  EXPECT_NEAR(joints(path.path)[1].angle, pi / 2, 1e-12);
  bool noted = false;
  for (const std::string& note : path.notes) noted = noted || note.starts_with("2 corners not blended");
  EXPECT_TRUE(noted);
}

TEST(Blend, FeedChangesInTheMiddleOfTheBlend) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({20, 0, 0});
  b.block(Mode::cut, 100);
  b.line({20, 20, 0});
  const Contour path = blended(b.finish(), 0.05);
  ASSERT_EQ(path.path.size(), 4u);
  EXPECT_EQ(path.blocks[0].last, 2u);
  EXPECT_NEAR(path.path[1].length(), path.path[2].length(), 1e-9);
  EXPECT_EQ(path.feeds(), (std::vector<double>{400, 400, 100, 100}));
  expect_g3(path.path);
}

TEST(Blend, FeedChangesInsideARun) {
  ContourBuilder b(2, {20, 0, 0});
  b.block(Mode::cut, 400);
  for (int i = 1; i <= 400; ++i) {
    if (i == 201) b.block(Mode::cut, 100);
    b.line({20 * std::cos(i * pi / 400), 20 * std::sin(i * pi / 400), 0});
  }
  const Contour path = blended(b.finish(), 0.01);
  expect_g3(path.path);
  const Curve& after = path.path[path.blocks[1].first].curve();
  const Vec border = after.at(after.begin()).value;
  EXPECT_NEAR(border.x, 0, 0.01);
  EXPECT_NEAR(border.y, 20, 0.01);
}

TEST(Blend, EveryBlockKeepsItsPlaceHoweverShort) {
  // Blocks far shorter than the tolerance and than the spline's spans, in a run and at corners.
  for (const double width : {0.2, 0.01, 1e-4, 2e-6})
    for (const double turn : {0.01, 1.5}) {
      ContourBuilder b(2, {});
      b.block(Mode::cut, 200);
      Vec at;
      const auto go = [&](double length, double heading) {
        at += length * Vec{std::cos(heading), std::sin(heading), 0};
        b.line(at);
      };
      for (int i = 0; i < 50; ++i) go(0.2, i % 2 ? turn : 0);
      for (int i = 0; i < 3; ++i) {
        b.block(Mode::cut, 5 + i);
        go(width, i == 1 ? turn : 0);
      }
      b.block(Mode::cut, 200);
      for (int i = 0; i < 50; ++i) go(0.2, i % 2 ? turn : 0);
      const Contour given = b.finish(), path = blended(given, 0.02);
      ASSERT_EQ(path.blocks.size(), given.blocks.size());
      for (std::size_t k = 0; k < path.blocks.size(); ++k) {
        ASSERT_LT(path.blocks[k].first, path.blocks[k].last) << width << " block " << k;
        const Vec begin = path.path.at(path.path[path.blocks[k].first].s0()).value;
        EXPECT_LE(norm(begin - given.path.at(given.path[given.blocks[k].first].s0()).value), 0.02) << width << " " << k;
      }
    }
}

TEST(Blend, CornersThatDoNotFitAreRoundedLess) {
  // The spline's weights make it bend far more sharply near its begin than its derivatives there tell.
  ContourBuilder b(2, {0.45, -0.1, 0});
  b.block(Mode::position, unlimited);
  b.line({0.32, -0.21, 0});
  b.nurbs(3, {{0.32, -0.21, 0}, {0.17, -0.23, 0}, {0.31, -0.4, 0}, {0.36, -0.07, 0}}, {7.86, 3.21, 0.31, 2.22},
          {0, 0, 0, 0, 1, 1, 1, 1});
  Machine slow;
  slow.axes = {{"x", 100, 1000, unlimited}, {"y", 100, 1000, unlimited}};
  const Contour given = b.finish();
  Progress progress;
  const Path path = blend(given, {0.02}, slow, progress).path;
  EXPECT_EQ(path.size(), 3u);  // rounded all the same
  double worst = 0;
  for (int i = 0; i <= 2000; ++i) {
    double near = HUGE_VAL;
    for (int k = 0; k <= 2000; ++k)
      near = std::min(
          near, norm(path.at(path.length() * i / 2000).value - given.path.at(given.path.length() * k / 2000).value));
    worst = std::max(worst, near);
  }
  EXPECT_LE(worst, 0.02);
}

TEST(Blend, SameInputSameBits) {
  std::vector<Vec> points;
  for (int i = 0; i <= 300; ++i) points.push_back({0.1 * i, std::sin(0.03 * i) + 0.001 * (i % 3), 0});
  const Contour given = polyline(2, points, false, unlimited);
  const Contour a = blended(given, 0.01), b = blended(given, 0.01);
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    const Jet x = a.path[i].at_parameter(0.3), y = b.path[i].at_parameter(0.3);
    EXPECT_TRUE(x.value == y.value && x.d3 == y.d3) << i;
  }
}

TEST(Blend, RefusesMeaninglessTolerances) {
  const Contour given = polyline(2, {{}, {1, 0, 0}, {1, 1, 0}}, false, unlimited);
  for (const double tolerance : {0.0, -1.0, 1e-6, 1e4, std::nan("")}) {
    try {
      blended(given, tolerance);
      ADD_FAILURE() << tolerance;
    } catch (const InvalidInput& e) {
      ASSERT_EQ(e.faults.size(), 1u);
      EXPECT_EQ(e.faults[0].place, (std::vector<std::string>{"planning", "corner", "tolerance"}));
    }
  }
}

TEST(Blend, StopsWhenTold) {
  struct Impatient final : ProgressSink {
    int calls = 0;
    void report(std::string_view, double, std::string_view) override {
      if (++calls > 3) throw Stopped(StopReason::cancelled);
    }
  } progress;
  std::vector<Vec> points;
  for (int i = 0; i <= 20000; ++i) points.push_back({0.01 * i, std::sin(0.003 * i), 0});
  EXPECT_THROW(blend(polyline(2, points, false, unlimited), {0.001}, machine(), progress), Stopped);
}

}  // namespace
}  // namespace bahnwerk
