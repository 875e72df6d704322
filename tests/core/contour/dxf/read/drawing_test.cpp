#include "core/contour/dxf/read/drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/contour/dxf/read/tags.hpp"
#include "tests/core/contour/dxf_text.hpp"
#include "tests/core/contour/expect_near.hpp"

namespace bahnwerk {
namespace {

using namespace test;
constexpr double pi = std::numbers::pi;

/// A block "part" with base point (1, 0): a quarter circle from (3, 0) to (1, 2) about (1, 0).
DxfText with_block() {
  DxfText t;
  t.unit(4).section("BLOCKS").tag(0, "BLOCK", 8, "0", 2, "Part", 70, 0, 10, 1, 20, 0);
  t.arc(1, 0, 2, 0, 90).tag(0, "ENDBLK").end().section("ENTITIES");
  return t;
}
template <class... Tags>
Contour inserted(const Tags&... tags) {
  DxfText t = with_block();
  t.tag(0, "INSERT", 8, "0", 2, "PART", tags...).end();
  return read_dxf(t.eof());
}

TEST(DxfInsert, ShiftsScalesAndTurns) {
  const Contour c = inserted(10, 100, 20, 50, 41, 3, 42, 3, 50, 90);
  EXPECT_NEAR(c.path.length(), 3 * pi, 1e-12);
  expect_near(begin_of(c), {100, 56, 0});
  expect_near(end_of(c), {94, 50, 0});
  EXPECT_EQ(c.path[0].curve().kind(), CurveKind::arc);
}

TEST(DxfInsert, MirrorsWithANegativeScale) {
  const Contour c = inserted(41, -1, 42, 1);
  expect_near(begin_of(c), {-2, 0, 0});
  expect_near(end_of(c), {0, 2, 0});
  expect_near(c.path.at(pi / 2).value, {-std::sqrt(2.0), std::sqrt(2.0), 0});
  EXPECT_EQ(c.path[0].curve().kind(), CurveKind::arc);
}

TEST(DxfInsert, MirrorsByItsExtrusionDirection) {
  const Contour c = inserted(10, 10, 20, 0, 230, -1);
  expect_near(begin_of(c), {-12, 0, 0});
  expect_near(end_of(c), {-10, 2, 0});
}

TEST(DxfInsert, UnequalScalesMakeAnEllipse) {
  const Contour c = inserted(41, 5, 42, 2);
  expect_near(begin_of(c), {10, 0, 0});
  expect_near(end_of(c), {0, 4, 0});
  for (int i = 0; i <= 20; ++i) {
    const Vec p = c.path.at(c.path.length() * i / 20).value;
    EXPECT_NEAR(p.x * p.x / 100 + p.y * p.y / 16, 1, 1e-13);
  }
}

TEST(DxfInsert, ArraysInTurnedRowsAndColumns) {
  const Contour c = inserted(70, 3, 71, 2, 44, 10, 45, 20, 50, 90);
  EXPECT_EQ(cut_count(c), 6u);
  EXPECT_NEAR(cut_length(c), 6 * pi, 1e-11);
  // Columns run along y, rows along −x after the turn.
  expect_near(end_of(c), {-2 - 20, 20, 0});
}

TEST(DxfInsert, NestsAndInheritsTheLayer) {
  DxfText t;
  t.unit(4).section("TABLES").tag(0, "TABLE", 2, "LAYER", 70, 1);
  t.tag(0, "LAYER", 2, "cold", 70, 1, 62, 7, 0, "LAYER", 2, "dark", 70, 0, 62, -7, 0, "ENDTAB").end();
  t.section("BLOCKS").tag(0, "BLOCK", 8, "0", 2, "inner", 70, 0, 10, 0, 20, 0);
  t.line(0, 0, 1, 0, "0").line(0, 1, 1, 1, "COLD").line(0, 2, 1, 2, "own").tag(0, "ENDBLK");
  t.tag(0, "BLOCK", 8, "0", 2, "outer", 70, 0, 10, 0, 20, 0);
  t.tag(0, "INSERT", 8, "0", 2, "inner", 10, 10, 20, 0, 41, 2, 42, 2).tag(0, "ENDBLK").end();
  t.section("ENTITIES");
  t.tag(0, "INSERT", 8, "cut", 2, "OUTER", 10, 0, 20, 100);
  t.tag(0, "INSERT", 8, "Dark", 2, "outer", 10, 0, 20, 200);
  t.tag(0, "INSERT", 8, "Cold", 2, "outer", 10, 0, 20, 300).end();
  const std::string text = t.eof();
  const Contour c = read_dxf(text);
  // First insert: lines on "0" and "own". Second, on a layer switched off: only "own". Third, frozen: nothing.
  EXPECT_EQ(cut_count(c), 3u);
  expect_near(begin_of(c), {10, 100, 0});
  EXPECT_TRUE(noted(c, "frozen"));
  EXPECT_TRUE(noted(c, "switched off"));
  DxfOptions only;
  only.layers = {"CUT"};
  EXPECT_EQ(cut_count(read_dxf(text, only)), 1u);
}

TEST(DxfInsert, ABlockThatContainsItselfIsRefused) {
  DxfText t;
  t.unit(4).section("BLOCKS").tag(0, "BLOCK", 2, "a", 10, 0, 20, 0).tag(0, "INSERT", 2, "a").tag(0, "ENDBLK").end();
  t.section("ENTITIES").tag(0, "INSERT", 2, "a").end();
  const auto list = faults(t.eof());
  ASSERT_EQ(list.size(), 1u);
  EXPECT_NE(list[0].find("nested"), std::string::npos);
}

TEST(DxfInsert, BillionsOfCopiesAreRefusedQuickly) {
  for (const bool drawn : {false, true}) {
    DxfText t;
    t.unit(4).section("BLOCKS");
    t.tag(0, "BLOCK", 2, "b0", 10, 0, 20, 0);
    if (drawn) t.line(0, 0, 1, 0);
    t.tag(0, "ENDBLK");
    for (int i = 1; i < 12; ++i) {
      t.tag(0, "BLOCK", 2, "b" + std::to_string(i), 10, 0, 20, 0);
      t.tag(0, "INSERT", 2, "b" + std::to_string(i - 1), 70, 1000, 71, 1000, 44, 1, 45, 1).tag(0, "ENDBLK");
    }
    t.end().section("ENTITIES").tag(0, "INSERT", 2, "b11").end();
    DxfOptions options;
    options.max_curves = 10'000;
    const auto list = faults(t.eof(), options);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_NE(list[0].find("more than"), std::string::npos);
  }
}

TEST(DxfDrawing, Units) {
  const auto length = [](int code, const DxfOptions& options = {}) {
    DxfText t;
    t.unit(code).section("ENTITIES").line(0, 0, 2, 0).end();
    return read_dxf(t.eof(), options).path.length();
  };
  EXPECT_NEAR(length(1), 50.8, 1e-13);
  EXPECT_NEAR(length(2), 609.6, 1e-12);
  EXPECT_NEAR(length(4), 2, 0);
  EXPECT_NEAR(length(5), 20, 1e-14);
  EXPECT_NEAR(length(6), 2000, 0);
  EXPECT_NEAR(length(21), 2400000.0 / 3937, 1e-11);
  DxfOptions inches;
  inches.millimetres_per_unit = 25.4;
  EXPECT_NEAR(length(4, inches), 50.8, 1e-13);
  DxfText t;
  t.section("ENTITIES").line(0, 0, 2, 0).end();
  const Contour c = read_dxf(t.eof());
  EXPECT_TRUE(noted(c, "unit"));
  EXPECT_NEAR(c.path.length(), 2, 0);
  DxfText parsec;
  parsec.unit(20).section("ENTITIES").line(0, 0, 2, 0).end();
  const auto list = faults(parsec.eof());
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].rfind("/contour/dxf line 8: ", 0), 0u) << list[0];
}

