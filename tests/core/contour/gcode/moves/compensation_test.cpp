// Cutter radius compensation: where the cutter's centre goes, and what it refuses.
#include "core/contour/gcode/moves/compensation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numeric/random.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

GcodeOptions with_radius(double r) {
  GcodeOptions options;
  options.cutter_radius[1] = r;
  return options;
}
Contour compensated(const std::string& text, double r) { return read_gcode(text, with_radius(r)); }
std::vector<int> refused(const std::string& text, double r) { return fault_lines(text, with_radius(r)); }

double rounded(double x) { return std::abs(x) < 1e-9 ? 0 : x; }

/// Ends of the segments, "x y; …", arcs with their radius.
std::string shape(const Contour& c) {
  std::string text;
  char one[80];
  for (std::size_t i = 0; i < c.path.size(); ++i) {
    const Vec p = end_of(c.path[i]);
    std::snprintf(one, sizeof one, "%s%.4g %.4g", i == 0 ? "" : "; ", rounded(p.x), rounded(p.y));
    text += one;
    if (c.path[i].curve().kind() != CurveKind::arc) continue;
    std::snprintf(one, sizeof one, " r%.4g", arc_of(c.path[i]).radius());
    text += one;
  }
  return text;
}

/// A move of the program, to measure distances from.
struct Wall {
  Vec from, to, centre;
  double sense = 0, radius = 0, sweep = 0;  // 0: a line

  double distance(Vec p) const {
    if (sense == 0) {
      const Vec u = to - from;
      const double at = std::clamp(dot(p - from, u) / dot(u, u), 0.0, 1.0);
      return norm(p - from - at * u);
    }
    double angle =
        sense * (std::atan2(p.y - centre.y, p.x - centre.x) - std::atan2(from.y - centre.y, from.x - centre.x));
    angle = std::fmod(angle + 4 * pi, 2 * pi);
    if (angle <= sweep) return std::abs(norm(p - centre) - radius);
    return std::min(norm(p - from), norm(p - to));
  }
};

std::string word(Vec to, const Wall& wall) {
  char text[200];
  if (wall.sense == 0)
    std::snprintf(text, sizeof text, "G1 X%.9f Y%.9f\n", to.x, to.y);
  else
    std::snprintf(text, sizeof text, "G%d X%.9f Y%.9f I%.9f J%.9f\n", wall.sense > 0 ? 3 : 2, to.x, to.y,
                  wall.centre.x - wall.from.x, wall.centre.y - wall.from.y);
  return text;
}

/// Samples of the segments that belong to the lines from first to last.
template <class Visit>
void samples(const Contour& c, std::size_t first, std::size_t last, Visit visit) {
  for (std::size_t i = 0; i < c.path.size(); ++i) {
    if (c.path[i].source() < first || c.path[i].source() > last) continue;
    for (int k = 0; k <= 16; ++k) {
      const Curve& curve = c.path[i].curve();
      visit(curve.at(curve.begin() + (curve.end() - curve.begin()) * k / 16).value, c.path[i].source());
    }
  }
}

TEST(GcodeCompensation, OutsideCornersAreRounded) {
  // A square from outside, clockwise with the cutter on its left; in and out beside its first side.
  EXPECT_EQ(shape(compensated("G0 X-10 Y-5\nG41 D1 G1 X0 Y0\nY20\nX20\nY0\nX0\nG40 X-10", 2)),
            "-2 0; -2 20; 0 22 r2; 20 22; 22 20 r2; 22 0; 20 -2 r2; 0 -2; -0.4 -1.96 r2; -10 0");
}

