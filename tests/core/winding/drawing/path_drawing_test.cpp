#include "core/winding/drawing/path_drawing.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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
  EXPECT_EQ(times(svg, "transform=\"scale("), 1u + 1) << "the part, and the path as one turn";
  EXPECT_EQ(svg, path_drawing({"one < coil", pieces, part_outline(part, checked_slot(part))}));
  // A long path is thinned to what shows.
  const std::vector<BezierPiece> same(3000, pieces[1]);
  EXPECT_LT(path_drawing({"again", same, {}}).size(), 20000u);
}

TEST(PathDrawing, TheLastTurnIsBoldAndThoseBeforeFaint) {
  const auto opacity = [](const std::string& svg) {
    const std::size_t at = svg.rfind("stroke-opacity=\"");
    return at == svg.npos ? 1.0 : std::stod(svg.substr(at + 16));
  };
  const std::vector<BezierPiece> few = bent(4), many = bent(70);
  const std::size_t each = few.size() / 4;
  const std::string four = path_drawing({"four", few, {}, 3 * each, 4}),
                    seventy = path_drawing({"70", many, {}, 69 * each, 70});
  for (const std::string& svg : {four, seventy}) {
    expect_sound(svg);
    EXPECT_EQ(times(svg, "transform=\"scale("), 2u) << "the turns before, and the last";
    for (const char* words : {">turns before<", ">last turn<", ">begin<", ">end<", ">part<"})
      EXPECT_EQ(times(svg, words), 1u) << words;
    EXPECT_EQ(times(svg, "<circle"), 4u) << "begin and end, in the key and on the path";
  }
  EXPECT_LT(opacity(seventy), 0.5 * opacity(four));
  const std::string one = path_drawing({"one", bent(1), {}});
  EXPECT_EQ(times(one, "turns before"), 0u);
  EXPECT_EQ(times(one, ">needle's tip<"), 1u);
}

TEST(PathDrawing, ShowsSlotsPostsWiresAndNeedle) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const Coil coil{0, 5};
  const std::vector<BezierPiece> pieces = bent(2);
  DrawnPath drawn{"all", pieces, part_outline(part, slot)};
  drawn.coils = coil_outline(part, slot, coil);
  drawn.posts = post_outline(part, {}, coil);
  drawn.wires = {{{90, 0, 210}, {90, 0, 0}}};
  drawn.slots = slot_labels(part, {coil});
  drawn.needle_length = 60, drawn.needle_width = 2;
  const std::string svg = path_drawing(drawn);
  expect_sound(svg);
  EXPECT_EQ(times(svg, "transform=\"scale("), 6u) << "part, coil, posts, wires, path, needle";
  EXPECT_EQ(times(svg, "font-weight=\"bold\""), 2u) << "slots 0 and 5";
  for (const char* words : {">slots of the coil<", ">winding tools<", ">laid wires<", ">needle at the end<"})
    EXPECT_EQ(times(svg, words), 1u) << words;
  EXPECT_GE(times(svg, "font-size=\"11\""), 20u) << "numbers of other slots";
  EXPECT_EQ(times(path_drawing({"bare", pieces, {}}), "needle at the end"), 0u);
}

TEST(PathDrawing, IsADrawingForNothingAndForAPoint) {
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
