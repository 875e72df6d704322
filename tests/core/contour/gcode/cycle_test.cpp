// Canned cycles, and inverse time feed.
#include <cmath>
#include <numbers>

#include "core/numeric/random.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

/// Both programs make the same moves, with the same modes and feeds, and rest at the same places.
void expect_same(const std::string& text, const std::string& moves) {
  const Contour a = read_gcode(text), b = read_gcode(moves);
  ASSERT_EQ(a.path.size(), b.path.size()) << text << "\n--\n" << moves;
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    expect_near(begin_of(a.path[i]), begin_of(b.path[i]), 1e-12);
    expect_near(end_of(a.path[i]), end_of(b.path[i]), 1e-12);
  }
  ASSERT_EQ(a.blocks.size(), b.blocks.size()) << text;
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].mode, b.blocks[i].mode) << text << i;
    EXPECT_EQ(a.blocks[i].feed, b.blocks[i].feed) << text << i;
    EXPECT_EQ(a.blocks[i].last, b.blocks[i].last) << text << i;
  }
  ASSERT_EQ(a.rests.size(), b.rests.size()) << text;
  for (std::size_t i = 0; i < a.rests.size(); ++i) {
    EXPECT_EQ(a.rests[i].segment, b.rests[i].segment) << text << i;
    EXPECT_EQ(a.rests[i].seconds, b.rests[i].seconds) << text << i;
  }
}

const std::string head = "F60 G0 X1 Y2 Z3\n";

TEST(GcodeCycles, TheExamplesOfTheReport) {
  // NISTIR 6556, 3.5.16.3.
  expect_same(head + "G90 G81 G98 X4 Y5 Z1.5 R2.8", head + "G0 X4 Y5\nZ2.8\nG1 Z1.5\nG0 Z3");
  expect_same(head + "G91 G81 G98 X4 Y5 Z-0.6 R1.8 L3",
              head + "G0 Z4.8\nX5 Y7\nG1 Z4.2\nG0 Z4.8\nX9 Y12\nG1 Z4.2\nG0 Z4.8\nX13 Y17\nG1 Z4.2\nG0 Z4.8");
}

TEST(GcodeCycles, EachIsItsMoves) {
  const std::string at = head + "G0 X4 Y5\nZ2\n", end = "G0 Z3\n";
  expect_same(head + "G81 X4 Y5 R2 Z-1", at + "G1 Z-1\n" + end);
  expect_same(head + "G82 X4 Y5 R2 Z-1 P0.5", at + "G1 Z-1\nG4 P.5\n" + end);
  expect_same(head + "G83 X4 Y5 R2 Z-1 Q1.25", at + "G1 Z.75\nG0 Z2\nZ1.004\nG1 Z-.5\nG0 Z2\nZ-.246\nG1 Z-1\n" + end);
  expect_same(head + "G73 X4 Y5 R2 Z-1 Q1.25", at + "G1 Z.75\nG0 Z1.004\nG1 Z-.5\nG0 Z-.246\nG1 Z-1\n" + end);
  expect_same(head + "G73 X4 Y5 R2 Z-1 Q1.5", at + "G1 Z.5\nG0 Z.754\nG1 Z-1\n" + end);
  expect_same(head + "G85 X4 Y5 R2 Z-1", at + "G1 Z-1\nZ3");
  expect_same(head + "G86 X4 Y5 R2 Z-1 P1", at + "G1 Z-1\nG4 P1\n" + end);
  expect_same(head + "G89 X4 Y5 R2 Z-1 P1", at + "G1 Z-1\nG4 P1\nG1 Z3");
}

TEST(GcodeCycles, WordsHold) {
  expect_same(head + "G99 G81 X4 Y5 R2 Z-1\nX6\nY9 Z-2\nG98 X7\nG80\nG0 X0",
              head + "G0 X4 Y5\nZ2\nG1 Z-1\nG0 Z2\nX6\nG1 Z-1\nG0 Z2\nY9\nG1 Z-2\nG0 Z2\nX7\nG1 Z-2\nG0 Z3\nX0");
  // The level to go back to is that before the first of a series.
  expect_same(head + "G99 G81 X4 Y5 R2 Z-1\nG98 G85 X5 R1 Z0\nG0 X9\nG81 X8 R5 Z4",
              head + "G0 X4 Y5\nZ2\nG1 Z-1\nG0 Z2\nX5\nZ1\nG1 Z0\nZ3\nG0 X9\nZ5\nX8\nG1 Z4\nG0 Z5");
  // Levels stay levels where the holes go on by increments, and keep their units.
  expect_same(
      head + "G81 X4 Y5 R2 Z-1\nG91 X2 L2\nG20 G90 X1",
      head + "G0 X4 Y5\nZ2\nG1 Z-1\nG0 Z3\nX6\nZ2\nG1 Z-1\nG0 Z3\nX8\nZ2\nG1 Z-1\nG0 Z3\nX25.4\nZ2\nG1 Z-1\nG0 Z3");
  // A cycle that begins anew needs its words.
  EXPECT_EQ(fault_lines(head + "G81 X4 R2 Z-1\nG0 X1\nG81 X5"), (std::vector{4, 4}));
}

