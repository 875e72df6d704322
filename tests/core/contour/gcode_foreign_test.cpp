// Words that are not the program's own: of unknown M codes, of printers, controllers, hosts; and names of the control.
#include <algorithm>

#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

bool noted(const Contour& c, std::string_view part) {
  return std::any_of(c.notes.begin(), c.notes.end(), [&](const auto& n) { return n.find(part) != std::string::npos; });
}
std::string fault(std::string_view text, const GcodeOptions& options = {}) {
  const auto faults = gcode_faults(text, options);
  return faults.empty() ? "" : faults.front().message;
}

TEST(GcodeForeign, LettersBehindAnUnknownMWordAreItsOwn) {
  // End stops, drive settings, a feeder: none of it is a move, a feed or a speed.
  for (const char* word :
       {"M666 X-1 Y-1 Z-2", "M671 X-5:105 Y0:0", "M701 Z5 L20", "M569 P1 S0 X3", "M350 X16 Y16 I1", "M913 X50 Y50 Z50",
        "M123 I2 J3 K4 R5 A6", "M9999 X1 F1", "M1002 gcode_claim_action : 2", "M23 part.gco", "M567 P0 E1:1 X4"}) {
    const Contour c = read_gcode(std::string("G0 X1 Y2 Z3\nG1 X5 F600\n") + word + "\nX9\n");
    ASSERT_EQ(c.path.size(), 2u) << word;
    EXPECT_EQ(end_of(c), (Vec{9, 2, 0})) << word;
    EXPECT_EQ(c.height, 3) << word;
    EXPECT_EQ(c.blocks.back().feed, 10) << word;
    ASSERT_EQ(c.notes.size(), 1u) << word;
    EXPECT_EQ(c.notes[0].rfind("line 3: ", 0), 0u) << word;
  }
}

TEST(GcodeForeign, LettersBeforeItOrOfAGWordAreTheLines) {
  EXPECT_EQ(end_of(read_gcode("G0 X0 Y0\nG1 F60 X5\nX7 M123 P4")).x, 7);
  EXPECT_EQ(end_of(read_gcode("G0 X0 Y0\nM123 G1 X5 F60\n")).x, 5);
  EXPECT_EQ(end_of(read_gcode("G0 X0 Y0\nG1 X5 F60 M106 S255\n")).x, 5);
  EXPECT_EQ(end_of(read_gcode("G0 X0 Y0\nG1 X5 F60\nG90 M666 X1\nX8")).x, 8);
}

TEST(GcodeForeign, AToolChangeTakesNoCoordinates) {
  EXPECT_EQ(fault_lines("G0 X0 Y0 Z5\nM6 T2 X9 Z30\nG1 X5 F60"), (std::vector{2}));
  EXPECT_EQ(fault_lines("M6 T2 X9 Z30\nG1 X5 F60"), (std::vector{1}));
  EXPECT_EQ(end_of(read_gcode("G0 X0 Y0\nG1 X3 F60\nT2 M6 G1 X9")).x, 9);
  EXPECT_EQ(end_of(read_gcode("G0 X0 Y0\nG1 X3 F60\nX9 M6 T2")).x, 9);
}

TEST(GcodeForeign, HeadersOfPrinters) {
  const Contour c = read_gcode(
      "M862.3 P \"MK3S X9\"\nM862.1 P0.6 A1\nM115 U2.10.3\nM486 S1 A\"cube; small\"\nM486 ATop\nM204.2 K1.0\n"
      "M73 P0 R12\nM73.2 R1.0\nG28 W\nG28 O\nG29.2 S0\nM555 X5 Y5 W40 H40\nG90\nM83\nG1 X30 Y4 F600\nX40 E2.5\n");
  EXPECT_EQ(c.path.size(), 2u);
  EXPECT_EQ(end_of(c), (Vec{40, 4, 0}));
  EXPECT_TRUE(noted(c, "words of printers"));
  EXPECT_EQ(fault_lines("G1 X1\nM3.2\nX2"), (std::vector{2}));
  EXPECT_EQ(fault_lines("G28 U0 W0\nG1 X1"), (std::vector{1}));
  EXPECT_EQ(end_of(read_gcode("G28 XYZ\nG28 XY ; again\nG1 X5 F60")).x, 5);
  EXPECT_EQ(fault("G1 X1,5"), "line 1: a number has a point, no comma");
}