TEST(DxfDrawing, EntitiesWithoutCurvesAreSkippedWithANotePerKind) {
  const Contour c = read([](DxfText& t) {
    t.line(0, 0, 1, 0);
    t.tag(0, "TEXT", 10, 0, 20, 0, 1, "LINE").tag(0, "TEXT", 1, "b").tag(0, "POINT", 10, 5, 20, 5);
    t.tag(0, "LINE", 67, 1, 10, 0, 20, 0, 11, 5, 21, 5);
    t.tag(0, "LINE", 60, 1, 10, 0, 20, 0, 11, 5, 21, 5);
    t.tag(0, "MTEXT", 101, "Embedded Object", 10, "x").tag(0, "3DFACE", 10, 0).tag(0, "HATCH", 10, 0);
  });
  EXPECT_NEAR(c.path.length(), 1, 0);
  EXPECT_TRUE(noted(c, "TEXT is nothing to move along (2, first in line"));
  EXPECT_TRUE(noted(c, "POINT"));
  EXPECT_TRUE(noted(c, "paper space"));
  EXPECT_TRUE(noted(c, "invisible"));
  EXPECT_EQ(c.notes.size(), 7u);
}

TEST(DxfDrawing, FaultsOnLayersNotShownDoNotMatter) {
  const std::string text = drawing([](DxfText& t) {
    t.line(0, 0, 1, 0, "keep");
    t.tag(0, "CIRCLE", 8, "scrap", 40, -1);
  });
  DxfOptions options;
  options.layers = {"Keep"};
  EXPECT_NEAR(read_dxf(text, options).path.length(), 1, 0);
  EXPECT_EQ(faults(text).size(), 1u);
  options.layers = {"none such"};
  EXPECT_EQ(faults(text, options).size(), 1u);
}

