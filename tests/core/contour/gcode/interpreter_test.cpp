// Cut or position, feeds, blocks, what is noted; and programs as they come from a shop.
#include "core/contour/gcode/interpreter.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

/// "c10 p p5": mode and feed of each block, no number = unlimited.
std::string blocks(const Contour& c) {
  std::string text;
  std::size_t next = 0;
  for (const Block& b : c.blocks) {
    EXPECT_EQ(b.first, next);
    next = b.last;
    if (!text.empty()) text += ' ';
    text += b.mode == Mode::cut ? 'c' : 'p';
    if (std::isfinite(b.feed)) text += std::to_string(std::lround(b.feed));
  }
  EXPECT_EQ(next, c.path.size());
  return text;
}
std::string blocks(std::string_view text, const GcodeOptions& options = {}) {
  return blocks(read_gcode(text, options));
}

bool noted(const Contour& c, std::string_view begin, std::string_view part) {
  for (const std::string& note : c.notes)
    if (note.rfind(begin, 0) == 0 && note.find(part) != std::string::npos) return true;
  return false;
}

TEST(GcodeModes, OnlyG0PositionsWithoutASwitch) {
  EXPECT_EQ(blocks("G0 X0 Y0\nG1 X10\nX20 F600\nG2 X30 R5\nG0 X0\nG1 Y5\nY6 F1200"), "c c10 p c10 c20");
}

TEST(GcodeModes, ASwitchDividesCuttingFromPositioning) {
  for (const char* text : {"F600 G1 X10\nM3 X20\nX30 M5\nG0 X40\nM4\nG1 X50\nG0 X60",
                           "F600 G1 X10\nM62 P1 X20\nX30 M63 P1\nG0 X40\nM64 P1\nG1 X50\nG0 X60"})
    EXPECT_EQ(blocks(text), "p10 c10 p10 p c10 p") << text;
}

TEST(GcodeModes, BothSwitchesHaveToBeOn) {
  EXPECT_EQ(blocks("F60 G1 X1\nM3\nX2\nM62\nX3\nM63\nX4\nM62 X5\nM5 X6"), "p1 c1 p1 c1 p1");
}

TEST(GcodeModes, EqualNeighboursAreOneBlock) {
  // Before the switch everything positions: G0 and G1 without a feed are the same then.
  EXPECT_EQ(blocks("G1 X1\nG0 X2\nG1 X3\nM3\nX4"), "p c");
  EXPECT_EQ(blocks("F60\nM3\nG1 X1\nM5\nM3\nX2\nF60 X3"), "c1");
}

TEST(GcodeModes, AProgramThatNeverSwitchesOnHasNoSwitch) {
  EXPECT_EQ(blocks("F60 G1 X1\nM5\nX2\nG0 X3\nM5\nM30"), "c1 p");
  EXPECT_EQ(blocks("M5 M9\nF60 G1 X1\nM3 X2\nM5"), "p1 c1");
}

TEST(GcodeModes, OnlyOneOutputIsTheSwitch) {
  const char* text = "F60 G1\nM64 P2\nX1\nM64 P0\nX2\nM65 P2\nX3\nM65 P0\nX4";
  EXPECT_EQ(blocks(text), "c1 p1");
  EXPECT_EQ(blocks(text, {.output = 0}), "p1 c1 p1");
  EXPECT_TRUE(noted(read_gcode(text), "line 4 and 1 more: ", "output"));
}

TEST(GcodeModes, FeedBeforeTheFirstF) {
  EXPECT_EQ(blocks("G1 X1\nF120 X2"), "c c2");
  EXPECT_EQ(blocks("G1 X1\nF120 X2", {.feed = 5}), "c5 c2");
  EXPECT_EQ(fault_lines("G1 X1\nX2", {.feed = -1}), (std::vector{1}));
}

