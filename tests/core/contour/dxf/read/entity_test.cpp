#include "core/contour/dxf/read/entity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/core/contour/dxf_text.hpp"
#include "tests/core/contour/expect_near.hpp"

namespace bahnwerk {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

TEST(DxfEntity, Line) {
  const Contour c = read([](DxfText& t) { t.line(1, 2, 4, 6); });
  EXPECT_EQ(c.dimension, 2u);
  ASSERT_EQ(c.path.size(), 1u);
  EXPECT_NEAR(c.path.length(), 5, 1e-15);
  expect_near(begin_of(c), {1, 2, 0});
  expect_near(end_of(c), {4, 6, 0});
  EXPECT_TRUE(c.notes.empty());
}

TEST(DxfEntity, ArcRunsCounterClockwiseAcrossZeroDegrees) {
  const Contour c = read([](DxfText& t) { t.arc(10, 20, 5, 270, 90); });
  EXPECT_NEAR(c.path.length(), 5 * pi, 1e-12);
  expect_near(begin_of(c), {10, 15, 0});
  expect_near(c.path.at(2.5 * pi).value, {15, 20, 0});
  expect_near(end_of(c), {10, 25, 0});
  EXPECT_EQ(c.path[0].curve().kind(), CurveKind::arc);
}

TEST(DxfEntity, ArcWithEqualAnglesIsACircle) {
  for (const auto& angles : {std::pair{30.0, 30.0}, {0.0, 360.0}, {-90.0, 270.0}}) {
    const Contour c = read([&](DxfText& t) { t.arc(0, 0, 5, angles.first, angles.second); });
    EXPECT_NEAR(c.path.length(), 10 * pi, 1e-12);
  }
}

TEST(DxfEntity, Circle) {
  const Contour c = read([](DxfText& t) { t.circle(3, 4, 2); });
  EXPECT_NEAR(c.path.length(), 4 * pi, 1e-12);
  expect_near(begin_of(c), {5, 4, 0});
  expect_near(c.path.at(pi).value, {3, 6, 0});
}

TEST(DxfEntity, EllipseIsExact) {
  const Contour c = read([](DxfText& t) {
    t.tag(0, "ELLIPSE", 8, "0", 10, 1, 20, 2, 30, 0, 11, 0, 21, 10, 31, 0, 40, 0.3, 41, 0, 42, 2 * pi);
  });
  expect_near(begin_of(c), {1, 12, 0});
  // Ramanujan's second formula, h = ((a − b)/(a + b))²; its error here is below 2e-5 relative.
  const double h = std::pow(7.0 / 13, 2);
  EXPECT_NEAR(c.path.length(), pi * 13 * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h))), 1e-3);
  for (int i = 0; i <= 50; ++i) {
    const Vec p = c.path.at(c.path.length() * i / 50).value;
    EXPECT_NEAR(std::pow((p.y - 2) / 10, 2) + std::pow((p.x - 1) / 3, 2), 1, 1e-12);
  }
  // The minor axis lies counter-clockwise of the major one.
  EXPECT_LT(c.path.at(1).value.x, 1);
}

TEST(DxfEntity, EllipticArcEndsAtItsParameters) {
  const Contour c = read([](DxfText& t) {
    t.tag(0, "ELLIPSE", 8, "0", 10, 0, 20, 0, 11, 10, 21, 0, 40, 0.5, 41, 1.5 * pi, 42, 0.5 * pi);
  });
  expect_near(begin_of(c), {0, -5, 0});
  expect_near(end_of(c), {0, 5, 0});
  EXPECT_GT(c.path.at(c.path.length() / 2).value.x, 9.99);
}