TEST(GcodeCompensation, InsideCornersAreTrimmed) {
  EXPECT_EQ(shape(compensated("G0 X10 Y10\nG41 D1 G1 Y0\nX20\nY20\nX0\nY0\nX10\nG40 Y10", 2)),
            "10 2; 18 2; 18 18; 2 18; 2 2; 10 2; 10 10");
  // Lines to arcs and back; bulging out, the corners are outside ones.
  const std::string in = "G0 X0 Y0\nG41 D1 G1 Y-5\nX10\n", out = "X0\nG40 Y0";
  const Contour c = compensated(in + "G3 Y5 I-3 J5\nG1 X-10\nG3 Y-5 I3 J-5\nG1 " + out, 1);
  expect_joined(c);
  ASSERT_EQ(c.path.size(), 7u);
  EXPECT_NEAR(arc_of(c.path[2]).radius(), std::sqrt(34) - 1, 1e-12);
  EXPECT_EQ(end_of(c.path[1]).y, -4);
  EXPECT_NEAR(norm(end_of(c.path[1]) - Vec{7, 0, 0}), std::sqrt(34) - 1, 1e-12);
  EXPECT_EQ(compensated(in + "G3 Y5 I3 J5\nG1 X-10\nG3 Y-5 I-3 J-5\nG1 " + out, 1).path.size(), 11u);
  // Arc to arc: inside the lens of two circles of radius 10 about (-6, 0) and (6, 0), which meet at (0, 8).
  const Contour lens = compensated("G0 X0 Y0\nG41 D1 G1 X4\nG3 X0 Y8 I-10\nX-4 Y0 I6 J-8", 2);
  ASSERT_EQ(lens.path.size(), 3u);
  expect_near(end_of(lens.path[1]), {0, std::sqrt(28), 0}, 1e-12);
}

TEST(GcodeCompensation, Arcs) {
  EXPECT_EQ(shape(compensated("G0 X0 Y0\nG41 D1 G1 X10\nG3 I-10\nG40 G1 X0", 3)), "7 0; 7 0 r7; 0 0");
  EXPECT_EQ(shape(compensated("G0 X0 Y0\nG42 D1 G1 X10\nG2 I-10\nG40 G1 X0", 3)), "7 0; 7 0 r7; 0 0");
  EXPECT_EQ(shape(compensated("G0 X30 Y0\nG41 D1 G1 X10\nG2 I-10\nG40 G1 X30", 3)), "13 0; 13 0 r13; 30 0");
  // A fillet as wide as the cutter: it turns on the spot.
  EXPECT_EQ(shape(compensated("G0 X5 Y5\nG41 D1 G1 Y0\nX7\nG3 X10 Y3 J3\nG1 Y10\nX5\nG40 Y5", 3)),
            "5 3; 7 3; 7 7; 5 7; 5 5");
  // Helices keep their height.
  const Contour helix = compensated("G0 X0 Y0 Z0\nG41 D1 G1 X10\nG3 I-10 Z6 P3\nG40 G1 X0", 3);
  EXPECT_NEAR(helix.path.length(), 7 + std::hypot(6 * pi * 7, 6) + 7, 1e-9);
  expect_near(end_of(helix), {0, 0, 6}, 1e-12);
}

TEST(GcodeCompensation, RadiusComesFromTheWordDOrTheTool) {
  GcodeOptions options;
  options.cutter_radius = {{1, 2.0}, {2, -2.0}, {7, 2.0}, {8, 0.0}};
  const auto way = [&](const std::string& words) {
    return shape(read_gcode("G0 X-10 Y0\n" + words + "\nG1 X0 Y0\nY20\nG40 X-10", options));
  };
  const std::string left = "-2 0; -2 20; -10 20", on = "0 0; 0 20; -10 20";
  for (const char* words :
       {"G41 D1", "G42 D2", "G41 D07", "T7 M6\nG41", "G41.1 D4", "G20 G41.1 D[4/25.4]\nG21", "G42.1 D-4"})
    EXPECT_EQ(way(words), left) << words;
  for (const char* words : {"G41 D0", "G41 D8", "G42 D8", "G40", "G41.1 D0"}) EXPECT_EQ(way(words), on) << words;
}