TEST(GcodeModes, MotionIsModal) {
  const Contour c = read_gcode("G1\nX10\nN20 Y10\nG2 X20 I5\nX30 I5\nG80\nG0\nX0 Y0");
  ASSERT_EQ(c.path.size(), 5u);
  EXPECT_NEAR(c.path[3].length(), 5 * pi, 1e-12);
  EXPECT_EQ(blocks(c), "c p");
  // A header names everything at once; its motion holds.
  EXPECT_EQ(blocks("G0 G17 G40 G49 G80 G90 G94\nX5 Y5\nX6\nG1 X7"), "p c");
}

TEST(GcodeModes, DwellsTakeTheirOwnWords) {
  const std::vector<std::pair<std::string, double>> dwells{{"G4 P0.5", 0.5}, {"G4 X1.5", 1.5}, {"G04 F2", 2},
                                                           {"G4 U3", 3},     {"G4 S4", 4},     {"G4 P1 S800", 1},
                                                           {"G4 P2 F60", 2}, {"G4", 0}};
  for (const auto& [dwell, seconds] : dwells) {
    const Contour c = read_gcode("F60 G1 X10\n" + dwell + "\nX20\n" + dwell + "\n");
    EXPECT_NEAR(c.path.length(), 20, 1e-12) << dwell;
    EXPECT_EQ(blocks(c), "c1") << dwell;
    EXPECT_TRUE(noted(c, "line 2 and 1 more: ", "dwell")) << dwell;
    EXPECT_TRUE(noted(c, "line 2", ", " + std::to_string(std::lround(2 * seconds)) + " s in all")) << dwell;
    ASSERT_EQ(c.rests.size(), 2u) << dwell;
    EXPECT_EQ(c.rests[0].segment, 1u) << dwell;
    EXPECT_EQ(c.rests[1].segment, 2u) << dwell;
    for (const Rest& rest : c.rests) {
      EXPECT_EQ(rest.seconds, seconds) << dwell;
      EXPECT_EQ(rest.block, 0u) << dwell;
    }
  }
  const Contour before = read_gcode("G1 X10\nG4 P1 X20");  // the dwell comes before the motion of its line
  EXPECT_NEAR(before.path.length(), 20, 1e-12);
  ASSERT_EQ(before.rests.size(), 1u);
  EXPECT_EQ(before.rests[0].segment, 1u);
  EXPECT_EQ(fault_lines("G1 X10\nG4 X1 Y2\nG4 P-1\nG4 P86401\nG4 G4 P1"), (std::vector{2, 3, 5}));
  EXPECT_EQ(fault_lines("G4 P5\nM30"), (std::vector{2}));  // nothing moves
}

/// "c.5@0": mode of the block, seconds and segment of each rest.
std::string rests(std::string_view text) {
  const Contour c = read_gcode(text);
  std::string list;
  for (const Rest& rest : c.rests) {
    char one[60];
    std::snprintf(one, sizeof one, "%s%c%g@%zu", list.empty() ? "" : " ",
                  c.blocks.at(rest.block).mode == Mode::cut ? 'c' : 'p', rest.seconds, rest.segment);
    list += one;
  }
  return list;
}

TEST(GcodeModes, ADwellBelongsToWhatTheToolDoes) {
  // Without a switch: G0 positions.
  EXPECT_EQ(rests("G0 X1 Y1\nG4 P1\nF60 G1 X5\nG4 P2\nG0 X9\nG4 P3"), "p1@0 c2@1 p3@2");
  // With one: the tool counts, and before it is first used nothing cuts.
  const char* pierced = "G0 X1 Y1\nF60 G4 P1\nM3\nG4 P2\nG1 X5\nM5\nG4 P3\nG0 X9\nG4 P4\nM3\nG4 P5\n";
  EXPECT_EQ(rests(pierced), "p1@0 c2@0 p3@1 p4@2 c5@2");
  EXPECT_EQ(blocks(pierced), "p c1 p c");
  EXPECT_EQ(rests("F60 G1 X1\nG4 P1\nM3\nX2\nG4 P2"), "p1@1 c2@2");
  // A switch acts before the dwell of its line.
  EXPECT_EQ(rests("F60 G1 X1\nM3 G4 P1\nX2\nM5 G4 P2"), "c1@1 p2@2");
  // Those of one place keep their blocks; feeds do not divide them.
  EXPECT_EQ(blocks("F60 M3 G1 X1\nG4 P1\nF120 X2\nM5\nG4 P1\nM3\nG4 P1\nF180 X3"), "c1 c2 p2 c3");
}