TEST(DxfEntity, BulgeSigns) {
  // A half circle to the right of the way from (0,0) to (10,0) is counter-clockwise: positive.
  const Contour plus = read([](DxfText& t) { t.polyline({{{0, 0, 1}}, {{10, 0, 0}}}, false); });
  EXPECT_NEAR(plus.path.length(), 5 * pi, 1e-12);
  expect_near(plus.path.at(2.5 * pi).value, {5, -5, 0});
  const Contour minus = read([](DxfText& t) { t.polyline({{{0, 0, -1}}, {{10, 0, 0}}}, false); });
  expect_near(minus.path.at(2.5 * pi).value, {5, 5, 0});
  // tan(90°/4): a quarter circle; tan(270°/4): three quarters
  const Contour quarter = read([](DxfText& t) { t.polyline({{{10, 0, std::tan(pi / 8)}}, {{0, 10, 0}}}, false); });
  EXPECT_NEAR(quarter.path.length(), 5 * pi, 1e-12);
  expect_near(quarter.path.at(2.5 * pi).value, {10 / std::sqrt(2.0), 10 / std::sqrt(2.0), 0});
  const Contour most = read([](DxfText& t) { t.polyline({{{10, 0, std::tan(3 * pi / 8)}}, {{0, -10, 0}}}, false); });
  EXPECT_NEAR(most.path.length(), 15 * pi, 1e-11);
  expect_near(most.path.at(7.5 * pi).value, {-10 / std::sqrt(2.0), 10 / std::sqrt(2.0), 0}, 1e-11);
}

TEST(DxfEntity, ClosedPolylineReturnsAndDropsWhatHasNoLength) {
  const Contour c = read([](DxfText& t) {
    t.polyline({{{0, 0, 0}}, {{10, 0, 0}}, {{10, 0, 0.5}}, {{10, 10, 0}}, {{0, 10, 0}}}, true);
  });
  const double bulge = 4 * std::atan(0.5) * 10 * 1.25 / 2;  // sweep · chord (1 + b²)/(4b)
  EXPECT_NEAR(c.path.length(), 30 + bulge, 1e-12);
  EXPECT_EQ(c.path.size(), 4u);
  expect_near(begin_of(c), end_of(c));
  EXPECT_TRUE(noted(c, "without length"));
}

TEST(DxfEntity, OldPolylineWithVertices) {
  const Contour c = read([](DxfText& t) {
    t.tag(0, "POLYLINE", 8, "0", 66, 1, 10, 0, 20, 0, 30, 7, 70, 1);
    t.tag(0, "VERTEX", 8, "0", 10, 0, 20, 0, 30, 7, 42, 1);
    t.tag(0, "VERTEX", 8, "0", 10, 10, 20, 0, 30, 7);
    t.tag(0, "VERTEX", 8, "0", 10, 99, 20, 99, 70, 16);  // a control point of the frame
    t.tag(0, "SEQEND", 8, "0");
    t.line(100, 0, 101, 0);
  });
  EXPECT_EQ(c.dimension, 2u);
  EXPECT_NEAR(cut_length(c), 5 * pi + 10 + 1, 1e-12);
  EXPECT_EQ(cut_count(c), 2u);
  EXPECT_TRUE(noted(c, "put into one plane"));  // heights 7 and 0
}

TEST(DxfEntity, PolylineInSpaceIgnoresBulges) {
  const Contour c = read([](DxfText& t) {
    t.tag(0, "POLYLINE", 8, "0", 66, 1, 70, 8);
    t.tag(0, "VERTEX", 8, "0", 10, 0, 20, 0, 30, 0, 70, 32, 42, 1);
    t.tag(0, "VERTEX", 8, "0", 10, 2, 20, 3, 30, 6, 70, 32);
    t.tag(0, "SEQEND");
  });
  EXPECT_EQ(c.dimension, 3u);
  EXPECT_NEAR(c.path.length(), 7, 1e-14);
}

TEST(DxfEntity, MeshesAreSkipped) {
  const Contour c = read([](DxfText& t) {
    t.tag(0, "POLYLINE", 8, "0", 66, 1, 70, 64);
    t.tag(0, "VERTEX", 8, "0", 10, 0, 20, 0, 30, 0);
    t.tag(0, "VERTEX", 8, "0", 10, 2, 20, 3, 30, 6);
    t.tag(0, "SEQEND").line(0, 0, 1, 0);
  });
  EXPECT_NEAR(c.path.length(), 1, 1e-15);
  EXPECT_TRUE(noted(c, "mesh"));
}