TEST(GcodeForeign, WhatWouldChangeAPrintersMotionIsNamed) {
  const Contour c = read_gcode(
      "M201 X500 Y500\nM206 X10\nM220 S50\nM220 S80\nM852 I0.01\nM104 S200\nG1 X30 F600\nM52 P1\nM50 P0\nX40\n");
  EXPECT_EQ(end_of(c).x, 40);
  EXPECT_EQ(c.blocks.back().feed, 10);
  EXPECT_TRUE(noted(c, "line 1: M201 sets limits of a printer's motion: skipped, the limits of the document hold"));
  EXPECT_TRUE(noted(c, "line 2: M206 shifts, turns or scales coordinates"));
  EXPECT_TRUE(noted(c, "line 3 and 1 more: M220 changes the feeds of a printer"));
  EXPECT_TRUE(noted(c, "line 5: M852 shifts, turns or scales coordinates"));
  EXPECT_TRUE(noted(c, "line 6: words of printers"));
  EXPECT_TRUE(noted(c, "line 8 and 1 more: overrides"));
}

TEST(GcodeForeign, MoreThan64MattersAreCounted) {
  std::string text = "G0 X0 Y0\nG1 X5 F60\n";
  for (int m = 1000; m < 1070; ++m) text += "M" + std::to_string(m) + "\n";
  const Contour c = read_gcode(text + "X6");
  EXPECT_EQ(c.notes.size(), 65u);
  EXPECT_TRUE(noted(c, "line 67 and 5 more: something else was left out"));
}

TEST(GcodeForeign, WordsOfOtherControlsAreNamed) {
  for (const char* text : {"IF [#1 EQ 1] GOTO 5", "GOTO 5", "WHILE [1] DO1", "END1"})
    EXPECT_NE(fault(std::string("G1 X5\n") + text).find("line 2: statements of macros"), std::string::npos) << text;
  EXPECT_NE(fault("G1 X=5").find("line 1: X=, the form of another control"), std::string::npos);
  EXPECT_NE(fault("G1 X5 Y=IC(3)").find("line 1: Y=, the form of another control"), std::string::npos);
}

TEST(GcodeForeign, LinesForTheController) {
  const Contour c = read_gcode("$X\n$110=4000\nG0 X0 Y0\n$H\nG0 X0 Y0\nG1 X10 F60\n$I");
  EXPECT_EQ(c.path.length(), 10);
  EXPECT_TRUE(noted(c, "line 1 and 3 more: $X: a command of the controller, left out"));
  EXPECT_NE(fault("G1 X5\n$J=G91 X5 F100").find("line 2: a jog ($J)"), std::string::npos);
  EXPECT_NE(fault("G1 X5\n?").find("a command of the controller (?), not of the program"), std::string::npos);
  // Homing leads away: nothing is cut from there.
  EXPECT_EQ(fault_lines("G0 X0 Y0\nG1 X10 F60\n$H\nX20"), (std::vector{4}));
  // LinuxCNC's number of a spindle.
  EXPECT_EQ(read_gcode("M3 $0 S100\nG1 X5 F60").path.length(), 5);
  EXPECT_EQ(fault_lines("M3 $1\nG1 X5"), (std::vector{1}));
}

TEST(GcodeForeign, MacrosOfAHostAreNamed) {
  for (const char* name :
       {"PRINT_START", "END_PRINT", "_WARM_UP", "OBJECT_DEFINE", "NEXT_LAYER", "GOTO_HOME", "M_START"})
    EXPECT_EQ(fault(std::string("G1 X5\n") + name + " A=1\n"),
              std::string("line 2: ") + name +
                  " is no word of a part program: a macro of a host, or a statement of "
                  "another control");
  EXPECT_EQ(fault("G1 X[FOO[1]]"), "line 1: there is no function foo");
  EXPECT_NE(fault("GOTO 10").find("statements of macros"), std::string::npos);
}

