#include "core/winding/drawing/path_drawing.hpp"

#include <gtest/gtest.h>

#include "core/geometry/spline/spline_arc.hpp"

namespace bahnwerk::winding {
namespace {

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

void expect_sound(const std::string& svg) {
  EXPECT_EQ(svg.find("nan"), svg.npos);
  EXPECT_EQ(svg.find("inf"), svg.npos);
  EXPECT_NE(svg.find("</svg>"), svg.npos);
}

std::vector<BezierPiece> bent(int turns) {
  std::vector<BezierPiece> pieces;
  for (int i = 0; i < turns; ++i) {
    const double z = 3.0 * i;
    pieces.push_back(BezierPiece::line({-30, 20, z, 0, 0}, {0, 20, z, 0, 0}));
    for (const BezierPiece& arc : spline_arc({0, 20, z, 0, 0}, {0, 0, z}, {0, 0, -1}, 2.5)) pieces.push_back(arc);
  }
  return pieces;
}

TEST(PathDrawing, ShowsPathAndPart) {
  const StatorPart part;
  const std::vector<BezierPiece> pieces = bent(6);
  const std::string svg = path_drawing({"one < coil", pieces, part_outline(part, checked_slot(part))});
  expect_sound(svg);
  EXPECT_NE(svg.find("one &lt; coil"), svg.npos);
  EXPECT_NE(svg.find("axes: 20 mm"), svg.npos) << svg.substr(svg.size() - 400);
  EXPECT_EQ(times(svg, "transform=\"scale("), 1u + 6) << "the part, and six stretches of the path";
  EXPECT_EQ(svg, path_drawing({"one < coil", pieces, part_outline(part, checked_slot(part))}));
  // A long path is thinned to what shows.
  const std::vector<BezierPiece> same(3000, pieces[1]);
  EXPECT_LT(path_drawing({"again", same, {}}).size(), 20000u);
}

TEST(PathDrawing, OfNothingAndOfAPointIsStillADrawing) {
  expect_sound(path_drawing({"none", {}, {}}));
  const std::vector<BezierPiece> still{BezierPiece::line({1, 2, 3, 0, 0}, {1, 2, 3, 1, 0})};
  expect_sound(path_drawing({"still", still, {}}));
}

TEST(CurvatureChart, HasAxesJointsAndTheCurve) {
  const std::vector<BezierPiece> pieces = bent(2);
  const std::string svg = curvature_chart(pieces, "curvature");
  expect_sound(svg);
  EXPECT_EQ(times(svg, "stroke-dasharray=\"3 4\""), pieces.size() - 1);
  EXPECT_NE(svg.find(">0.05<"), svg.npos) << "1/20 mm";
  EXPECT_NE(svg.find(">160<"), svg.npos) << "30 + 50 mm, twice";
  EXPECT_EQ(times(curvature_chart(bent(40), "many"), "stroke-dasharray"), 0u);
  expect_sound(curvature_chart({}, "none"));
  expect_sound(curvature_chart(std::vector{BezierPiece::line({0, 0, 0, 0, 0}, {9, 0, 0, 0, 0})}, "straight"));
}

}  // namespace
}  // namespace bahnwerk::winding
