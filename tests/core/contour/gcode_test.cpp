#include "core/contour/gcode.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/base/progress.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Gcode, StraightMoves) {
  const Contour c = read_gcode("G21 G90 G0 X10 Y20\nG1 X40 F600\nY60\nG91 X-10 Y-10\nG90 X0 Y0");
  EXPECT_EQ(c.dimension, 2u);
  ASSERT_EQ(c.path.size(), 4u);
  expect_near(begin_of(c), {10, 20, 0}, 0);
  expect_near(end_of(c.path[0]), {40, 20, 0}, 0);
  expect_near(end_of(c.path[1]), {40, 60, 0}, 0);
  expect_near(end_of(c.path[2]), {30, 50, 0}, 0);
  expect_near(end_of(c), {0, 0, 0}, 0);
  EXPECT_EQ(c.path[2].source(), 4u);  // the line
}

TEST(Gcode, ArcsAboutACentre) {
  // A quarter, then three quarters the other way, both from (10, 0) about the origin.
  const Contour c = read_gcode("G0 X10 Y0\nG3 X0 Y10 I-10 J0\nG2 X-10 Y0 I0 J-10\nG3 X0 Y10 I10");
  ASSERT_EQ(c.path.size(), 3u);
  EXPECT_NEAR(c.path[0].length(), 10 * pi / 2, 1e-12);
  EXPECT_NEAR(c.path[1].length(), 10 * 3 * pi / 2, 1e-12);
  EXPECT_NEAR(c.path[2].length(), 10 * 3 * pi / 2, 1e-12);
  expect_near(arc_of(c.path[1]).centre(), {0, 0, 0});
  expect_joined(c);
}

TEST(Gcode, ArcsAcrossQuadrants) {
  // From 10° to 350° through all four quadrants; coordinates rounded as programs are.
  const Contour c = read_gcode("G0 X49.2404 Y8.6824\nG3 X49.2404 Y-8.6824 I-49.2404 J-8.6824 F100");
  EXPECT_NEAR(arc_of(c.path[0]).sweep(), 340 * pi / 180, 1e-5);
  EXPECT_NEAR(arc_of(c.path[0]).radius(), 50, 1e-4);
}

TEST(Gcode, FullCircles) {
  for (const char* text : {"G0 X10 Y0\nG2 I-10", "G0 X10 Y0\nG2 X10 Y0 I-10 J0", "G0 X10 Y0\nG91 G2 X0 Y0 I-10 J0",
                           "G0 X10 Y0\nG90.1 G2 I0 J0"}) {
    const Contour c = read_gcode(text);
    ASSERT_EQ(c.path.size(), 1u) << text;
    EXPECT_NEAR(arc_of(c.path[0]).sweep(), -2 * pi, 1e-12);
    expect_near(arc_of(c.path[0]).centre(), {0, 0, 0});
  }
}

TEST(Gcode, AbsoluteCentres) {
  const Contour c = read_gcode("G0 X110 Y50\nG90.1 G3 X100 Y60 I100 J50\nG91.1 X90 Y50 I0 J-10");
  expect_near(arc_of(c.path[0]).centre(), {100, 50, 0});
  expect_near(arc_of(c.path[1]).centre(), {100, 50, 0});
}

TEST(Gcode, ArcsByRadius) {
  struct {
    const char* text;
    double sweep;
    Vec centre;
  } const cases[] = {
      {"G3 X0 Y10 R10", pi / 2, {0, 0, 0}},
      {"G3 X0 Y10 R-10", 3 * pi / 2, {10, 10, 0}},
      {"G2 X0 Y10 R10", -pi / 2, {10, 10, 0}},
      {"G2 X0 Y10 R-10", -3 * pi / 2, {0, 0, 0}},
  };
  for (const auto& one : cases) {
    const Contour c = read_gcode(std::string("G0 X10 Y0\n") + one.text);
    EXPECT_NEAR(arc_of(c.path[0]).sweep(), one.sweep, 1e-12) << one.text;
    expect_near(arc_of(c.path[0]).centre(), one.centre);
    expect_near(end_of(c), {0, 10, 0});
  }
}

TEST(Gcode, ARadiusTooSmallByRoundingIsAHalfCircle) {
  // The diameter is 14.142135…: R 7.07 is 0.00107 mm too small.
  for (const char* text : {"G0 X10 Y0\nG3 X0 Y10 R7.07", "G0 X10 Y0\nG3 X0 Y10 R-7.07"}) {
    const Contour c = read_gcode(text);
    EXPECT_NEAR(arc_of(c.path[0]).radius(), std::sqrt(50.0), 1e-12);
    EXPECT_NEAR(arc_of(c.path[0]).sweep(), pi, 1e-9);
  }
  EXPECT_EQ(fault_lines("G0 X10 Y0\nG3 X0 Y10 R7.06"), (std::vector{2}));
}