TEST(GcodeCycles, WorkInOtherPlanesAndUnits) {
  expect_same(head + "G18 G81 X4 Z5 R3 Y-1", head + "G0 Y3\nX4 Z5\nG1 Y-1\nG0 Y3");
  expect_same(head + "G19 G81 Y4 Z5 R3 X-1", head + "G0 X3\nY4 Z5\nG1 X-1\nG0 X3");
  expect_same(head + "G20 G81 X1 R2 Z1", head + "G0 Z50.8\nX25.4\nG1 Z25.4\nG0 Z50.8");
}

TEST(GcodeCycles, TheToolMayBeSwitched) {
  const Contour c = read_gcode("F60 G0 X0 Y0 Z5\nM3\nG81 X1 R2 Z-1\nM5\nX2");
  int cuts = 0;
  for (const Block& block : c.blocks) cuts += block.mode == Mode::cut;
  EXPECT_EQ(cuts, 1);
}

TEST(GcodeCycles, RandomRowsAreTheirMoves) {
  Random random(5);
  for (int run = 0; run < 300; ++run) {
    const bool incremental = random.chance(0.5), to_start = random.chance(0.5), pecks = random.chance(0.3);
    const double r = std::round(random.uniform(-3, 3) * 8) / 8, depth = std::round(random.uniform(0.5, 9) * 8) / 8;
    const int holes = 1 + static_cast<int>(random.below(5)), repeats = 1 + static_cast<int>(random.below(3));
    char word[200];
    double level = 3, plane = r + (incremental ? 3 : 0);
    const double start = 3;
    std::snprintf(word, sizeof word, "%s %s %s R%.4f Z%.4f Q%.4f ", incremental ? "G91" : "G90",
                  to_start ? "G98" : "G99", pecks ? "G83" : "G81", r, incremental ? -depth : r - depth, depth * 0.6);
    std::string cycle = head + word, moves = head + "G90 ";
    if (!pecks) cycle.erase(cycle.rfind('Q'));
    double x = 1;
    const auto move = [&](const char* form, double value) {
      std::snprintf(word, sizeof word, form, value);
      moves += word;
    };
    for (int i = 0; i < holes; ++i) {
      std::snprintf(word, sizeof word, " X%d L%d\n", incremental ? 2 : 1 + 2 * i, repeats);
      cycle += word;
      if (incremental) plane = r + level;
      for (int n = 0; n < repeats; ++n) {
        x = incremental ? x + 2 : 1 + 2 * i;
        if (level < plane) move("G0 Z%.4f\n", plane);
        move("G0 X%.4f\n", x);
        move("G0 Z%.4f\n", plane);
        if (pecks) {
          move("G1 Z%.4f\n", plane - depth * 0.6);
          move("G0 Z%.4f\n", plane);
          move("G0 Z%.6f\n", std::min(plane, plane - depth * 0.6 + 0.254));
        }
        move("G1 Z%.4f\n", plane - depth);
        level = to_start ? std::max(plane, start) : plane;
        move("G0 Z%.4f\n", level);
      }
    }
    expect_same(cycle, moves);
  }
}

TEST(GcodeCycles, AreBounded) {
  GcodeOptions options;
  options.max_segments = 1000;
  EXPECT_EQ(fault_lines(head + "G91 G81 X1 R-1 Z-1 L100000", options), (std::vector{2}));
  EXPECT_EQ(fault_lines(head + "G83 X1 R1 Z-1 Q0.0001", options), (std::vector{2}));
}

TEST(GcodeInverseTime, FIsOnePerMinute) {
  // 20 mm in 1/4 min, half a circle of radius 10 in 1/2 min; back to mm/min.
  const Contour c = read_gcode("G0 X0 Y0\nG93 G1 X20 F4\nG3 X0 R10 F2\nG0 X5\nG94 G1 X9 F120\nG20 G93 X1 F30");
  ASSERT_EQ(c.blocks.size(), 5u);
  EXPECT_NEAR(c.blocks[0].feed, 20 * 4 / 60.0, 1e-12);
  EXPECT_NEAR(c.blocks[1].feed, 10 * std::numbers::pi * 2 / 60, 1e-12);
  EXPECT_EQ(c.blocks[2].mode, Mode::position);
  EXPECT_NEAR(c.blocks[3].feed, 2, 1e-12);
  EXPECT_NEAR(c.blocks[4].feed, 16.4 * 30 / 60, 1e-12);
  EXPECT_TRUE(c.notes.empty());
}

TEST(GcodeInverseTime, EveryMoveHasItsOwn) {
  EXPECT_EQ(fault_lines("G93 G1 X20 F4\nX30\nG0 X40\nG94 G1 X50 F60\nG93 G1 X60\nG5 I1 J1 P1 Q1 X1 F5"),
            (std::vector{2, 6}));
  EXPECT_EQ(fault_lines("G93 G1 X20 F4\nG81 X3 R1 Z-1 F3"), (std::vector{2}));
  EXPECT_EQ(fault_lines("G93 G1 X20 F-4"), (std::vector{1}));
  // A helix of three turns.
  const Contour c = read_gcode("G0 X10 Y0\nG93 G3 I-10 Z6 P3 F6");
  EXPECT_NEAR(c.path.length() / c.blocks[0].feed, 10, 1e-9);
}

}  // namespace
}  // namespace bahnwerk
