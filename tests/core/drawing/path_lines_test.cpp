#include "core/drawing/path_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "core/geometry/curve/line.hpp"

namespace bahnwerk::drawing {
namespace {

std::vector<Vec> sampled(const std::shared_ptr<const Curve>& curve, double tolerance) {
  Path path;
  path.append(curve, 0);
  std::vector<Vec> points;
  const std::function<void(Vec)> keep = [&](Vec p) { points.push_back(p); };
  Sampler sampler(tolerance, keep);
  sampler(path[0]);
  return points;
}

TEST(PathLines, ALineIsItsEnd) {
  EXPECT_EQ(sampled(std::make_shared<const Line>(Vec{1, 2, 0}, Vec{9, 3, 0}), 0.01), (std::vector<Vec>{{9, 3, 0}}));
}

TEST(PathLines, ChordsOfAnArcStayWithinTheTolerance) {
  const double radius = 50;
  const auto arc = std::make_shared<const Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, radius, 4.0, 0);
  for (const double tolerance : {0.5, 0.01, 1e-4}) {
    const std::vector<Vec> points = sampled(arc, tolerance);
    Vec last = arc->at(arc->begin()).value;
    double widest = 0;
    for (const Vec& p : points) {
      EXPECT_NEAR(norm(p), radius, 1e-12);
      widest = std::max(widest, radius - norm(0.5 * (last + p)));
      last = p;
    }
    EXPECT_LE(widest, tolerance);
    EXPECT_GE(widest, 0.5 * tolerance) << "no more chords than that takes";
    EXPECT_LE(norm(last - arc->at(arc->end()).value), 1e-12);
  }
}

TEST(PathLines, PointsOnOneStraightAreOneLine) {
  Thinned thinned(0.3);
  thinned.begin({0, 0});
  for (int i = 1; i <= 100; ++i) thinned.to({0.1 * i, i % 2 == 0 ? 0.0 : 0.1});
  thinned.end();
  EXPECT_DOUBLE_EQ(thinned.lattice(), 0.1);
  EXPECT_EQ(thinned.data(), "M0 0l100 0") << "wobbles of less than half of the tolerance";
}

TEST(PathLines, CornersAreKeptAndNoLineIsDrawnTwice) {
  Thinned thinned(0.3);
  thinned.begin({0, 0});
  thinned.to({2, 0});
  thinned.to({2, -1});
  thinned.begin({2, 0});  // back along the first line
  thinned.to({0, 0});
  thinned.end();
  EXPECT_EQ(thinned.data(), "M0 0l20 0 0-10");
}

}  // namespace
}  // namespace bahnwerk::drawing