TEST(GcodeCompensation, LeadsInAndOutRoundTheContour) {
  // Along the first side's own line: the corner is not touched.
  const Contour c = compensated("G0 X-5 Y0\nG41 D1 G1 X0\nX20\nG40 X25", 3);
  EXPECT_EQ(shape(c), "-1.8 2.4; 0 3 r3; 20 3; 21.8 2.4 r3; 25 0");
  samples(c, 1, 9, [](Vec p, std::size_t) { EXPECT_GT(p.y >= 0 && p.x > 0 && p.x < 20 ? p.y : 3.0, 3 - 1e-9); });
}

TEST(GcodeCompensation, LeadsInAlongAnArc) {
  // It ends beside its end, in its direction; the next joint is like any other.
  EXPECT_EQ(shape(compensated("G0 X0 Y0\nG41 D1 G3 X20 R10\nG1 Y9", 2)), "18 0 r9; 18 9");
  EXPECT_EQ(shape(compensated("G0 X0 Y0\nG42 D1 G3 X20 R10\nG1 X0 Y0", 2)), "22 0 r11; 20 2 r2; 0 2");
  // In and out of a hole; behind G40 the head goes to where it should be, even if that has no other coordinates.
  const Contour c = compensated("G0 X0 Y0 Z0\nG41 D1 G3 X10 Y0 R5\nI-10\nX0 Y0 R5\nG0 Z5\nG40\nG0 X0 Y0", 2);
  EXPECT_EQ(shape(c), "8 0 r4; 8 0 r8; 2 0 r3; 2 0; 0 0");
  expect_joined(c);
}

TEST(GcodeCompensation, LeadsAreStraightAtAnotherHeight) {
  // Too short and from the wrong side, but above the work.
  EXPECT_EQ(shape(compensated("G0 X0 Y1 Z5\nG41 D1 G1 X0 Y0\nZ0\nX20\nZ5\nG40 X20 Y-1", 3)),
            "0 3; 0 3; 20 3; 20 3; 20 -1");
}

TEST(GcodeCompensation, EventsHappenBetweenTheirMoves) {
  // Depth by depth, a dwell, and the switch.
  const Contour c =
      compensated("F60 G0 X-10 Y0 Z5\nG41 D1 G1 X0\nG1 Z0\nM3\nY20\nZ-1\nG4 P2\nX20\nM5\nG40 Y40\nG0 Z5", 2);
  expect_joined(c);
  EXPECT_EQ(shape(c), "-2 0; -2 0; -2 20; -2 20; 0 22 r2; 20 22; 20 40; 20 40");
  ASSERT_EQ(c.rests.size(), 1u);
  EXPECT_EQ(c.rests[0].segment, 4u);
  EXPECT_EQ(c.blocks.front().mode, Mode::position);
  EXPECT_EQ(c.blocks[1].mode, Mode::cut);
  EXPECT_EQ(c.blocks[1].first, 2u);
  // Behind G40 it stays where it is until it leads out.
  EXPECT_EQ(shape(compensated("G0 X-10 Y0 Z0\nG41 D1 G1 X0\nY20\nG40\nG0 Z5\nX-10", 2)), "-2 0; -2 20; -2 20; -10 20");
  // It may be on before anything moves.
  EXPECT_EQ(shape(compensated("G41 D1\nG0 X-10 Y0\nG1 X0\nG91 Y20\nG40 X-10", 2)), "-2 0; -2 20; -10 20");
  // The program may end with it.
  EXPECT_EQ(shape(compensated("G0 X-10 Y0\nG41 D1 G1 X0\nY20\nM2", 2)), "-2 0; -2 20");
  EXPECT_EQ(shape(compensated("G0 X-10 Y0\nG41 D1 G1 X0\nM2", 2)), "0 0");
  EXPECT_EQ(shape(compensated("G0 X-10 Y0\nG41 D1\nG40\nG1 X0", 2)), "0 0");
}

TEST(GcodeCompensation, BlocksKeepTheirFeeds) {
  const Contour c = compensated("F60 G0 X-10 Y0\nG41 D1 G1 X0\nY20 F120\nG0 X20\nG1 Y0 F60\nG40 X40 F240", 2);
  ASSERT_EQ(c.blocks.size(), 5u);
  const double feeds[] = {1, 2, INFINITY, 1, 4};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(c.blocks[i].feed, feeds[i]) << i;
  EXPECT_EQ(c.blocks[2].mode, Mode::position);
}

