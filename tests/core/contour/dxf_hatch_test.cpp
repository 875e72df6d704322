// Outlines of HATCH: polylines with bulges, edges of every type, islands, blocks, object coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dxf_text.hpp"
#include "tests/core/contour/expect_near.hpp"

namespace bahnwerk {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

DxfText& hatch(DxfText& t, int paths) {
  return t.tag(0, "HATCH", 8, "0", 100, "AcDbHatch", 10, 0, 20, 0, 30, 0, 210, 0, 220, 0, 230, 1, 2, "SOLID", 70, 1, 71,
               0, 91, paths);
}
DxfText& behind(DxfText& t) { return t.tag(75, 0, 76, 1, 98, 1, 10, 5, 20, 5); }

template <class Fill>
Contour cut(Fill fill) {
  return read(fill, {.hatch = true});
}

TEST(DxfHatch, IsSkippedUnlessTheDocumentSaysSo) {
  const auto fill = [](DxfText& t) {
    t.line(0, 0, 5, 0);
    hatch(t, 1).tag(92, 3, 72, 0, 73, 1, 93, 3, 10, 10, 20, 0, 10, 13, 20, 0, 10, 13, 20, 4, 97, 0);
    behind(t);
  };
  const Contour skipped = read(fill);
  EXPECT_EQ(cut_length(skipped), 5);
  EXPECT_TRUE(noted(skipped, "skipped: HATCH is nothing to move along"));
  const Contour c = cut(fill);
  EXPECT_NEAR(cut_length(c), 5 + 12, 1e-12);
  EXPECT_EQ(cut_count(c), 2u);
  EXPECT_TRUE(c.notes.empty());
}

TEST(DxfHatch, PolylinePathsHaveBulges) {
  const Contour c = cut([](DxfText& t) {
    // A slot of 10 by 4 with round ends, and an island.
    hatch(t, 2).tag(92, 3, 72, 1, 73, 1, 93, 4, 10, 0, 20, 0, 42, 0, 10, 10, 20, 0, 42, 1);
    t.tag(10, 10, 20, 4, 42, 0, 10, 0, 20, 4, 42, 1, 97, 0);
    t.tag(92, 2, 72, 0, 73, 1, 93, 4, 10, 4, 20, 1, 10, 6, 20, 1, 10, 6, 20, 3, 10, 4, 20, 3, 97, 1, 330, "2F");
    behind(t);
  });
  EXPECT_NEAR(cut_length(c), 20 + 4 * pi + 8, 1e-12);
  EXPECT_EQ(cut_count(c), 2u);
}

TEST(DxfHatch, EdgesOfLinesAndArcsInBothSenses) {
  for (const bool clockwise : {false, true}) {
    const Contour c = cut([&](DxfText& t) {
      // A half disc of radius 3: the straight side, then the arc back. Clockwise angles are counted clockwise.
      hatch(t, 1).tag(92, 1, 93, 2, 72, 1);
      if (clockwise)
        t.tag(10, 3, 20, 0, 11, -3, 21, 0, 72, 2, 10, 0, 20, 0, 40, 3, 50, 180, 51, 360, 73, 0);
      else
        t.tag(10, -3, 20, 0, 11, 3, 21, 0, 72, 2, 10, 0, 20, 0, 40, 3, 50, 0, 51, 180, 73, 1);
      t.tag(97, 0);
      behind(t);
    });
    EXPECT_NEAR(cut_length(c), 6 + 3 * pi, 1e-12) << clockwise;
    ASSERT_EQ(c.path.size(), 2u) << clockwise;
    expect_near(c.path.at(6 + 1.5 * pi).value, {0, 3, 0}, 1e-12);
    EXPECT_EQ(c.blocks.size(), 1u);
  }
}

TEST(DxfHatch, AWholeCircleIsOneEdge) {
  const Contour c = cut([](DxfText& t) {
    hatch(t, 1).tag(92, 1, 93, 1, 72, 2, 10, 7, 20, 8, 40, 2, 50, 0, 51, 360, 73, 1, 97, 0);
    behind(t);
  });
  EXPECT_NEAR(cut_length(c), 4 * pi, 1e-12);
  expect_near(begin_of(c), {9, 8, 0});
}

TEST(DxfHatch, EllipsesByAngleOrByParameter) {
  // From (8, 0) to the point at parameter 60° of an ellipse of 8 by 2, closed through the centre.
  const double x = 8 * std::cos(pi / 3), y = 2 * std::sin(pi / 3);
  for (const double angle : {60.0, std::atan2(y, x) * 180 / pi}) {
    const Contour c = cut([&](DxfText& t) {
      hatch(t, 1).tag(92, 1, 93, 3, 72, 1, 10, 0, 20, 0, 11, 8, 21, 0);
      t.tag(72, 3, 10, 0, 20, 0, 11, 8, 21, 0, 40, 0.25, 50, 0, 51, angle, 73, 1);
      t.tag(72, 1, 10, x, 20, y, 11, 0, 21, 0, 97, 0);
      behind(t);
    });
    EXPECT_EQ(c.blocks.size(), 1u);
    EXPECT_FALSE(noted(c, "gap"));
    // Simpson's rule for the arc of the ellipse.
    double arc = 0;
    constexpr int n = 2000;
    for (int i = 0; i <= n; ++i) {
      const double u = pi / 3 * i / n, weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
      arc += weight * std::hypot(8 * std::sin(u), 2 * std::cos(u)) * (pi / 3) / (3 * n);
    }
    EXPECT_NEAR(cut_length(c), 8 + arc + std::hypot(x, y), 1e-9) << angle;
  }
}

TEST(DxfHatch, SplinesByControlPoints) {
  const Contour c = cut([](DxfText& t) {
    hatch(t, 1).tag(92, 1, 93, 2, 72, 4, 94, 2, 73, 1, 74, 0, 95, 6, 96, 3, 40, 0, 40, 0, 40, 0, 40, 1, 40, 1, 40, 1);
    // A quarter of a circle of radius 4.
    t.tag(10, 4, 20, 0, 42, 1, 10, 4, 20, 4, 42, std::sqrt(0.5), 10, 0, 20, 4, 42, 1, 97, 0);
    t.tag(72, 1, 10, 0, 20, 4, 11, 4, 21, 0, 97, 0);
    behind(t);
  });
  EXPECT_NEAR(cut_length(c), 2 * pi + std::sqrt(32), 1e-9);
  EXPECT_EQ(c.blocks.size(), 1u);
}

TEST(DxfHatch, IsReadInBlocksAndFromBelow) {
  DxfText text;
  text.unit(4).section("BLOCKS").tag(0, "BLOCK", 2, "B", 10, 0, 20, 0);
  hatch(text, 1).tag(92, 3, 72, 0, 73, 1, 93, 3, 10, 0, 20, 0, 10, 3, 20, 0, 10, 3, 20, 4, 97, 0);
  text.tag(0, "ENDBLK").end().section("ENTITIES").tag(0, "INSERT", 8, "0", 2, "B", 10, 100, 20, 0, 41, 2, 42, 2);
  text.end();
  EXPECT_NEAR(cut_length(read_dxf(text.eof(), {.hatch = true})), 24, 1e-12);
  const Contour below = cut([](DxfText& t) {
    t.tag(0, "HATCH", 8, "0", 10, 0, 20, 0, 30, 0, 210, 0, 220, 0, 230, -1, 91, 1);
    t.tag(92, 1, 93, 1, 72, 1, 10, 5, 20, 1, 11, 5, 21, 3, 97, 0);
  });
  expect_near(begin_of(below), {-5, 1, 0});
}

TEST(DxfHatch, Faults) {
  const auto one = [](auto... tags) {
    return faults(drawing([&](DxfText& t) { hatch(t, 1).tag(92, 1, 93, 1, tags...); }), {.hatch = true});
  };
  EXPECT_NE(one(72, 9, 10, 0).at(0).find("there is no edge of type 9"), std::string::npos);
  EXPECT_NE(one(72, 2, 40, -1).at(0).find("radius"), std::string::npos);
  EXPECT_NE(one(72, 3, 11, 1, 21, 0, 40, 0).at(0).find("ratio"), std::string::npos);
  EXPECT_NE(one(72, 4, 94, 3, 10, 1, 20, 1).at(0).find("SPLINE"), std::string::npos);
  EXPECT_NE(one(72, 1, 10, 1, 20, 1, 11, 1, 21, 1).at(0).find("nothing to move along"), std::string::npos);
}

}  // namespace
}  // namespace bahnwerk