DxfText& paper_line(DxfText& t, double x0, double x1, const char* layer = "0") {
  return t.tag(0, "LINE", 67, 1, 8, layer, 10, x0, 20, 0, 11, x1, 21, 0);
}

TEST(DxfDrawing, PaperSpaceIsReadWhereModelSpaceIsEmpty) {
  const Contour c = read([](DxfText& t) {
    t.tag(0, "TEXT", 10, 0, 20, 0, 1, "model");
    t.tag(0, "VIEWPORT", 67, 1, 10, 0, 20, 0);
    paper_line(paper_line(t, 0, 3), 5, 9);
  });
  EXPECT_NEAR(cut_length(c), 7, 1e-12);
  EXPECT_TRUE(noted(c, "model space is empty: paper space was read"));
  EXPECT_TRUE(noted(c, "TEXT is nothing"));
  EXPECT_FALSE(noted(c, "skipped: in paper space"));
  // One curve in model space, and paper space is left out as before.
  const Contour model = read([](DxfText& t) { paper_line(t, 0, 3).line(0, 0, 2, 0); });
  EXPECT_NEAR(cut_length(model), 2, 1e-12);
  EXPECT_TRUE(noted(model, "skipped: in paper space (1"));
}

TEST(DxfDrawing, HiddenCurvesKeepPaperSpaceOut) {
  const auto hidden = [](auto curve) {
    return faults(drawing([&](DxfText& t) {
      curve(t);
      paper_line(t, 0, 3);
    }));
  };
  EXPECT_EQ(hidden([](DxfText& t) { t.tag(0, "LINE", 60, 1, 10, 0, 20, 0, 11, 5, 21, 5); }).size(), 1u);
  EXPECT_EQ(hidden([](DxfText&) {}).size(), 0u);
  // What paper space hides is told.
  const auto list = faults(drawing([](DxfText& t) { t.tag(0, "LINE", 67, 1, 60, 1, 10, 0, 20, 0, 11, 5, 21, 5); }));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_NE(list[0].find("invisible"), std::string::npos);
}

TEST(DxfDrawing, PaperSpaceBringsBlocksAndOtherSheets) {
  DxfText t;
  t.unit(4).section("BLOCKS");
  t.tag(0, "BLOCK", 8, "0", 2, "*Model_Space", 70, 0, 10, 0, 20, 0, 0, "ENDBLK");
  t.tag(0, "BLOCK", 8, "0", 2, "*Paper_Space", 70, 0, 10, 0, 20, 0, 0, "ENDBLK");
  t.tag(0, "BLOCK", 8, "0", 2, "*Paper_Space0", 70, 0, 10, 0, 20, 0);
  t.tag(0, "VIEWPORT", 67, 1, 10, 0, 20, 0).tag(0, "ENDBLK");
  t.tag(0, "BLOCK", 8, "0", 2, "*Paper_Space1", 70, 0, 10, 0, 20, 0);
  paper_line(t, 0, 4).line(10, 0, 15, 0).tag(0, "INSERT", 67, 1, 8, "0", 2, "part", 10, 0, 20, 9);
  t.tag(0, "ENDBLK");
  t.tag(0, "BLOCK", 8, "0", 2, "part", 70, 0, 10, 0, 20, 0).line(0, 0, 7, 0).tag(0, "ENDBLK");
  t.end().section("ENTITIES").end();
  const Contour c = read_dxf(t.eof());
  EXPECT_NEAR(cut_length(c), 4 + 5 + 7, 1e-12);
  EXPECT_TRUE(noted(c, "the sheet \"*paper_space1\" of paper space was read"));
}