TEST(GcodeCompensation, GougesAreRefused) {
  const std::string in = "G0 X0 Y0\nG41 D1 G1 X0 Y-10\n";
  EXPECT_EQ(refused(in + "X5\nG3 X8 Y-7 J3\nG1 Y0\nG40 X0", 3.01), (std::vector{4}));  // a narrow arc
  EXPECT_EQ(refused(in + "X5\nX6 Y-9\nY0\nG40 X0", 3), (std::vector{5}));              // a short side
  EXPECT_EQ(refused(in + "X5\nX1 Y-9\nG40 X0 Y0", 3), (std::vector{4}));               // a sharp corner
  EXPECT_EQ(refused("G0 X5 Y5\nG41 D1 G1 X0 Y0\nX10\nY10\nX0\nY0\nG40 X5 Y5", 1),
            (std::vector{6}));                                                        // closed in a corner
  EXPECT_EQ(refused("G0 X0 Y0\nG41 D1 G1 Y-2\nX5\nG40 Y0", 3), (std::vector{2, 4}));  // leads in and out too short
  EXPECT_EQ(refused("G0 X10 Y1\nG41 D1 G1 X0 Y0\nX20\nG40 X10 Y1", 3), (std::vector{2, 4}));  // from the wrong side
}

TEST(GcodeCompensation, GougesAndMissingRadiiAreRefused) {
  const std::string on = "G0 X-10 Y0\nG41 D1 G1 X0\nY20\n", off = "\nG40 X-10 Y40";
  for (const char* word : {"G18", "G55 Y30", "G92 X0 Y0", "G52 X5", "G28 Z0", "G53 X0", "G81 X5 R1 Z-1",
                           "G5 X5 I1 J1 P1 Q1", "G42 D1", "G41 D2", "G41.1 D5", "G10 L2 P1 X1"})
    EXPECT_EQ(refused(on + word + off, 2), (std::vector{4})) << word;
  for (const char* word : {"G41 D1", "G41 D1 Y30", "G17", "G54 G17", "G20", "G91", "G64"}) {
    const bool origin = std::string(word).rfind("G54", 0) == 0;
    EXPECT_EQ(refused(on + word + off, 2), origin ? (std::vector{4}) : std::vector<int>{}) << word;
  }
  EXPECT_EQ(refused("G0 X0 Y0\nG41 D2 G1 X5", 2), (std::vector{2}));
  EXPECT_EQ(refused("G0 X0 Y0\nG41 G1 X5", 2), (std::vector{2}));
  EXPECT_EQ(refused("G0 X0 Y0\nG41.1 G1 X5", 2), (std::vector{2}));
  EXPECT_EQ(refused("G0 X0 Y0\nG18 G41 D1 G1 X5", 2), (std::vector{2}));
  EXPECT_EQ(refused("G0 X0 Y0\nG41 D1 G3 X10 Y10 R10\nG1 Y19", 12), (std::vector{2}));  // no arc ends there
  EXPECT_EQ(refused("G0 X-9 Y0\nG41 D1 G1 X0\nY9\nG40\nG5 X-9 I1 J1 P1 Q1", 2), (std::vector{5}));
  EXPECT_EQ(refused("G0 X-9 Y0\nG41 D1 G1 X0\nY9\nG40 G2 X-9 R9", 2), (std::vector{4}));
}

/// A convex polygon round the origin, clockwise.
std::vector<Vec> convex(Random& random) {
  std::vector<double> angles;
  const std::size_t n = 3 + random.below(9);
  for (std::size_t i = 0; i < n; ++i)
    angles.push_back(-2 * pi * (static_cast<double>(i) + random.uniform(0.1, 0.9)) / static_cast<double>(n));
  std::vector<Vec> points;
  for (double a : angles) points.push_back({30 * std::cos(a), 30 * std::sin(a), 0});
  return points;
}