TEST(GcodeForeign, CommentsWithinComments) {
  EXPECT_NE(fault("G1 X5 (outer (inner) rest)").find("a comment stands within a comment"), std::string::npos);
  EXPECT_EQ(read_gcode("G1 X5 (outer (inner)\nX6 (a) (b)").path.length(), 6);
}

TEST(GcodeForeign, LookAheadIsNoSpline) {
  const Contour c =
      read_gcode("G05 P10000\nG08 P1\nG5.1 Q1 R5\nG0 X0 Y0\nG1 X8 F60\nG05 P0\nG5.1 Q0\nG187 P2 E0.1\nX9");
  EXPECT_EQ(c.path.length(), 9);
  EXPECT_TRUE(noted(c, "line 1 and 4 more: look-ahead"));
  EXPECT_EQ(c.notes.size(), 2u);
}

TEST(GcodeForeign, CancelsOfWhatIsNeverOn) {
  const Contour c =
      read_gcode("G8 G15 G17 G21 G40 G40.1 G49 H0 G50 G67 G69 G80 G90 G97\nG50.1 X0 Y0\nG0 G50 X1 Y0\nG1 X5 F60");
  EXPECT_EQ(c.path.length(), 4);
  EXPECT_TRUE(c.notes.empty());
  EXPECT_NE(fault("G50 X5\nG1 X6").find("use G92"), std::string::npos);
}

TEST(GcodeForeign, AFeedOfInverseTimeEndsWithIt) {
  EXPECT_NE(fault("F600 G0 X0 Y0\nG93\nG1 X10 F30\nG94\nX50").find("line 5: no feed after G94"), std::string::npos);
  EXPECT_NE(fault("G0 X0 Y0\nG93\nG1 X10 F30\nG94\nG81 X5 Z-1 R1").find("no feed after G94"), std::string::npos);
  const Contour c = read_gcode("G0 X0 Y0\nG93\nG1 X10 F30\nG94 F120\nX50\nG94\nX60");
  EXPECT_EQ(c.blocks.back().feed, 2);
  EXPECT_EQ(fault_lines("G93 F5\nG1 X10"), (std::vector{2}));  // F holds for its own line
}

TEST(GcodeForeign, PredefinedNames) {
  GcodeOptions options;
  options.work_offsets[1] = Vec{100, 0, 0};
  const Contour c = read_gcode(
      "G20 G55 F60 G0 X1 Y2\nS900 M3\nG21\n#<sum>=[#<_x>+#<_abs_x>+#<_metric>+2*#<_absolute>+#<_plane>+#<_feed>+"
      "#<_rpm>+#<_spindle_on>+#<_coord_system>+#<_line>]\nG1 Y0 X#<sum>",
      options);
  // 25.4 + 125.4 + 1 + 2 + 170 + 1524 + 900 + 1 + 550 + 4
  EXPECT_NEAR(end_of(c).x, 100 + 3302.8, 1e-9);
  EXPECT_EQ(end_of(read_gcode("F60 G1 X5\no1 if [EXISTS[#<_y>]]\nX7\no1 endif")).x, 7);
  EXPECT_EQ(end_of(read_gcode("G0 X2 Y0\nG1 F60 X[#5021+#5420+#5400]")).x, 4);
  EXPECT_NE(fault("G1 X#<_hal[pin]>").find("a value of the machine"), std::string::npos);
  EXPECT_NE(fault("#<_feed>=5\nG1 X1").find("kept by the control"), std::string::npos);
  EXPECT_EQ(end_of(read_gcode("#<_depth>=4\nG1 X#<_depth> F60")).x, 4);
  EXPECT_TRUE(noted(read_gcode("F60 G1 X[#5399+1]"), "#5399"));
}