TEST(DxfEntity, ExtrusionDownMirrorsX) {
  const Contour c = read(
      [](DxfText& t) { t.tag(0, "ARC", 8, "0", 10, 10, 20, 0, 30, 0, 40, 5, 50, 0, 51, 90, 210, 0, 220, 0, 230, -1); });
  EXPECT_EQ(c.dimension, 2u);
  expect_near(begin_of(c), {-15, 0, 0});
  expect_near(end_of(c), {-10, 5, 0});
  expect_near(c.path.at(1.25 * pi).value, {-10 - 5 / std::sqrt(2.0), 5 / std::sqrt(2.0), 0});
  const Contour p = read(
      [](DxfText& t) { t.tag(0, "LWPOLYLINE", 8, "0", 90, 2, 70, 0, 10, 0, 20, 0, 42, 1, 10, 10, 20, 0, 230, -1); });
  expect_near(end_of(p), {-10, 0, 0});
  expect_near(p.path.at(2.5 * pi).value, {-5, -5, 0});  // clockwise seen from above
}

TEST(DxfEntity, ArbitraryAxes) {
  // The normal x: the object system's x axis is world y, its y axis world z.
  const Affine a = dxf_object_system({2, 0, 0}, 1);
  expect_near(a.x, {0, 1, 0});
  expect_near(a.y, {0, 0, 1});
  const Affine tilted = dxf_object_system({0.001, 0, 1}, 1);  // nearly upright: from world y
  EXPECT_NEAR(dot(tilted.x, {0, 1, 0}), 0, 1e-15);
  expect_near(cross(tilted.x, tilted.y), tilted.z);
  const Contour c = read([](DxfText& t) { t.tag(0, "CIRCLE", 8, "0", 10, 1, 20, 2, 30, 3, 40, 5, 210, 1, 230, 0); });
  EXPECT_EQ(c.dimension, 3u);
  expect_near(begin_of(c), {3, 6, 2});
  EXPECT_NEAR(c.path.length(), 10 * pi, 1e-12);
  expect_near(c.path.at(2.5 * pi).value, {3, 1, 7});
}

TEST(DxfEntity, SplineAsItStands) {
  // A quarter circle as rational quadratic.
  const Contour c = read([](DxfText& t) {
    t.tag(0, "SPLINE", 8, "0", 70, 12, 71, 2, 72, 6, 73, 3);
    for (const int k : {0, 0, 0, 1, 1, 1}) t.tag(40, k);
    t.tag(41, 1, 41, std::sqrt(0.5), 41, 1);
    t.tag(10, 10, 20, 0, 30, 0, 10, 10, 20, 10, 30, 0, 10, 0, 20, 10, 30, 0);
  });
  EXPECT_NEAR(c.path.length(), 5 * pi, 1e-12);
  EXPECT_NEAR(norm(c.path.at(3).value), 10, 1e-12);
}

TEST(DxfEntity, SplineOfDegreeOneIsALineEach) {
  const Contour c = read([](DxfText& t) {
    t.tag(0, "SPLINE", 8, "0", 71, 1);
    for (const int k : {0, 0, 1, 2, 2}) t.tag(40, k);
    t.tag(10, 0, 20, 0, 10, 10, 20, 0, 10, 10, 20, 10);
  });
  ASSERT_EQ(c.path.size(), 2u);
  EXPECT_EQ(c.path[0].curve().kind(), CurveKind::line);
  EXPECT_NEAR(c.path.length(), 20, 1e-13);
}

