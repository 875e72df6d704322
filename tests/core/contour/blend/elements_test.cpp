#include "core/contour/blend/elements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contour/builder.hpp"
#include "core/contour/polyline.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

TEST(BlendElements, CutsAtReversals) {
  const Contour c = polyline(2, {{}, {10, 0, 0}, {5, 0, 0}, {5, 5, 0}}, false, 1);
  const auto list = element_runs(c.path, 0, 3, {0, 0, 0}, {1e-6, 3}, silent_scope());
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].elements.size(), 1u);
  EXPECT_NEAR(list[1].length(), 10, 1e-12);
  EXPECT_TRUE(list[0].rest_end && list[1].rest_begin);
}

TEST(BlendElements, MergesTinyLinesAndKeepsTheEnds) {
  std::vector<Vec> points;
  for (int i = 0; i <= 1000; ++i) points.push_back({0.001 * i, 0.0002 * (i % 2), 0});
  const Contour c = polyline(2, points, false, 1);
  const auto list =
      element_runs(c.path, 0, c.path.size(), std::vector<std::size_t>(c.path.size(), 0), {0.01, 3.1}, silent_scope());
  ASSERT_EQ(list.size(), 1u);
  const auto& elements = list[0].elements;
  EXPECT_LT(elements.size(), 120u);
  EXPECT_LE(norm(elements.front().at(0).value - points.front()), 1e-12);
  EXPECT_LE(norm(elements.back().at(elements.back().length).value - points.back()), 1e-12);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    EXPECT_GE(elements[i].length, 0.01);
    if (i > 0) {
      EXPECT_LE(norm(elements[i].at(0).value - elements[i - 1].at(elements[i - 1].length).value), 1e-12);
      EXPECT_EQ(elements[i].begin, elements[i - 1].end());
    }
  }
}

TEST(BlendElements, BothDirectionsKeepTheSameVertices) {
  std::vector<Vec> points{{}};
  for (int i = 0; i < 300; ++i) {
    const double length = i % 7 == 0 ? 0.5 + 0.01 * i : 0.0007 * (1 + i * i % 23), heading = 0.02 * i;
    points.push_back(points.back() + length * Vec{std::cos(heading), std::sin(heading), 0});
  }
  const auto vertices = [](const std::vector<Vec>& of) {
    const Contour c = polyline(2, of, false, 1);
    const std::vector<std::size_t> blocks(c.path.size(), 0);
    const std::vector<ElementRun> runs = element_runs(c.path, 0, c.path.size(), blocks, {0.01, 3.1}, silent_scope());
    std::vector<Vec> list;
    for (const Element& e : runs.at(0).elements) list.push_back(e.at(0).value);
    return list;
  };
  const std::vector<Vec> there = vertices(points);
  std::reverse(points.begin(), points.end());
  const std::vector<Vec> back = vertices(points);
  ASSERT_EQ(there.size(), back.size());
  EXPECT_LT(there.size(), 200u);
  for (std::size_t i = 1; i < there.size(); ++i) EXPECT_LE(norm(there[i] - back[back.size() - i]), 1e-12) << i;
}

TEST(BlendElements, OneOfBothDirectionsBeginsAtTheEnd) {
  const auto hook = [](double t) { return t < 10 ? Vec{t, 0, 0} : Vec{10, t - 10, 0}; };
  EXPECT_NE(begins_at_end(0, 30, hook), begins_at_end(0, 30, [&](double t) { return hook(30 - t); }));
}

TEST(BlendElements, NoBlockIsMergedAway) {
  // Blocks of one tiny line each, then one that is a tiny way there and back.
  std::vector<Vec> points;
  for (int i = 0; i <= 50; ++i) points.push_back({0.001 * i, 0, 0});
  points.push_back(points[49]);
  points.push_back(points[50]);
  points.push_back({1, 0, 0});
  const Contour c = polyline(2, points, false, 1);
  std::vector<std::size_t> blocks;
  for (std::size_t i = 0; i < c.path.size(); ++i) blocks.push_back(std::min<std::size_t>(i, 50) + (i > 51 ? 1 : 0));
  std::vector<bool> kept(blocks.back() + 1, false);
  for (const ElementRun& s : element_runs(c.path, 0, c.path.size(), blocks, {0.01, 3}, silent_scope()))
    for (const Element& e : s.elements) kept[e.block] = true;
  for (std::size_t b = 0; b < kept.size(); ++b) EXPECT_TRUE(kept[b]) << b;
}

TEST(BlendElements, PartsLieOnTheirCurves) {
  ContourBuilder b(3, {});
  b.line({10, 0, 0});
  b.arc({10, 10, 4}, {10, 5, 0}, true);
  b.nurbs(3, {{10, 10, 4}, {5, 14, 4}, {0, 12, 0}, {-5, 8, 1}}, {1, 2, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1});
  const Contour c = b.finish();
  const auto list =
      element_runs(c.path, 0, c.path.size(), std::vector<std::size_t>(c.path.size(), 0), {1e-6, 3}, silent_scope());
  ASSERT_EQ(list.size(), 1u);
  for (const Element& e : list[0].elements) {
    const auto curve = e.part(0.2 * e.length, 0.7 * e.length);
    const Segment part(curve, 0, 0);
    EXPECT_NEAR(part.length(), 0.5 * e.length, 1e-10);
    for (const double x : {0.0, 0.4, 1.0}) {
      const Jet a = part.at(x * part.length()), g = e.at((0.2 + 0.5 * x) * e.length);
      EXPECT_LE(norm(a.value - g.value), 1e-10);
      EXPECT_LE(norm(a.d1 - g.d1), 1e-10);
      EXPECT_LE(norm(a.d2 - g.d2), 1e-9);
      EXPECT_LE(norm(a.d3 - g.d3), 1e-8);
    }
  }
}

}  // namespace
}  // namespace bahnwerk::blending