// What would lead in is no arc: a fault, and what comes behind it is read on.
TEST(GcodeCompensation, AnImpossibleArcThatLeadsIn) {
  EXPECT_EQ(refused("G0 X0 Y0\nG41 D1\nG2 X10 Y0 I3 J0 F100\nG1 X20\nY20\nG40 X40\n", 2), std::vector<int>{3});
  EXPECT_EQ(refused("G0 X0 Y0\nG41 D1\nG2 X10 Y0 I3 J0 F100\nG3 X20 Y0 I1 J7\nG1 Y20\nG40 X40\n", 2),
            (std::vector<int>{3}));
}

TEST(GcodeCompensation, RoundAConvexPolygonEverywhereTheRadius) {
  Random random(21);
  for (int run = 0; run < 300; ++run) {
    const auto points = convex(random);
    const double r = random.uniform(0.1, 20);
    const bool mirrored = random.chance(0.5);  // counter-clockwise with G42
    const auto place = [&](Vec p) { return mirrored ? Vec{p.x, -p.y, 0} : p; };
    std::vector<Wall> walls;
    for (std::size_t i = 0; i < points.size(); ++i)
      walls.push_back({place(points[i]), place(points[(i + 1) % points.size()]), {}});
    const Vec far = place(4 * points[0]);
    std::string text = word(far, {}).replace(0, 2, "G0") + (mirrored ? "G42 D1 " : "G41 D1 ") + word(walls[0].from, {});
    for (const Wall& wall : walls) text += word(wall.to, wall);
    text += "G40 " + word(far, {});
    const Contour c = compensated(text, r);
    expect_joined(c);
    double turned = 0;
    samples(c, 3, 2 + walls.size(), [&](Vec p, std::size_t) {
      double nearest = 1e9;
      for (const Wall& wall : walls) nearest = std::min(nearest, wall.distance(p));
      ASSERT_NEAR(nearest, r, 1e-8) << text;
    });
    for (std::size_t i = 0; i < c.path.size(); ++i)
      if (c.path[i].curve().kind() == CurveKind::arc) turned += std::abs(arc_of(c.path[i]).sweep());
    EXPECT_LT(turned, 2 * pi + 1e-6);
    // The lead-in and the lead-out touch nothing either.
    samples(c, 2, 3 + walls.size(), [&](Vec p, std::size_t) {
      for (const Wall& wall : walls) ASSERT_GT(wall.distance(p), r - 1e-8) << text;
    });
  }
}

TEST(GcodeCompensation, InsideAConvexPolygonItIsTrimmed) {
  Random random(22);
  int done = 0;
  for (int run = 0; run < 600; ++run) {
    auto points = convex(random);
    std::reverse(points.begin(), points.end());  // counter-clockwise: the inside is on the left
    const double r = random.uniform(0.1, 3);
    const Vec begin = 0.5 * (points[0] + points[1]);
    points.erase(points.begin());
    points.insert(points.begin(), begin);
    points.push_back(Vec{2 * begin.x - points[1].x, 2 * begin.y - points[1].y, 0});
    std::vector<Wall> walls;
    for (std::size_t i = 0; i < points.size(); ++i) walls.push_back({points[i], points[(i + 1) % points.size()], {}});
    const Vec side = (walls[0].to - walls[0].from) / norm(walls[0].to - walls[0].from);
    const Vec in = begin + 1.001 * r * Vec{-side.y, side.x, 0};
    std::string text = word(in, {}).replace(0, 2, "G0") + "G41 D1 " + word(begin, {});
    for (const Wall& wall : walls) text += word(wall.to, wall);
    text += "G40 " + word(in, {});
    if (!refused(text, r).empty()) continue;
    ++done;
    const Contour c = compensated(text, r);
    expect_joined(c);
    samples(c, 3, 2 + walls.size(), [&](Vec p, std::size_t line) {
      ASSERT_NEAR(walls[line - 3].distance(p), r, 1e-8) << text;
      for (const Wall& wall : walls) ASSERT_GT(wall.distance(p), r - 1e-8) << text;
    });
  }
  EXPECT_GT(done, 300);
}