/// Fit points on a circle: the periodic spline differs from it by O(h⁴).
TEST(DxfEntity, FitPointsOfAClosedSpline) {
  const int n = 40;
  const Contour c = read([&](DxfText& t) {
    t.tag(0, "SPLINE", 8, "0", 70, 11, 71, 3, 74, n);
    for (int i = 0; i < n; ++i) t.tag(11, 10 * std::cos(2 * pi * i / n), 21, 10 * std::sin(2 * pi * i / n), 31, 0);
  });
  EXPECT_TRUE(noted(c, "fit points"));
  EXPECT_NEAR(c.path.length(), 20 * pi, 20 * pi * 1e-5);
  for (int i = 0; i < 200; ++i) EXPECT_NEAR(norm(c.path.at(c.path.length() * i / 200).value), 10, 2e-4);
  expect_near(begin_of(c), end_of(c), 1e-9);
  for (const Joint& j : joints(c.path)) EXPECT_LT(j.angle, 1e-9);
}

TEST(DxfEntity, SplinesThroughFitPointsHaveContinuousCurvature) {
  for (int n = 3; n <= 8; ++n)
    for (const bool closed : {false, true}) {
      const Contour c = read([&](DxfText& t) {
        t.tag(0, "SPLINE", 8, "0", 70, closed ? 11 : 8, 71, 3, 74, n);
        for (int i = 0; i < n; ++i)  // unevenly around an ellipse
          t.tag(11, 30 * std::cos(0.2 * i * i), 21, 10 * std::sin(0.2 * i * i), 31, 0);
      });
      const auto curvature = [&](std::size_t piece, bool end) {
        const Curve& curve = c.path[piece].curve();
        const Jet j = curve.at(end ? curve.end() : curve.begin());
        return cross(j.d1, j.d2).z / std::pow(norm(j.d1), 3);
      };
      const auto pieces = static_cast<std::size_t>(closed ? n : n - 1);
      ASSERT_EQ(c.path.size(), pieces);
      for (std::size_t i = closed ? 0 : 1; i < pieces; ++i)
        EXPECT_NEAR(curvature(i, false), curvature(i > 0 ? i - 1 : pieces - 1, true), 1e-12) << n << ' ' << i;
      if (!closed) {
        EXPECT_NEAR(curvature(0, false), 0, 1e-12) << n;
        EXPECT_NEAR(curvature(pieces - 1, true), 0, 1e-12) << n;
      }
    }
}

TEST(DxfEntity, FitPointsWithTangentsReproduceACubic) {
  // A straight line is reproduced by natural ends; here the ends' tangents bend it.
  const Contour c = read([](DxfText& t) {
    t.tag(0, "SPLINE", 8, "0", 70, 0, 71, 3, 74, 3, 12, 0, 22, 2, 13, 0, 23, 5);
    t.tag(11, 0, 21, 0, 11, 5, 21, 0, 11, 10, 21, 0);
  });
  EXPECT_NEAR(angle_between(c.path.at(0).d1, {0, 1, 0}), 0, 1e-9);
  EXPECT_NEAR(angle_between(c.path.at(c.path.length()).d1, {0, 1, 0}), 0, 1e-9);
  ASSERT_EQ(c.path.size(), 2u);
  expect_near(c.path[1].at(c.path[1].s0()).value, {5, 0, 0}, 1e-12);
  const Contour straight =
      read([](DxfText& t) { t.tag(0, "SPLINE", 8, "0", 70, 0, 71, 3, 11, 0, 21, 0, 11, 5, 21, 0, 11, 11, 21, 0); });
  EXPECT_NEAR(straight.path.length(), 11, 1e-12);
}

TEST(DxfEntity, FaultsNameTheLine) {
  // The entity's line is 8 (after HEADER: 6 lines of section, variable, end … see the text), its tags follow in pairs.
  const auto text = drawing([](DxfText& t) { t.tag(0, "CIRCLE", 8, "0", 10, "abc", 20, 1, 40, 3); });
  std::size_t line = 1;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos && at < text.find("abc"); ++at) ++line;
  const auto list = faults(text);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].rfind("/contour/dxf line " + std::to_string(line) + ": \"abc\"", 0), 0u) << list[0];
}

