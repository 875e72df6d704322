// What is refused, and that every fault tells its line.
#include <algorithm>

#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

TEST(GcodeFaults, RefusedWords) {
  for (const char* word : {"G41 D1",
                           "G42",
                           "G41.1",
                           "G95",
                           "G96",
                           "G92",
                           "G52 G92 X0",
                           "G10 L2 P10",
                           "G10 L2 P1 R5",
                           "G10 L1 P1",
                           "G94 G93",
                           "G54 G55",
                           "G98 G99",
                           "G73 Z-1 R1 X2",
                           "G81",
                           "G81 Z-5",
                           "G81 R1 X5",
                           "G81 Z5 R1",
                           "G81 Z-5 R1 L0",
                           "G81 Z-5 R1 L1.5",
                           "G81 Z-5 R1 Q1",
                           "G82 Z-5 R1",
                           "G82 Z-5 R1 P-1",
                           "G83 Z-5 R1",
                           "G83 Z-5 R1 Q0",
                           "G83 Z-5 R1 Q0.00001",
                           "G84 Z-5 R1",
                           "G87 Z-5 R1",
                           "G88 Z-5 R1",
                           "G76",
                           "G33 K1",
                           "G38.2 Z-1",
                           "G68",
                           "G51",
                           "G16",
                           "G7",
                           "G5.2",
                           "G43.2",
                           "G65 P1",
                           "G44",
                           "G12",
                           "G999",
                           "G2.5",
                           "M98 P100",
                           "M97",
                           "#1",
                           "#0=1",
                           "#10000=1",
                           "#1.5=1",
                           "#5220=2",
                           "#<x>=",
                           "X#<x>",
                           "X[1",
                           "X[1]]",
                           "X[]",
                           "X[1/0]",
                           "X[1 MOD 0]",
                           "X[SQRT[-1]]",
                           "X[LN[0]]",
                           "X[ACOS[2]]",
                           "X[10**400]",
                           "X[10**10]",
                           "X[1 2 +]",
                           "X[SIN 30]",
                           "X[ATAN[1]]",
                           "X[FOO[1]]",
                           "X[EXISTS[#1]]",
                           "X[1 EQ]",
                           "X1=2",
                           "IF [#1 EQ 2] GOTO 10",
                           "WHILE [#1 LT 2] DO1",
                           "o1 call",
                           "o1 if",
                           "o1 if [1]",
                           "o1 else",
                           "o1 endif",
                           "o1 while [0]",
                           "o1 endwhile",
                           "o1 repeat [2]",
                           "o1 break",
                           "o1 return",
                           "o1 endsub",
                           "M98",
                           "M98 P1.5",
                           "A5",
                           "B0",
                           "C1",
                           "U1",
                           "V1",
                           "W1",
                           "L2",
                           "R5",
                           "I1",
                           "P1",
                           "Q1",
                           "o1 sub",
                           "$J=G91 X5 F100",
                           "M3 $1",
                           "X5 $H",
                           "@5",
                           "X1 ,C2",
                           "X1 \"a\"",
                           "X1*71",
                           "{\"sr\":null}",
                           "PRINT_START BED=60",
                           "_HOME",
                           "OBJECT_NAME",
                           "X1 (a (b) c)",
                           "G31 Z-1",
                           "G37 Z-1",
                           "G15 H2",
                           "G55 H2",
                           "G50 X5",
                           "G50.1 X0 R1",
                           "G51.1 X0",
                           "G70",
                           "G71",
                           "G54.1 P1",
                           "G17.1",
                           "G7.1",
                           "G28.1 R1",
                           "G10 P1 R5",
                           "M72",
                           "M6 T2 X5",
                           "X1.0E-5",
                           "X5E2",
                           "X12.5E-3",
                           "D-3 X1",
                           "G83 Z-5 R1 Q1 P-1",
                           "#<_x>=1",
                           "#5021=1",
                           "X#<_task>",
                           "X#<_ini[setup]x>",
                           "?",
                           "X",
                           "F0",
                           "F-5",
                           "M3.1",
                           "G1 G2",
                           "G20 G21",
                           "G90 G91",
                           "G17 G18",
                           "M3 M5",
                           "M62 M63",
                           "X1 X2",
                           "X999999999999",
                           "G5 X1",
                           "G2 X5",
                           "G2 X5 R0",
                           "G2 X5 I1 R2",
                           "G3 X5 I3 J3",
                           "G2 R5",
                           "G2 I0 J0",
                           "G2 X4 I2 K1",
                           "G90.1 G2 X4 I2",
                           "G18 G2 X5 J1",
                           "G5 I1 X5 P0 Q0",
                           "G5 X5 P0 Q0",
                           "G5 I1 J1 X5 P0",
                           "G5 I1 J1 P1 Q1 Z3",
                           "G18 G5 I1 J1 P1 Q1 X5",
                           "G5.1 X5",
                           "G5.1 X5 I0 J0",
                           "G19 G5.1 X5 I1",
                           "(open",
                           "X1)"}) {
    // Line 3 is wrong, and nothing else is.
    const auto lines = fault_lines(std::string("G21 G90\nG1 X2 Y2 F100\n") + word + "\nG90 G21 G17 G1 X10 Y10\n");
    EXPECT_TRUE(!lines.empty() && std::all_of(lines.begin(), lines.end(), [](int n) { return n == 3; })) << word;
  }
}