TEST(DxfDrawing, AnUnknownLayerIsAFaultThatListsThoseThatExist) {
  DxfText t;
  t.unit(4).section("TABLES").tag(0, "TABLE", 2, "LAYER", 70, 1);
  t.tag(0, "LAYER", 2, "Engrave", 70, 0, 62, 7, 0, "ENDTAB").end();
  t.section("ENTITIES").line(0, 0, 1, 0, "CUT").line(0, 1, 1, 1, "0").end();
  const std::string text = t.eof();
  DxfOptions options;
  options.layers = {"cut", "Cutt", "engrave", "x"};
  EXPECT_EQ(
      faults(text, options),
      (std::vector<std::string>{"/contour/layers/1 is no layer of the drawing; it has \"0\", \"CUT\", \"Engrave\"",
                                "/contour/layers/3 is no layer of the drawing; it has \"0\", \"CUT\", \"Engrave\""}));
  options.layers = {"cut", "engrave"};
  EXPECT_NEAR(cut_length(read_dxf(text, options)), 1, 1e-12);
  // Hundreds of layers are not all listed.
  const std::string many = drawing([](DxfText& d) {
    for (int i = 0; i < 200; ++i) d.line(0, i, 1, i, std::to_string(i).c_str());
  });
  options.layers = {"none"};
  const auto list = faults(many, options);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_NE(list[0].find("and 170 more"), std::string::npos) << list[0];
}

TEST(DxfDrawing, HeightsMakeItSpatialOnlyIfSomethingRises) {
  const Contour high = read([](DxfText& t) { t.tag(0, "LINE", 10, 0, 20, 0, 30, 5, 11, 1, 21, 0, 31, 5); });
  EXPECT_EQ(high.dimension, 2u);
  EXPECT_EQ(begin_of(high).z, 0);
  EXPECT_TRUE(high.notes.empty());
  const Contour space = read([](DxfText& t) {
    t.tag(0, "LINE", 10, 0, 20, 0, 30, 5, 11, 0, 21, 3, 31, 9);
    t.tag(0, "CIRCLE", 10, 50, 20, 0, 30, 1, 40, 2);
  });
  EXPECT_EQ(space.dimension, 3u);
  expect_near(begin_of(space), {0, 0, 5});
  expect_near(end_of(space), {52, 0, 1});
}

TEST(DxfTags, LineEndsMarksAndComments) {
  std::string text = drawing([](DxfText& t) { t.line(0, 0, 1, 0); });
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_NEAR(read_dxf(windows).path.length(), 1, 0);
  EXPECT_NEAR(read_dxf("999\nmade by hand\n" + text + "\n\n").path.length(), 1, 0);
  EXPECT_NEAR(read_dxf("  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n 10\n +1.0E+00 \n 20\n\t0\n 11\n .5e1\n  0\nENDSEC\n")
                  .path.length(),
              4, 0);
}

TEST(DxfTags, TextBehindTheEndIsNotRead) {
  const std::string text = drawing([](DxfText& t) { t.line(0, 0, 4, 0); });
  for (const std::string& end : {std::string("\x1A"), std::string("\r\n\x1A\0\0\n", 6), std::string("\n\n")}) {
    const Contour c = read_dxf(text + end);
    EXPECT_EQ(cut_length(c), 4);
    EXPECT_TRUE(c.notes.empty());
  }
  for (const char* end : {"made by hand\n", "0\nSECTION\n", "7\n"}) {
    const Contour c = read_dxf(text + end);
    EXPECT_EQ(cut_length(c), 4) << end;
    EXPECT_TRUE(noted(c, "what follows EOF in line ")) << end;
  }
  // The mark of the end in place of EOF.
  const Contour c = read_dxf(text.substr(0, text.rfind("0\nEOF")) + "\x1A");
  EXPECT_EQ(cut_length(c), 4);
  EXPECT_TRUE(noted(c, "does not end with EOF"));
}

TEST(DxfTags, LinesMayEndWithCarriageReturnsAlone) {
  std::string text = drawing([](DxfText& t) { t.line(0, 0, 4, 0); });
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_EQ(cut_length(read_dxf(text)), 4);
}

