#include "core/contour/gcode/words/words.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::gcode {
namespace {

Line only(std::string_view text) {
  Lines lines(text);
  Line line;
  EXPECT_TRUE(lines.next(line, true));
  return line;
}

TEST(GcodeWords, LettersAndNumbers) {
  const Line line = only("N10 G1 X12.5 y-.25 Z+3. F600");
  EXPECT_EQ(line.fault, "");
  ASSERT_EQ(line.g_count, 1u);
  EXPECT_EQ(line.g[0], 10);
  EXPECT_EQ(line['N'], 10);
  EXPECT_EQ(line['X'], 12.5);
  EXPECT_EQ(line['Y'], -0.25);
  EXPECT_EQ(line['Z'], 3);
  EXPECT_EQ(line['F'], 600);
  EXPECT_FALSE(line.has('I'));
}

TEST(GcodeWords, BlanksMayStandAnywhere) {
  const Line line = only("g 0 x +0. 12 34\tY 7 Z - 1 .5");
  EXPECT_EQ(line.fault, "");
  EXPECT_EQ(line.g[0], 0);
  EXPECT_EQ(line['X'], 0.1234);
  EXPECT_EQ(line['Y'], 7);
  EXPECT_EQ(line['Z'], -1.5);
}

TEST(GcodeWords, CodesHaveADecimal) {
  const Line line = only("G5.1 G90.1 G059.3 M03 m 62");
  ASSERT_EQ(line.g_count, 3u);
  EXPECT_EQ(line.g[0], 51);
  EXPECT_EQ(line.g[1], 901);
  EXPECT_EQ(line.g[2], 593);
  ASSERT_EQ(line.m_count, 2u);
  EXPECT_EQ(line.m[0], 3);
  EXPECT_EQ(line.m[1], 62);
  EXPECT_NE(only("G1.25").fault, "");
  EXPECT_NE(only("M3.5").fault, "");
  EXPECT_NE(only("G-1").fault, "");
}

TEST(GcodeWords, CommentsAndEnds) {
  const Line line = only("G1 (to ; the (left) X10 ; Y5 (");
  EXPECT_EQ(line.fault, "");
  EXPECT_EQ(line['X'], 10);
  EXPECT_FALSE(line.has('Y'));
  EXPECT_NE(only("G1 (open X10\nX5").fault, "");
  EXPECT_NE(only("G1 X10)").fault, "");
  EXPECT_TRUE(only("  % O1000 tape").percent);
  EXPECT_EQ(only(";G\xC3\xA4nge (").fault, "");
}

TEST(GcodeWords, BlockDelete) {
  EXPECT_TRUE(only("/ G1 X1").empty());
  EXPECT_TRUE(only(" /2 G1 X1").slash);
  Lines lines("/3 G1 X1\n");
  Line line;
  EXPECT_TRUE(lines.next(line, false));
  EXPECT_TRUE(line.slash);
  EXPECT_EQ(line['X'], 1);
  EXPECT_NE(only("G1 X4/2").fault, "");
}

TEST(GcodeWords, EveryKindOfLineEndCounts) {
  Lines lines("\xEF\xBB\xBFX1\r\nX2\rX3\n\nX5");
  Line line;
  std::vector<std::pair<std::size_t, double>> seen;
  while (lines.next(line, true))
    if (line.has('X')) seen.emplace_back(line.number, line['X']);
  EXPECT_EQ(seen, (std::vector<std::pair<std::size_t, double>>{{1, 1}, {2, 2}, {3, 3}, {5, 5}}));
}

TEST(GcodeWords, TextThatIsNoNumberIsAFault) {
  for (const char* text :
       {"X",
        "X-",
        "X--1",
        "X1.2.3",
        "X.",
        "X1-2",
        "Xnan",
        "Xinf",
        "X0x10",
        "X1e400",
        "X1E5 E2",
        "X#1",
        "#1=5",
        "X[1+2]",
        "X1 X2",
        "X1,5",
        "X1*71",
        "G1 \xE4",
        "X99999999999",
        "X1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 "
        "8 9 0 1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9",
        "o<name call",
        "o<> call",
        "O",
        "O[1] call"}) {
    const Line line = only(text);
    EXPECT_TRUE(!line.fault.empty() || line.has('E')) << text;  // E is a letter like any other, of no meaning
  }
  EXPECT_EQ(only("N123456789012345 X1").fault, "");
  EXPECT_EQ(only("X" + std::string(300, '0') + "1").fault, "");
}

TEST(GcodeWords, NumbersAreReadExactly) {
  EXPECT_EQ(only("X0.1")['X'], 0.1);
  EXPECT_EQ(only("X-123456.789012")['X'], -123456.789012);
  EXPECT_EQ(only("X3.14159265358979323846")['X'], 3.14159265358979323846);
}

}  // namespace
}  // namespace bahnwerk::gcode