TEST(GcodeFaults, SayWhatIsWrong) {
  const auto message = [](std::string_view text) {
    const auto faults = gcode_faults(text);
    return faults.empty() ? std::string() : faults.front().message;
  };
  EXPECT_EQ(message("G1 X1\nG41 D3 X2"), "line 2: the document gives no cutter_radius for D3");
  EXPECT_EQ(
      message("G1 X1\nX2 G95"),
      "line 2: G95: feed per revolution is not supported: use G94 with F per minute, which needs no spindle speed");
  EXPECT_EQ(message("G1 X5\nG80\nX6"), "line 3: coordinates without a motion: none of G0 … G3, G5, G5.1 is in force");
  EXPECT_EQ(message("G0 X10 Y0\nG3 X0 Y12 I-10"),
            "line 2: the arc's radii at start and end differ by more than the tolerance");
  EXPECT_EQ(message("G1 X1 A90"), "line 1: the rotary axis A is not supported: only X, Y and Z are");
}

TEST(GcodeFaults, AllAreCollectedInOrder) {
  EXPECT_EQ(fault_lines("G55 G2 G3\nG1 X1\nG41\nX2 A1\nG2 X3\nG2 X9 I1\nG1 X[#4\nX5"), (std::vector{1, 3, 4, 5, 6, 7}));
}

TEST(GcodeFaults, OneFaultDoesNotCauseTheNext) {
  // The arc of line 2 lacks its centre, that of line 3 has a wrong one: those behind start where they should.
  EXPECT_EQ(fault_lines("G0 X10 Y0\nG3 X0 Y10\nG3 X-10 Y0 I3 J-10\nG3 X0 Y-10 I10\nG5 I1 J0 P0 Q1 X5 Y5"),
            (std::vector{2, 3}));
}

TEST(GcodeFaults, OneMessagePerCause) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text.append("G1 X").append(std::to_string(i)).append(i % 2 == 0 ? "A1\n" : "W1\n");
  const auto faults = gcode_faults(text);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].message, "line 1 and 49999 more: the rotary axis A is not supported: only X, Y and Z are");
  EXPECT_EQ(faults[1].message, "line 2 and 49999 more: the second linear axis W is not supported: only X, Y and Z are");
}

TEST(GcodeFaults, ReportsAtMostAHundredCauses) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text.append("G1 G").append(std::to_string(200 + i % 9000)).append(" X1\n");
  const auto lines = fault_lines(text);
  ASSERT_EQ(lines.size(), 100u);
  EXPECT_EQ(lines.back(), 100);
}

TEST(GcodeFaults, NothingToMoveAlong) {
  for (const char* text : {"", "\n", "%\n%\n", "(nothing)\nM30", "G0 X5 Y5", "G0 X5 Y5\nG1 X5 Y5\n", "M30\nG1 X5"})
    EXPECT_EQ(fault_lines(text).size(), 1u) << text;
}

TEST(GcodeFaults, ASecondProgramIsNotReadAlong) {
  EXPECT_EQ(fault_lines("O1\nG1 X10\nO2\nG1 X20\nM30"), (std::vector{3}));
}

TEST(GcodeFaults, TooLongProgramsAreFaults) {
  std::string text = "G1\n";
  for (int i = 1; i <= 20; ++i) text.append("X").append(std::to_string(i)).append(1, '\n');
  EXPECT_EQ(read_gcode(text, {.max_segments = 20}).path.size(), 20u);
  EXPECT_EQ(fault_lines(text, {.max_segments = 19}), (std::vector{21}));
  EXPECT_EQ(fault_lines("G0 X1 Y0\nG2 I-1 P1000\nG2 I-1 P1000\n", {.max_segments = 1000}), (std::vector{3}));
}

TEST(GcodeFaults, PlacesStayFinite) {
  std::string text = "G20 G91 G1\n";
  for (int i = 0; i < 50; ++i) text += "X999999999\n";
  const auto lines = fault_lines(text);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.front(), 2);
}

}  // namespace
}  // namespace bahnwerk
