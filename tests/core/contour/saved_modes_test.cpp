// M70 … M73: the modes come back, the motion does not.
#include "core/contour/gcode/saved_modes.hpp"

#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk {
namespace {

TEST(SavedModes, DistanceModeComesBack) {
  // 4 mm on, then to X9 itself.
  const Contour c = read_gcode("G0 X0 Y0\nM70\nG91\nG1 X4 F60\nM72\nX9\n");
  EXPECT_EQ(end_of(c).x, 9);
  EXPECT_EQ(c.path.length(), 9);
  EXPECT_TRUE(c.notes.empty());
  EXPECT_EQ(c.blocks.back().feed, 1);  // there was no feed to bring back
}

TEST(SavedModes, SavesModesButNotTheMotion) {
  GcodeOptions options;
  options.work_offsets[0] = Vec{0, 0, 0};
  options.work_offsets[2] = Vec{100, 0, 0};
  const Contour c = read_gcode(
      "G21 G17 G90 G94 G54 F60\nG0 X0 Y0\nM70\nG20 G18 G91 G93 G56 G90.1\nG1 X1 F2\nG0 X0\nM72\nX30\nG2 X40 I5\n",
      options);
  // X30 is a G0 in mm of G54; the arc lies in G17 about a centre from its start, at 1 mm/s.
  EXPECT_NEAR(end_of(c.path[1]).x, 30, 1e-12);
  EXPECT_EQ(c.blocks[c.blocks.size() - 2].mode, Mode::position);
  EXPECT_EQ(end_of(c).x, 40);
  EXPECT_EQ(c.blocks.back().feed, 1);
}

TEST(SavedModes, TheSwitchComesBack) {
  const Contour c = read_gcode("F60 G0 X0 Y0\nM3\nM70\nG1 X1\nM5\nX2\nM72\nX3");
  std::string modes;
  for (const Block& block : c.blocks) modes += block.mode == Mode::cut ? 'c' : 'p';
  EXPECT_EQ(modes, "cpc");
}

TEST(SavedModes, ASaveActsBeforeTheRestOfItsLine) {
  EXPECT_EQ(end_of(read_gcode("F60 G0 X0 Y0\nM70 G91\nG1 X4\nM72\nX9")).x, 9);
  EXPECT_EQ(end_of(read_gcode("F60 G0 X0 Y0\nM70\nG1 X4\nM72 G91\nX9")).x, 13);
}

TEST(SavedModes, M73RestoresAtTheEndOfItsSubprogram) {
  for (const char* end : {"o1 endsub", "o1 return\no1 endsub"}) {
    const std::string text = std::string("o1 sub\nM73\nG91\nG1 X4\n") + end + "\nF60 G0 X0 Y0\no1 call\nX9";
    EXPECT_EQ(end_of(read_gcode(text)).x, 9) << end;
  }
  EXPECT_EQ(end_of(read_gcode("F60 G0 X0 Y0\nM98 P5 L2\nX9\nM30\nO5\nM73\nG91\nG1 X4\nM99")).x, 9);
  // Without it the subprogram's modes stay; M71 takes it back.
  EXPECT_EQ(end_of(read_gcode("o1 sub\nG91\nG1 X4\no1 endsub\nF60 G0 X0 Y0\no1 call\nX9")).x, 13);
  EXPECT_EQ(end_of(read_gcode("o1 sub\nM73\nG91\nG1 X4\nM71\no1 endsub\nF60 G0 X0 Y0\no1 call\nX9")).x, 13);
}

TEST(SavedModes, EverySubprogramHasItsOwn) {
  // The sub's M70 does not touch what the main program saved.
  EXPECT_EQ(end_of(read_gcode("o1 sub\nG91\nM70\nG1 X4\nM72\no1 endsub\nF60 G0 X0 Y0\nM70\no1 call\nM72\nX9")).x, 9);
  EXPECT_EQ(fault_lines("F60 G1 X1\nM72"), (std::vector{2}));
  EXPECT_EQ(fault_lines("o1 sub\nM72\no1 endsub\nF60 G1 X1\nM70\no1 call"), (std::vector{2}));
  EXPECT_EQ(fault_lines("F60 G1 X1\nM70\nM71\nM72"), (std::vector{4}));
}

TEST(SavedModes, APrintersProgressIsNoSave) {
  const Contour c = read_gcode("F60 G1 X5\nM73 P12 R3\nX9");
  EXPECT_EQ(c.path.length(), 9);
  ASSERT_EQ(c.notes.size(), 1u);
  EXPECT_NE(c.notes[0].find("printers"), std::string::npos);
}

TEST(SavedModes, CutterCompensationMustBeTheSame) {
  GcodeOptions options;
  options.cutter_radius = {{1, 1.0}};
  EXPECT_EQ(fault_lines("F60 G0 X0 Y0\nG41 D1 G1 X5\nM70\nX20\nG40 G1 X25 Y5\nM72\nX30", options), (std::vector{6}));
  EXPECT_TRUE(gcode_faults("F60 G0 X0 Y0\nM70\nG41 D1 G1 X5\nX20\nM72\nG1 X25 Y5\nX30", options).empty());
}

TEST(SavedModes, LevelsNest) {
  gcode::SavedModes saved;
  gcode::Modes modes;
  modes.unit = 25.4;
  saved.save(modes, false);
  saved.enter();
  EXPECT_FALSE(saved.saved());
  modes.unit = 1;
  saved.save(modes, true);
  const auto back = saved.leave();
  ASSERT_TRUE(back);
  EXPECT_EQ(back->unit, 1);
  EXPECT_EQ(saved.saved()->unit, 25.4);
  saved.forget();
  EXPECT_FALSE(saved.saved());
}

}  // namespace
}  // namespace bahnwerk