TEST(GcodeForeign, TheDocumentSaysWhatTheTextDoesNot) {
  const Contour rapid = read_gcode("X5 Y5\nF60 G1 X9");
  EXPECT_EQ(rapid.path.length(), 4);
  EXPECT_TRUE(noted(rapid, "line 1: coordinates before any motion word: taken as G0"));
  EXPECT_EQ(fault_lines("G80\nX5 Y5\nG1 X9"), (std::vector{2}));
  EXPECT_EQ(read_gcode("F60 X5\nG0 X9", {.initial_motion = GcodeMotion::line}).blocks.front().mode, Mode::cut);
  EXPECT_TRUE(read_gcode("G1 F60 X5\nX6", {.initial_motion = GcodeMotion::line}).notes.empty());

  EXPECT_EQ(fault_lines("G70\nG1 X1"), (std::vector{1}));
  EXPECT_NEAR(read_gcode("G70 F60\nG1 X1\nG71 X20", {.g70_g71_units = true}).path.length(), 25.4 + 5.4, 1e-12);

  const char* absolute = "G0 X20 Y10\nG3 X10 Y20 I10 J10 F60";
  EXPECT_EQ(arc_of(read_gcode(absolute, {.absolute_centres = true}).path[0]).radius(), 10);
  EXPECT_NE(fault(absolute).find("is its centre absolute (G90.1"), std::string::npos);
  EXPECT_NE(fault("G0 X20 Y10\nG90.1 G3 X10 Y20 I-10 J0 F60").find("relative to the start (G91.1"), std::string::npos);
}

TEST(GcodeForeign, TheEndOfATextUnderDos) {
  const Contour c = read_gcode("F60 G1 X5\r\nX9\r\n\x1A");
  EXPECT_EQ(c.path.length(), 9);
  EXPECT_TRUE(c.notes.empty());
  EXPECT_TRUE(read_gcode(std::string("F60 G1 X5\n\x1A\x1A\0\0", 14)).notes.empty());
  EXPECT_EQ(read_gcode(std::string("F60 G1 X5\nX6\0\0\0", 15)).path.length(), 6);
  const Contour more = read_gcode("F60 G1 X5\n\x1A\nX99");
  EXPECT_EQ(more.path.length(), 5);
  EXPECT_TRUE(noted(more, "0x1A"));
}

TEST(GcodeForeign, ASubprogramBehindAMainProgramWithoutEnd) {
  const Contour c = read_gcode("O1\nF60 G1 X5\nM98 P100\nX9\nO100\nY3\nM99\n");
  EXPECT_EQ(c.path.length(), 12);
  EXPECT_EQ(end_of(c), (Vec{9, 3, 0}));
  EXPECT_TRUE(noted(c, "line 5: the main program ends before its subprogram, without M30"));
  EXPECT_EQ(fault_lines("O1\nF60 G1 X5\nO100\nY3\nM99\n"), (std::vector{3}));  // which nothing calls
}

TEST(GcodeForeign, PeckCyclesWithP) {
  const std::string begin = "F60 G0 X0 Y0 Z5\n", end = "\nG80";
  const auto lengths = [&](const std::string& cycle) {  // all of it, and what is fed
    const Contour c = read_gcode(begin + cycle + end);
    double fed = 0;
    for (const Block& block : c.blocks)
      for (std::size_t i = block.first; block.mode == Mode::cut && i < block.last; ++i) fed += c.path[i].length();
    return std::pair(c.path.length(), fed);
  };
  // Pecks at −1 and −4 of a hole from 2 to −6.
  const auto [all, fed] = lengths("G98 G83 Z-6 R2 Q3");
  EXPECT_NEAR(fed, 8 + 2 * 0.254, 1e-9);
  const auto [all_wide, fed_wide] = lengths("G98 G83 Z-6 R2 Q3 P1");
  EXPECT_NEAR(all_wide, all, 1e-9);
  EXPECT_NEAR(fed_wide, 8 + 2 * 1, 1e-9);
  EXPECT_NEAR(lengths("G98 G73 Z-6 R2 Q3 P1").first, lengths("G98 G73 Z-6 R2 Q3").first + 2 * 2 * (1 - 0.254), 1e-9);
  EXPECT_EQ(lengths("G98 G83 Z-6 R2 Q3 P0").second, fed);
  const Contour dwells = read_gcode(begin + "G98 G83 Z-6 R2 Q3 P4" + end);
  EXPECT_EQ(dwells.path.length(), all);
  EXPECT_EQ(dwells.dwell(), 4);
  EXPECT_TRUE(noted(dwells, "taken as a dwell"));
}

}  // namespace
}  // namespace bahnwerk
