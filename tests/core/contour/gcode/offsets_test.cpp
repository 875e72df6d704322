// Work offsets, G52 and G92, points of the machine.
#include <cmath>

#include "core/numeric/random.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

bool noted(const Contour& c, std::string_view part) {
  for (const std::string& note : c.notes)
    if (note.find(part) != std::string::npos) return true;
  return false;
}

GcodeOptions with_offsets() {
  GcodeOptions options;
  options.work_offsets[0] = Vec{100, 0, 0};
  options.work_offsets[1] = Vec{0, 200, -5};
  options.work_offsets[8] = Vec{1, 2, 3};
  return options;
}

TEST(GcodeOffsets, ComeFromTheDocument) {
  const Contour c = read_gcode("G0 X1 Y2 Z3\nG55 G1 X1 Y2 Z3\nG59.3 X0 Y0 Z0\nG54 X0", with_offsets());
  expect_near(begin_of(c), {101, 2, 3}, 0);
  expect_near(end_of(c.path[0]), {1, 202, -2}, 0);
  expect_near(end_of(c.path[1]), {1, 2, 3}, 0);
  expect_near(end_of(c), {100, 2, 3}, 0);
  EXPECT_EQ(c.notes.size(), 1u);  // no feed
}

TEST(GcodeOffsets, AreZeroAndNotedWhereTheDocumentIsSilent) {
  const Contour c = read_gcode("F60 G0 X1 Y2\nG55 G1 X5\nG56 X6\nG55 X7");
  expect_near(end_of(c), {7, 2, 0}, 0);
  ASSERT_EQ(c.notes.size(), 2u);
  EXPECT_EQ(c.notes[0], "line 2 and 1 more: the work offset G55 is not in the document: taken as zero");
  EXPECT_TRUE(noted(c, "line 3: the work offset G56"));
  EXPECT_TRUE(read_gcode("G54 F60 G1 X5").notes.empty());
}

TEST(GcodeOffsets, TheProgramSetsThem) {
  // L2 in machine coordinates, L20 so that the head stands there.
  const Contour c =
      read_gcode("F60 G10 L2 P2 X10 Y20 Z30\nG0 X0 Y0 Z0\nG55 G1 X1 Y0 Z0\nG10 L20 P0 X0 Y0\nX1\nG54 X0 Y0 Z0");
  expect_near(end_of(c.path[0]), {11, 20, 30}, 0);
  EXPECT_EQ(begin_of(c), (Vec{0, 0, 0}));
  expect_near(end_of(c.path[1]), {12, 20, 30}, 0);
}