TEST(Gcode, RoundedCentresMoveToTheBisector) {
  const Contour c = read_gcode("G0 X10 Y0\nG3 X0 Y10.008 I-10 J0");
  const Arc& arc = arc_of(c.path[0]);
  EXPECT_NEAR(norm(Vec{10, 0, 0} - arc.centre()), norm(Vec{0, 10.008, 0} - arc.centre()), 1e-12);
  expect_near(end_of(c), {0, 10.008, 0});
  EXPECT_EQ(fault_lines("G0 X10 Y0\nG3 X0 Y10.012 I-10 J0"), (std::vector{2}));
}

TEST(Gcode, InchesRoundMore) {
  // 0.0118 mm between the radii: too much in mm, within 0.0005 in.
  EXPECT_EQ(read_gcode("G20 G0 X.1 Y0\nG3 X0 Y.100465 I-.1 J0").path.size(), 1u);
  EXPECT_EQ(fault_lines("G20 G0 X.1 Y0\nG3 X0 Y.10052 I-.1 J0"), (std::vector{2}));
  EXPECT_EQ(fault_lines("G21 G0 X2.54 Y0\nG3 X0 Y2.5518 I-2.54 J0"), (std::vector{2}));
}

TEST(Gcode, LargeArcsRoundByAThousandthOfTheirRadius) {
  // A quarter of radius 40, its end 0.038 mm too far: 0.095 %.
  const Contour c = read_gcode("G0 X40 Y0\nG3 X0 Y40.038 I-40");
  EXPECT_NEAR(c.path.length(), 20.0095 * pi, 0.01);
  expect_near(end_of(c), {0, 40.038, 0});
  EXPECT_EQ(fault_lines("G0 X40 Y0\nG3 X0 Y40.042 I-40"), (std::vector{2}));
  // Half a millimetre is too much for any radius.
  EXPECT_EQ(read_gcode("G0 X900 Y0\nG3 X0 Y900.49 I-900").path.size(), 1u);
  EXPECT_EQ(fault_lines("G0 X900 Y0\nG3 X0 Y900.51 I-900"), (std::vector{2}));
  EXPECT_EQ(read_gcode("G20 G0 X90 Y0\nG3 X0 Y90.049 I-90").path.size(), 1u);
  EXPECT_EQ(fault_lines("G20 G0 X90 Y0\nG3 X0 Y90.051 I-90"), (std::vector{2}));
}

/// Largest distance of the contour's points from the spiral r(φ) between two radii about the centre, mm.
double off_the_spiral(const Contour& c, Vec centre, double begin, double end, double sweep) {
  double worst = 0, angle = 0;
  Vec last = begin_of(c) - centre;
  for (int i = 0; i <= 2000; ++i) {
    const Vec now = c.path.at(c.path.length() * i / 2000).value - centre;
    angle += std::atan2(cross(last, now).z, dot(last, now));
    last = now;
    worst = std::max(worst, std::abs(norm(now) - (begin + (end - begin) * angle / sweep)));
  }
  EXPECT_NEAR(angle, sweep, 1e-9);
  return worst;
}

TEST(Gcode, NearlyFullArcsWithRadiiThatDifferStayOnTheirSpiral) {
  // 340° about (0, 0), from radius 30 to 30.02: one arc through both ends would have its centre 0.06 mm away.
  const double a = 340 * pi / 180;
  char text[120];
  std::snprintf(text, sizeof text, "G0 X30 Y0\nG3 X%.12f Y%.12f I-30", 30.02 * std::cos(a), 30.02 * std::sin(a));
  const Contour c = read_gcode(text);
  ASSERT_EQ(c.path.size(), 2u);
  EXPECT_LT(off_the_spiral(c, {}, 30, 30.02, a), 0.01);
  EXPECT_NEAR(c.path.length(), 30.01 * a, 1e-4);
  const Vec out = arc_of(c.path[0]).at(1).d1, in = arc_of(c.path[1]).at(0).d1;
  EXPECT_LT(norm(cross(out, in)) / (norm(out) * norm(in)), 1e-12);  // one tangent where they meet
  // As small as those that arcs fitted to chords leave.
  const Contour small = read_gcode("G0 X5 Y5\nG1 X5.02 F60\nG2 X5.026 Y4.995 I0.01 J0.004");
  const double r = std::hypot(0.01, 0.004), s = std::hypot(0.004, 0.009);
  const double turned = 2 * pi - std::atan2(-0.009, -0.004) + std::atan2(-0.004, -0.01);
  EXPECT_NEAR(small.path.length() - 0.02, 0.5 * (r + s) * turned, 1e-9);
  EXPECT_EQ(end_of(small).x, 5.026);
}