TEST(GcodeModes, MovesWithoutAFeedAreNoted) {
  const Contour c = read_gcode("G0 X5 Y5\nG1 X10\nY7\nG2 X20 R8\nF60 X30 R8\nG0 X0\nG1 X9");
  EXPECT_TRUE(noted(c, "line 2 and 2 more: ", "without F")) << c.notes.at(0);
  EXPECT_EQ(c.notes.size(), 1u);
  EXPECT_TRUE(read_gcode("G0 X5 Y5\nX6\nF60 G1 X10").notes.empty());
  EXPECT_TRUE(read_gcode("G1 X10", {.feed = 5}).notes.empty());
}

TEST(GcodeModes, OneHeightIsKept) {
  const Contour c = read_gcode("G0 X0 Y0 Z-3\nF60 G1 X10\nG2 X20 R5");
  EXPECT_EQ(c.dimension, 2u);
  EXPECT_EQ(c.height, -3);
  EXPECT_EQ(c.path.at(5).value.z, 0);
  EXPECT_EQ(read_gcode("G0 X0 Y0 Z-3\nF60 G1 X10 Z-4").height, 0);
}

TEST(GcodeModes, IgnoredModesAreNoted) {
  const Contour c = read_gcode(
      "%\nO1000 (part)\nT1 M6\nG54 G64 P0.01\nS1000 M3\nG43 H1\n/ G1 X99\nG1 X10 F60 D3\nM0\nM4 S0\nM123 "
      "P4\nX20\nM30\n%\n"
      "G1 X500");
  EXPECT_TRUE(noted(c, "line 3: ", "M6"));
  EXPECT_TRUE(noted(c, "line 4: ", "G64"));
  EXPECT_TRUE(noted(c, "line 6: ", "G43"));
  EXPECT_TRUE(noted(c, "line 7: ", "block delete"));
  EXPECT_TRUE(noted(c, "line 9: ", "M0"));
  EXPECT_TRUE(noted(c, "line 10: ", "S0"));
  EXPECT_TRUE(noted(c, "line 11: ", "M123"));
  EXPECT_TRUE(noted(c, "line 15: ", "end"));
  EXPECT_EQ(c.notes.size(), 8u);
  EXPECT_NEAR(c.path.length(), 20, 1e-12);
}

TEST(GcodeModes, WordsOfPrintersAreSkipped) {
  const Contour c = read_gcode(
      "M82 ; absolute\nM104 S200\nG28 X Y\nG1 Z5 F3000\nG92 E0\nM109 S200\nG1 F3600 E-4\nM201 X500 Y500 "
      "Z50\nG29\nG10\nG1 "
      "X10 Y2 E5.5\nM117 Hot [end #1 (\nG11\nX20 E6\nM84 X Y\nM106 S255");
  EXPECT_EQ(c.path.size(), 3u);
  expect_near(end_of(c), {20, 2, 5}, 0);
  ASSERT_EQ(c.notes.size(), 3u);
  EXPECT_TRUE(noted(c, "line 1 and ", "printers"));
  EXPECT_TRUE(noted(c, "line 8: ", "M201"));
}

TEST(GcodeModes, AToolsLengthIsNoMove) {
  EXPECT_EQ(read_gcode("F60 G1 X5\nG43.1 Z-3 X1\nX9").path.size(), 2u);
  EXPECT_EQ(read_gcode("F60 G1 X5\nG43 H1 Z-3\nX9").path.size(), 3u);
}

TEST(GcodeModes, BlockDeleteMayBeOff) {
  EXPECT_NEAR(read_gcode("G1 X10\n/X5\nX20").path.length(), 20, 1e-12);
  EXPECT_NEAR(read_gcode("G1 X10\n/X5\nX20", {.block_delete = false}).path.length(), 30, 1e-12);
}