TEST(DxfDrawing, CurvesWithoutLengthAreDroppedWithANote) {
  const Contour c = read([](DxfText& t) {
    t.line(0, 0, 6, 0).circle(1, 1, 0).arc(2, 2, 0, 0, 90);
    t.tag(0, "ELLIPSE", 8, "0", 10, 0, 20, 0, 11, 0, 21, 0, 40, 1).polyline({{{3, 3, 0}}}, true);
  });
  EXPECT_EQ(cut_length(c), 6);
  EXPECT_TRUE(noted(c, "dropped: 4 curves without length (first in line "));
  EXPECT_TRUE(
      noted(read([](DxfText& t) { t.line(0, 0, 6, 0).circle(1, 1, 0); }), "dropped: 1 curve without length (line "));
  EXPECT_EQ(faults(drawing([](DxfText& t) { t.circle(0, 0, -1); })).size(), 1u);
}

TEST(DxfDrawing, LayersThatAreNotPlottedAreSkippedUnlessAskedFor) {
  DxfText text;
  text.unit(4).section("TABLES").tag(0, "TABLE", 2, "LAYER", 70, 2);
  text.tag(0, "LAYER", 2, "Guides", 70, 0, 62, 7, 290, 0, 0, "LAYER", 2, "Cut", 70, 0, 62, 7, 290, 1, 0, "ENDTAB")
      .end();
  text.section("ENTITIES").line(0, 0, 3, 0, "Cut").line(0, 9, 5, 9, "GUIDES").end();
  const std::string file = text.eof();
  const Contour c = read_dxf(file);
  EXPECT_EQ(cut_length(c), 3);
  EXPECT_TRUE(noted(c, "skipped: on a layer that is not plotted, \"GUIDES\""));
  EXPECT_EQ(cut_length(read_dxf(file, {.layers = {"guides"}})), 5);
}

TEST(DxfTags, BrokenFilesAreRefusedWithALine) {
  const std::string text = drawing([](DxfText& t) { t.line(0, 0, 1, 0).line(5, 5, 6, 6); });
  const auto first = [](const std::string& broken) {
    const auto list = faults(broken);
    return list.size() == 1 ? list[0] : "faults: " + std::to_string(list.size());
  };
  EXPECT_EQ(first(std::string("AutoCAD Binary DXF\r\n\x1a\0", 22)).rfind("/contour/dxf line 1: this is a binary", 0),
            0u);
  EXPECT_EQ(first("AC1032\x01\x02").rfind("/contour/dxf line 1: this is a DWG", 0), 0u);
  EXPECT_EQ(first("").rfind("/contour/dxf line 1: ", 0), 0u);
  EXPECT_EQ(first("G0 X0\nG1 X5\n").rfind("/contour/dxf line 1: ", 0), 0u);
  EXPECT_NE(first(text.substr(0, text.rfind("0\nENDSEC"))).find("cut off"), std::string::npos);
  EXPECT_NE(first(text.substr(0, text.rfind("21\n") + 3)).find("without its value"), std::string::npos);
  std::string code = text;
  code.replace(code.find("\n10\n"), 4, "\n99999\n");
  EXPECT_NE(first(code).find("\"99999\" is no group code"), std::string::npos);
  EXPECT_NE(first("0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n").find("nothing to move along"), std::string::npos);
  EXPECT_NE(first("0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n").find("no section ENTITIES"), std::string::npos);
}

TEST(DxfTags, Numbers) {
  EXPECT_EQ(dxf_real({10, "-1.5e-3", 1}), -1.5e-3);
  EXPECT_EQ(dxf_real({10, "+2", 1}), 2);
  EXPECT_EQ(dxf_integer({70, "12", 1}), 12);
  EXPECT_EQ(dxf_integer({70, "-3.0", 1}), -3);
  for (const char* bad : {"", "nan", "inf", "0x10", "1e400", "1 2", "+-1", "1,0", "1d0"})
    EXPECT_THROW(dxf_real({10, bad, 1}), InvalidInput) << bad;
  for (const char* bad : {"", "1.5", "99999999999", "nan", "1e300"})
    EXPECT_THROW(dxf_integer({70, bad, 1}), InvalidInput) << bad;
}

}  // namespace
}  // namespace bahnwerk