TEST(Gcode, Helices) {
  const Contour c = read_gcode("G0 X10 Y0 Z0\nG3 X0 Y10 Z5 I-10 J0\nG2 X0 Y10 Z-1 J-10");
  EXPECT_EQ(c.dimension, 3u);
  EXPECT_NEAR(c.path[0].length(), std::hypot(5 * pi, 5), 1e-12);
  EXPECT_NEAR(c.path[1].length(), std::hypot(20 * pi, 6), 1e-12);
  EXPECT_NEAR(arc_of(c.path[1]).rise(), -6, 1e-12);
  expect_near(end_of(c), {0, 10, -1});
}

TEST(Gcode, HelicesOfManyTurns) {
  // P3: two whole turns and the quarter; the height grows evenly with the angle.
  const Contour c = read_gcode("G0 X10 Y0 Z0\nG3 X0 Y10 Z9 I-10 J0 P3");
  ASSERT_EQ(c.path.size(), 3u);
  EXPECT_NEAR(c.path.length(), std::hypot(10 * 2.25 * 2 * pi, 9), 1e-11);
  expect_near(end_of(c.path[0]), {10, 0, 4}, 1e-12);
  expect_near(end_of(c.path[1]), {10, 0, 8}, 1e-12);
  expect_near(end_of(c), {0, 10, 9}, 1e-12);

  const Contour circles = read_gcode("G0 X10 Y0 Z1\nG2 I-10 Z7 P3");
  ASSERT_EQ(circles.path.size(), 3u);
  EXPECT_NEAR(circles.path.length(), std::hypot(10 * 3 * 2 * pi, 6), 1e-11);
  expect_near(end_of(circles), {10, 0, 7}, 1e-12);
  for (const char* turns : {"P0", "P1.5", "P1000000000", "P2000"})
    EXPECT_EQ(fault_lines(std::string("G0 X10 Y0\nG2 I-10 ") + turns), (std::vector{2})) << turns;
}

TEST(Gcode, OtherPlanes) {
  // Seen against the normal of the plane G3 turns from its first axis to its second: Z to X in G18, Y to Z in G19.
  const Contour zx = read_gcode("G0 X0 Y0 Z10\nG18 G3 X10 Z0 I0 K-10\nG2 X0 Z10 R10");
  EXPECT_EQ(zx.dimension, 3u);
  EXPECT_NEAR(zx.path[0].length(), 5 * pi, 1e-12);
  expect_near(arc_of(zx.path[0]).centre(), {0, 0, 0});
  EXPECT_NEAR(zx.path[1].length(), 5 * pi, 1e-12);
  expect_near(arc_of(zx.path[1]).centre(), {0, 0, 0});

  const Contour yz = read_gcode("G0 X0 Y10 Z0\nG19 G3 Y0 Z10 J-10 K0\nG3 X4 Y-10 Z0 J0 K-10");
  EXPECT_NEAR(yz.path[0].length(), 5 * pi, 1e-12);
  EXPECT_NEAR(yz.path[1].length(), std::hypot(5 * pi, 4), 1e-12);
  expect_near(end_of(yz), {4, -10, 0});
}

Vec bezier(const std::vector<Vec>& p, double u) {
  const double w = 1 - u;
  if (p.size() == 3) return w * w * p[0] + 2 * w * u * p[1] + u * u * p[2];
  return w * w * w * p[0] + 3 * w * w * u * p[1] + 3 * w * u * u * p[2] + u * u * u * p[3];
}

TEST(Gcode, CubicSplines) {
  const Contour c = read_gcode("G0 X1 Y2\nF60 G5 I0 J3 P0 Q-3 X4 Y2\nP-5 Q3 X9 Y4\nG1 X20");
  ASSERT_EQ(c.path.size(), 3u);
  const std::vector<Vec> first{{1, 2, 0}, {1, 5, 0}, {4, -1, 0}, {4, 2, 0}};
  const std::vector<Vec> second{{4, 2, 0}, {4, 5, 0}, {4, 7, 0}, {9, 4, 0}};  // goes on as the first one ended
  for (double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    expect_near(c.path[0].curve().at(u).value, bezier(first, u));
    expect_near(c.path[1].curve().at(u).value, bezier(second, u));
  }
  expect_joined(c);
  EXPECT_TRUE(c.notes.empty()) << c.notes.front();
}

TEST(Gcode, QuadraticSplines) {
  const Contour c = read_gcode("G20 G0 X-2 Y4\nG5.1 X2 I2 J-8\nG91 X1 Y1 I1");
  const std::vector<Vec> first{25.4 * Vec{-2, 4, 0}, 25.4 * Vec{0, -4, 0}, 25.4 * Vec{2, 4, 0}};
  const std::vector<Vec> second{25.4 * Vec{2, 4, 0}, 25.4 * Vec{3, 4, 0}, 25.4 * Vec{3, 5, 0}};
  for (double u : {0.0, 0.3, 0.7, 1.0}) {
    expect_near(c.path[0].curve().at(u).value, bezier(first, u));
    expect_near(c.path[1].curve().at(u).value, bezier(second, u));
  }
}