TEST(GcodeCompensation, CutterTouchesNoNeighbourOnRandomPaths) {
  // Lines and arcs with corners of every kind: what is not refused keeps the radius from the move and its neighbours.
  Random random(23);
  int done = 0;
  for (int run = 0; run < 3000; ++run) {
    const double r = random.uniform(0.05, 0.5), side = random.chance(0.5) ? 1 : -1;
    std::vector<Wall> walls;
    Vec at{0, 0, 0};
    double heading = random.uniform(-pi, pi);
    const double first_heading = heading;
    for (int i = 0; i < 6; ++i) {
      Wall wall;
      wall.from = at;
      const Vec u{std::cos(heading), std::sin(heading), 0};
      if (random.chance(0.5)) {
        wall.to = at + random.uniform(5, 40) * u;
      } else {
        wall.sense = random.chance(0.5) ? 1 : -1;
        wall.radius = random.uniform(3, 30);
        wall.sweep = random.uniform(0.2, 1.5);
        wall.centre = at + wall.sense * wall.radius * Vec{-u.y, u.x, 0};
        const double a = std::atan2(at.y - wall.centre.y, at.x - wall.centre.x) + wall.sense * wall.sweep;
        wall.to = wall.centre + wall.radius * Vec{std::cos(a), std::sin(a), 0};
        heading += wall.sense * wall.sweep;
      }
      at = wall.to;
      walls.push_back(wall);
      heading += random.chance(0.3) ? 0 : random.chance(0.2) ? random.uniform(-1e-3, 1e-3) : random.uniform(-2, 2);
    }
    const Vec out = side * Vec{-std::sin(first_heading), std::cos(first_heading), 0};
    std::string text =
        word(10 * out, {}).replace(0, 2, "G0") + (side > 0 ? "G41 D1 " : "G42 D1 ") + word({0, 0, 0}, {});
    for (const Wall& wall : walls) text += word(wall.to, wall);
    if (!refused(text, r).empty()) continue;
    ++done;
    const Contour c = compensated(text, r);
    expect_joined(c);
    samples(c, 3, 2 + walls.size(), [&](Vec p, std::size_t line) {
      const std::size_t i = line - 3;
      ASSERT_LT(walls[i].distance(p), r + 1e-6) << text;
      for (std::size_t k = i == 0 ? 0 : i - 1; k <= std::min(i + 1, walls.size() - 1); ++k) {
        // Elsewhere the program may cross itself.
        if (k != i && norm(p - (k < i ? walls[i].from : walls[i].to)) > 4 * r) continue;
        ASSERT_GT(walls[k].distance(p), r - 1e-6) << text << "r " << r << " line " << line << " wall " << k;
      }
    });
  }
  EXPECT_GT(done, 500);
}

TEST(GcodeCompensation, ThereAndBack) {
  // The cutter's way round a closed contour is that of the contour in the other direction on the other side.
  Random random(24);
  for (int run = 0; run < 100; ++run) {
    const auto points = convex(random);
    const double r = random.uniform(0.1, 5);
    const auto text = [&](bool back) {
      std::string t =
          word(4 * points[0], {}).replace(0, 2, "G0") + (back ? "G42 D1 " : "G41 D1 ") + word(points[0], {});
      for (std::size_t i = 1; i <= points.size(); ++i)
        t += word(points[(back ? points.size() - i : i) % points.size()], {});
      return t + "G40 " + word(4 * points[0], {});
    };
    const Contour there = compensated(text(false), r), back = compensated(text(true), r);
    ASSERT_EQ(there.path.size(), back.path.size());
    const std::size_t n = there.path.size();
    for (std::size_t i = 0; i < n; ++i) {
      expect_near(begin_of(there.path[i]), end_of(back.path[n - 1 - i]), 1e-7);
      ASSERT_NEAR(there.path[i].length(), back.path[n - 1 - i].length(), 1e-7);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