TEST(GcodeOffsets, G92NamesThePlaceOfTheHead) {
  const Contour c = read_gcode("F60 G0 X10 Y20 Z0\nG92 X0 Y0\nG1 X1 Y1\nG92.2\nX0\nG92.3\nX0\nG92.1\nX0\nZ1");
  const double x[] = {11, 0, 10, 0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(end_of(c.path[i]).x, x[i]) << i;
  EXPECT_EQ(end_of(c.path[0]).y, 21);
  // Before the first move it tells where the contour begins.
  expect_near(begin_of(read_gcode("G92 X3 Y4 Z5\nG0 X9 Y4 Z5")), {3, 4, 0}, 0);
  EXPECT_EQ(read_gcode("G92 X3 Y4 Z5\nG0 X9 Y4 Z5").height, 5);
  expect_near(begin_of(read_gcode("G92 E0\nG0 X9 Y4\nG92 E0\nG1 X1")), {9, 4, 0}, 0);
  // Its numbers are in the units of its line.
  expect_near(end_of(read_gcode("G0 X0 Y0\nG92 X1 Y0 G20\nG1 X2 Y0")), {25.4, 0, 0}, 1e-12);
}

TEST(GcodeOffsets, G52ShiftsTheProgram) {
  const Contour c = read_gcode("F60 G52 X10 Y5\nG0 X0 Y0\nG1 X1\nG52 X0\nX0 Y0\nG52 X0 Y0\nX0 Y0");
  expect_near(begin_of(c), {10, 5, 0}, 0);
  expect_near(end_of(c.path[0]), {11, 5, 0}, 0);
  expect_near(end_of(c.path[1]), {0, 5, 0}, 0);
  expect_near(end_of(c), {0, 0, 0}, 0);
}

TEST(GcodeOffsets, ShiftEverything) {
  // The same program, with centres absolute and relative, at another place.
  const std::string text =
      "F60 G1 X10 Y0\nG3 X0 Y10 I-10 J0\nG90.1 G2 X10 Y0 I0 J0\nG91.1 G3 X0 Y10 R10\nG0 X0 Y0\nG5 X5 Y5 I1 J2 P-1 Q2\n"
      "G81 X3 Y4 Z-1 R1\nX7\nG80 G91 G1 X2 Z2\nG90 X3\nG18 G3 X5 Z3 R1\n";
  Random random(31);
  for (int run = 0; run < 50; ++run) {
    const Vec by{random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-9, 9)};
    GcodeOptions options;
    options.work_offsets[2] = by;
    const Contour plain = read_gcode(text), shifted = read_gcode("G56\n" + text, options);
    ASSERT_EQ(plain.path.size(), shifted.path.size());
    for (std::size_t i = 0; i < plain.path.size(); ++i) {
      ASSERT_NEAR(plain.path[i].length(), shifted.path[i].length(), 1e-9);
      expect_near(begin_of(plain.path[i]) + by, begin_of(shifted.path[i]), 1e-10);
      expect_near(end_of(plain.path[i]) + by, end_of(shifted.path[i]), 1e-10);
    }
  }
}

TEST(GcodeOffsets, AKnownPointOfTheMachineIsReached) {
  GcodeOptions options = with_offsets();
  options.g28 = Vec{-10, -20, 300};
  const Contour c = read_gcode("F60 G0 X0 Y0 Z0\nG1 X5\nG91 G28 Z1\nG90 G1 X7\nG53 G0 X0 Y0\nG28", options);
  const Vec ends[] = {{105, 0, 0}, {105, 0, 1}, {105, 0, 300}, {107, 0, 300}, {0, 0, 300}, {-10, -20, 300}};
  ASSERT_EQ(c.path.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) expect_near(end_of(c.path[i]), ends[i], 1e-12);
  EXPECT_TRUE(c.rests.empty());
}

TEST(GcodeOffsets, AnUnknownOneStopsTheHead) {
  // A change of tools, as it is written: the head goes on from where it stood, up before it goes across.
  const Contour c =
      read_gcode("F60 G0 X0 Y0 Z5\nG1 Z-2\nX20\nG91 G28 Z0\nT2 M6\nG90 G0 X40 Y10\nG43 H2 Z5\nG1 Z-2\nG91 G30 Z0\nM30");
  ASSERT_EQ(c.path.size(), 5u);
  expect_joined(c);
  expect_near(end_of(c.path[1]), {20, 0, -2}, 0);
  expect_near(end_of(c.path[2]), {20, 0, 5}, 0);
  expect_near(end_of(c.path[3]), {40, 10, 5}, 0);
  ASSERT_EQ(c.rests.size(), 1u);
  EXPECT_EQ(c.rests[0].segment, 2u);
  EXPECT_TRUE(noted(c, "line 4 and 1 more: move to a point of the machine"));
  // Down: across first.
  const Contour down = read_gcode("F60 G0 X0 Y0 Z50\nG1 Z40\nG28 Z60\nG0 X10 Y0 Z3\nG1 X9");
  expect_near(end_of(down.path[1]), {10, 0, 40}, 0);
  expect_near(end_of(down.path[2]), {10, 0, 3}, 0);
  // An axis that no move names stands still.
  EXPECT_EQ(read_gcode("F60 G0 X0 Y0\nG1 X5\nG28 Z0\nX6").dimension, 2u);
}