TEST(Gcode, SplinesAtAHeight) {
  const Contour c = read_gcode("G0 X0 Y0 Z5\nG1 Z3\nG5 I0 J3 P0 Q-3 X4 Y2\nG5.1 X8 I2 J1");
  EXPECT_EQ(c.dimension, 3u);
  EXPECT_NEAR(c.path[1].curve().at(0.4).value.z, 3, 1e-15);
  expect_near(end_of(c), {8, 2, 3});
}

TEST(Gcode, UnitsMayChangeInTheMiddle) {
  const Contour c = read_gcode("G21 G0 X10 Y0\nG1 X25.4 F600\nG20 X2\nF10 X3\nG21 G91 X1\nG20 X1");
  ASSERT_EQ(c.path.size(), 5u);
  expect_near(end_of(c.path[0]), {25.4, 0, 0});
  expect_near(end_of(c.path[1]), {50.8, 0, 0});
  expect_near(end_of(c.path[2]), {76.2, 0, 0});
  expect_near(end_of(c.path[3]), {77.2, 0, 0});
  expect_near(end_of(c.path[4]), {102.6, 0, 0});
  const auto feeds = c.feeds();
  EXPECT_EQ(feeds[0], 10);
  EXPECT_EQ(feeds[1], 10);  // the same speed, whatever the units are now
  EXPECT_NEAR(feeds[2], 254.0 / 60, 1e-14);
  EXPECT_EQ(read_gcode("G1 X2", {.inch = true}).path.length(), 50.8);
}

TEST(Gcode, OneHeightIsAPlanarContour) {
  const Contour c = read_gcode("G0 X10 Y0 Z5\nG1 X20\nZ5 X30\nG2 X40 I5\nG5 I1 J1 P1 Q1 X50 Y10\n");
  EXPECT_EQ(c.dimension, 2u);
  for (std::size_t i = 0; i < c.path.size(); ++i) {
    EXPECT_EQ(begin_of(c.path[i]).z, 0);
    EXPECT_EQ(end_of(c.path[i]).z, 0);
  }
  EXPECT_EQ(read_gcode("G0 X10 Y0 Z5\nG1 X20\nZ4.9").dimension, 3u);
  EXPECT_EQ(begin_of(read_gcode("G0 X10 Y0 Z5\nG1 X20\nZ4.9")).z, 5);
}

TEST(Gcode, ContourStartsWhereTheFirstWordsSay) {
  expect_near(begin_of(read_gcode("G0 X10 Y20\nG1 X0")), {10, 20, 0}, 0);
  expect_near(begin_of(read_gcode("G0 X10 Y20 Z3\nG1 Z0")), {10, 20, 3}, 0);
  expect_near(begin_of(read_gcode("G0 X10\nG1 Y5")), {0, 0, 0}, 0);
  expect_near(begin_of(read_gcode("G1 X10 Y20")), {0, 0, 0}, 0);
  expect_near(begin_of(read_gcode("G91 G0 X10 Y20\nG1 X5")), {0, 0, 0}, 0);
  EXPECT_NEAR(read_gcode("G91 G0 X3 Y4\nG1 X3 Y4").path.length(), 10, 1e-12);
}

TEST(Gcode, RepeatedPlacesAreNoMoves) {
  const Contour c = read_gcode("G0 X1 Y1 F60\nG1 X1 Y1\nX5\nX5 Y1\nG0 X5\nG1 Y9");
  EXPECT_EQ(c.path.size(), 2u);
  EXPECT_EQ(c.blocks.size(), 1u);
  EXPECT_TRUE(c.notes.empty());
  const Contour tiny = read_gcode("G0 X1 Y1 F60\nG1 X1.0000001\nX5");
  ASSERT_EQ(tiny.notes.size(), 1u);
  EXPECT_EQ(tiny.notes[0].rfind("line 2: ", 0), 0u);
}

TEST(Gcode, ProgressMayStopIt) {
  struct Stop final : ProgressSink {
    int left = 3;
    void report(std::string_view, double, std::string_view) override {
      if (--left == 0) throw Stopped(StopReason::cancelled);
    }
  } stop;
  std::string text = "G1\n";
  for (int i = 0; i < 10'000; ++i) text.append("X").append(std::to_string(i)).append(1, '\n');
  EXPECT_THROW(read_gcode(text, {}, stop), Stopped);
}

}  // namespace
}  // namespace bahnwerk