TEST(GcodeModes, TheProgramEnds) {
  for (const char* end : {"M2", "m30", "X20 M30"}) {
    const Contour c = read_gcode(std::string("%\nG1 X10\n") + end + "\nX100 #bad\n");
    EXPECT_LE(c.path.length(), 20) << end;
  }
  EXPECT_NEAR(read_gcode("%\nG1 X10\n%\nX100").path.length(), 10, 1e-12);
}

TEST(GcodeModes, MachinePointsBeforeAndBehindTheContour) {
  const Contour c = read_gcode("G28 G91 Z0.\nG90\nG0 X10 Y0\nG1 X20\nG53 G0 Z0\nG91 G28 X0 Y0\nM30");
  EXPECT_NEAR(c.path.length(), 10, 1e-12);
  EXPECT_EQ(c.dimension, 2u);
  EXPECT_TRUE(noted(c, "line 1 and 2 more: ", "G28"));
  EXPECT_EQ(fault_lines("G0 X10 Y0\nG1 X20\nG28 X0\nG1 Y5\nX6"), (std::vector{4}));
}

// A plate as a CAM system would write it: a slot in the middle, then the outline with rounded corners, laser by M3/M5.
TEST(GcodeModes, APlateFromAShop) {
  const std::string unix_text =
      "%\n"
      "O0042 (BASE PLATE 120 X 80, 3 MM)\n"
      "(TOOL: LASER)\n"
      "N10 G17 G21 G40 G49 G80 G90 G94\n"
      "N20 G54\n"
      "N30 G0 X40. Y35.\n"
      "N40 M3 S2000\n"
      "N50 G4 P0.2 (PIERCE)\n"
      "N60 G1 X80. F2400.\n"
      "N70 G3 X80. Y45. I0. J5.\n"
      "N80 G1 X40.\n"
      "N90 G3 X40. Y35. R5.\n"
      "N100 M5\n"
      "N110 G0 X10. Y0. ; outline\n"
      "N120 M3\n"
      "N130 G1 X110. F3000.\n"
      "N140 G3 X120. Y10. J10.\n"
      "N150 G1 Y70.\n"
      "N160 G3 X110. Y80. I-10.\n"
      "N170 G1 X10.\n"
      "N180 G3 X0. Y70. J-10.\n"
      "N190 G1 Y10.\n"
      "N200 G3 X10. Y0. I10.\n"
      "N210 M5\n"
      "N220 G0 X0. Y100.\n"
      "N230 M30\n"
      "%\n";
  std::string dos, shouted;
  for (char ch : unix_text) {
    if (ch == '\n') dos += '\r';
    dos += ch;
    shouted += static_cast<char>(std::tolower(static_cast<unsigned char>(ch)));
  }
  for (const std::string& text : {unix_text, dos, shouted}) {
    const Contour c = read_gcode(text);
    EXPECT_EQ(blocks(c), "c40 p c50 p");
    EXPECT_EQ(c.dimension, 2u);
    EXPECT_EQ(c.path.size(), 4u + 1 + 8 + 1);
    expect_joined(c);
    expect_near(begin_of(c), {40, 35, 0}, 0);
    expect_near(end_of(c), {0, 100, 0});
    const double slot = 80 + 10 * pi, outline = 2 * 100 + 2 * 60 + 20 * pi;
    EXPECT_NEAR(c.path.length(), slot + std::hypot(30, 35) + outline + std::hypot(10, 100), 1e-11);
    // Rounded corners are smooth: the only corners are where the two positioning moves meet the slot and the outline.
    int corners = 0;
    for (const Joint& joint : joints(c.path)) corners += joint.angle > 1e-9;
    EXPECT_EQ(corners, 3);
    EXPECT_EQ(c.notes.size(), 1u);  // the dwell
  }
}

}  // namespace
}  // namespace bahnwerk