TEST(GcodeOffsets, NothingIsCutFromAnUnknownPlace) {
  EXPECT_EQ(fault_lines("F60 G0 X0 Y0 Z5\nG1 X5 Z1\nG28 Z0\nG1 X9\nX10"), (std::vector{4}));
  EXPECT_EQ(fault_lines("F60 G0 X0 Y0 Z5\nG1 X5 Z1\nG28 Z0\nG91 G0 Z9\nX10"), (std::vector{4}));
  EXPECT_EQ(fault_lines("F60 G0 X0 Y0 Z5\nG1 X5 Z1\nG28\nG2 X9 Y0 Z0 R5\nX10 R5"), (std::vector{4}));
  EXPECT_EQ(fault_lines("F60 G0 X0 Y0\nG1 X5\nG53 G0 X0\nG81 X5 Z1 R2"), (std::vector{4}));
}

TEST(GcodeOffsets, G10L20BeforeTheFirstMoveTellsWhereTheHeadStands) {
  // As G92 there: the contour begins at the place, the zero stays.
  const Contour c = read_gcode("F60 G10 L20 P1 X3 Y4 Z5\nG0 X9 Y4\nG1 X20");
  EXPECT_EQ(begin_of(c), (Vec{3, 4, 0}));
  EXPECT_EQ(c.height, 5);
  EXPECT_EQ(end_of(c), (Vec{20, 4, 0}));
  EXPECT_EQ(c.path.length(), 17);
  // An offset of the document is kept; P0 is the one in force.
  const Contour placed = read_gcode("F60 G10 L20 P0 X3 Y4 Z0\nG1 X5 Y4 Z0", with_offsets());
  EXPECT_EQ(begin_of(placed), (Vec{103, 4, 0}));
  EXPECT_EQ(end_of(placed), (Vec{105, 4, 0}));
  // One that is selected later.
  const Contour later = read_gcode("F60 G10 L20 P2 X1 Y2 Z3\nG55\nG1 X5", with_offsets());
  EXPECT_EQ(begin_of(later), (Vec{1, 202, 0}));
  EXPECT_EQ(end_of(later), (Vec{5, 202, 0}));
}

TEST(GcodeOffsets, APointOfTheDocumentBeforeTheFirstMove) {
  GcodeOptions options;
  options.g28 = Vec{0, 0, 50};
  const Contour c = read_gcode("G91 G28 Z0\nG90 F60\nG0 X1 Y2 Z9\nG1 Z5", options);
  ASSERT_EQ(c.notes.size(), 1u);
  EXPECT_EQ(c.notes[0],
            "line 1: move to a point of the machine (G28, G30, G53) left out: where the head stands before the first "
            "move is not known");
  EXPECT_TRUE(noted(read_gcode("G91 G28 Z0\nG90 F60\nG0 X1 Y2\nG1 X5"), "the document does not say where that is"));
}

TEST(GcodeOffsets, G28_1StoresThePlace) {
  const Contour c = read_gcode("F60 G0 X1 Y2\nG1 X5\nG28.1\nX9 Y9\nG28\nG1 X6");
  EXPECT_EQ(end_of(c.path[2]), (Vec{5, 2, 0}));
  EXPECT_EQ(end_of(c), (Vec{6, 2, 0}));
  EXPECT_TRUE(c.notes.empty());
}

TEST(GcodeOffsets, UnknownOffsetsAreRefused) {
  EXPECT_EQ(fault_lines("G1 X1\nG53 G1 G91 X5", with_offsets()), (std::vector{2}));
  EXPECT_EQ(fault_lines("G1 X1\nG3 X2 R5\nG53 X5", with_offsets()), (std::vector{3}));
  EXPECT_EQ(fault_lines("G10 L20 P10 X5\nG1 X1"), (std::vector{1}));
  EXPECT_EQ(fault_lines("G28.1\nG1 X1"), (std::vector{1}));
  EXPECT_EQ(fault_lines("G20 G52 X999999999\nG1 X1 Y1\nG92 X-999999999\nX1"), (std::vector{2}));
}

}  // namespace
}  // namespace bahnwerk