TEST(DxfEntity, WidthsOfPolylinesAreNoted) {
  const auto note = "a polyline with a width: its centre line was taken";
  const auto wide = [&](auto... tags) {
    const Contour c = read([&](DxfText& t) { t.tag(0, "LWPOLYLINE", 8, "0", 90, 2, 70, 0, tags...); });
    EXPECT_NEAR(c.path.length(), 4, 1e-12);
    return noted(c, note);
  };
  EXPECT_TRUE(wide(43, 2.5, 10, 1, 20, 0, 10, 5, 20, 0));
  EXPECT_TRUE(wide(10, 1, 20, 0, 40, 0, 41, 0.5, 10, 5, 20, 0));
  EXPECT_FALSE(wide(43, 0, 10, 1, 20, 0, 10, 5, 20, 0));
  const auto older = [&](double all, double one) {
    const Contour c = read([&](DxfText& t) {
      t.tag(0, "POLYLINE", 8, "0", 66, 1, 70, 0, 40, all, 41, all);
      t.tag(0, "VERTEX", 8, "0", 10, 1, 20, 0, 40, one);
      t.tag(0, "VERTEX", 8, "0", 10, 5, 20, 0);
      t.tag(0, "SEQEND");
    });
    EXPECT_NEAR(c.path.length(), 4, 1e-12);
    return noted(c, note);
  };
  EXPECT_TRUE(older(1, 0));
  EXPECT_TRUE(older(0, 1));
  EXPECT_FALSE(older(0, 0));
}

TEST(DxfEntity, AttributesAreNoted) {
  EXPECT_TRUE(noted(read([](DxfText& t) {
                      t.line(0, 0, 1, 0);
                      t.tag(0, "ATTRIB", 8, "0", 10, 5, 20, 0, 1, "N7");
                    }),
                    "ATTRIB is nothing to move along"));
}

TEST(DxfEntity, EveryBadEntityIsNamed) {
  const auto list = faults(drawing([](DxfText& t) {
    t.tag(0, "CIRCLE", 10, 0, 20, 0, 40, -3);
    t.tag(0, "CIRCLE", 10, "1e400", 20, 0, 40, 3);
    t.tag(0, "LINE", 10, "nan", 20, 0, 11, 3);
    t.tag(0, "LINE", 10, "1,5", 20, 0, 11, 3);
    t.tag(0, "LINE", 10, "2e9", 20, 0, 11, 3);
    t.tag(0, "ELLIPSE", 10, 0, 20, 0, 40, 0.5);
    t.tag(0, "ELLIPSE", 10, 0, 20, 0, 11, 1, 40, 0);
    t.tag(0, "SPLINE", 71, 3, 10, 0, 20, 0);
    t.tag(0, "SPLINE", 71, 99, 10, 0, 20, 0);
    t.tag(0, "LWPOLYLINE", 20, 3);
    t.tag(0, "ARC", 40, 1, 50, 0, 51, 90, 210, 0, 220, 0, 230, 0);
    t.tag(0, "INSERT", 2, "nowhere");
    t.line(0, 0, 1, 0);
  }));
  EXPECT_EQ(list.size(), 12u);
  for (const auto& f : list) EXPECT_EQ(f.rfind("/contour/dxf line ", 0), 0u) << f;
}

TEST(DxfEntity, ReportsAtMostAHundredFaults) {
  const auto list = faults(drawing([](DxfText& t) {
    for (int i = 0; i < 300; ++i) t.circle(0, 0, -1);
  }));
  EXPECT_EQ(list.size(), 100u);
}

TEST(DxfEntity, BarelyBentIsStraight) {
  const Contour c = read([](DxfText& t) { t.polyline({{{0, 0, 1e-11}}, {{100, 0, 0}}}, false); });
  EXPECT_EQ(c.path[0].curve().kind(), CurveKind::line);
  EXPECT_EQ(faults(drawing([](DxfText& t) { t.arc(0, 0, 9e8, 0, 90); })).size(), 1u);
}

}  // namespace
}  // namespace bahnwerk
