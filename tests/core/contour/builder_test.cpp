#include "core/contour/builder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace bahnwerk {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();
const double none = std::numeric_limits<double>::infinity();

std::vector<InputFault> faults_of(ContourBuilder& b) {
  try {
    b.finish();
  } catch (const InvalidInput& e) {
    return e.faults;
  }
  return {};
}

std::string pointer(const InputFault& f) {
  std::string text;
  for (const auto& p : f.place) text += "/" + p;
  return text;
}

TEST(ContourBuilder, BlocksCoverTheirSegments) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({10, 0, 0});
  b.arc({20, 10, 0}, {10, 10, 0}, true);
  b.block(Mode::position, none);
  b.line({20, 30, 0});
  const Contour c = b.finish();
  ASSERT_EQ(c.path.size(), 3u);
  ASSERT_EQ(c.blocks.size(), 2u);
  EXPECT_EQ(c.blocks[0].last, 2u);
  EXPECT_EQ(c.blocks[1].first, 2u);
  EXPECT_NEAR(c.path.length(), 10 + 5 * M_PI + 20, 1e-12);
  EXPECT_EQ(c.feeds(), (std::vector<double>{400, 400, none}));
  EXPECT_TRUE(c.notes.empty());
}

TEST(ContourBuilder, DropsWhatHasNoLengthWithANote) {
  ContourBuilder b(2, {});
  b.line({0, 0, 0});
  b.line({1e-8, 0, 0});
  b.polynomial({{0, 0, 0}, {0, 0}});
  b.line({10, 0, 0});
  const Contour c = b.finish();
  EXPECT_EQ(c.path.size(), 1u);
  EXPECT_EQ(c.notes.size(), 3u);
  EXPECT_NEAR(c.path.length(), 10, 1e-12);
}

TEST(ContourBuilder, ManyTinyStepsKeepTheirDistance) {
  ContourBuilder b(2, {});
  for (int i = 1; i <= 1000; ++i) b.line({i * 1e-8, 0, 0});
  b.line({1e-5, 1, 0});
  EXPECT_NEAR(b.finish().path.length(), 1 + 1e-5, 2e-6);
}

TEST(ContourBuilder, CollectsEveryFaultWithItsPlace) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 100);
  b.line({nan, 0, 0});
  b.arc({10, 0, 0}, {4, 0, 0}, true);  // radii 4 and 6
  b.polynomial({{5, 1}, {0, 1}});      // a gap of 5 mm
  b.block(Mode::cut, -1);
  b.nurbs(3, {{0, 0, 0}, {1, 0, 0}}, {1, 1}, {0, 0, 1, 1});
  const auto faults = faults_of(b);
  ASSERT_GE(faults.size(), 5u);  // the NURBS has two
  EXPECT_EQ(pointer(faults[0]), "/contour/blocks/0/segments/0/line");
  EXPECT_EQ(pointer(faults[1]), "/contour/blocks/0/segments/1/arc/center");
  EXPECT_EQ(pointer(faults[2]), "/contour/blocks/0/segments/2/polynomial");
  EXPECT_EQ(pointer(faults[3]), "/contour/blocks/1/feed");
  EXPECT_EQ(pointer(faults[4]).rfind("/contour/blocks/1/segments/0/nurbs", 0), 0u);
}

TEST(ContourBuilder, NothingToMoveAlongIsAFault) {
  ContourBuilder b(2, {});
  b.line({0, 0, 0});
  const auto faults = faults_of(b);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(pointer(faults[0]), "/contour");
}

TEST(ContourBuilder, SmallGapsAreJoinedWithANote) {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  b.polynomial({{10.0004, 5}, {0, 0, 3}});
  const Contour c = b.finish();
  EXPECT_EQ(c.notes.size(), 1u);
  EXPECT_LT(norm(c.path[1].at(c.path[1].s0()).value - Vec{10, 0, 0}), 1e-12);
}

TEST(ContourBuilder, ACircleMayStartAHairBesideItsEnd) {
  ContourBuilder b(2, {});
  b.polynomial({{0, 10 + 2e-7}, {0, 0}});
  b.arc({10, 0, 0}, {10, 5, 0}, true);
  EXPECT_NEAR(b.finish().path[1].length(), 10 * M_PI, 1e-6);
}

// A third of a turn of radius 4e-7 mm is no circle, in neither direction.
TEST(ContourBuilder, AnArcOfNanometresIsDropped) {
  constexpr double r = 4e-7;
  const Vec first{10, 0, 0}, centre{10, r, 0}, last{10 + r * std::sin(2.0), r - r * std::cos(2.0), 0};
  for (const bool forward : {true, false}) {
    ContourBuilder b(2, forward ? first : last);
    b.arc(forward ? last : first, centre, forward);
    b.line({20, 0, 0});
    const Contour c = b.finish();
    ASSERT_EQ(c.path.size(), 1u);
    EXPECT_NEAR(c.path.length(), 10, 2e-6);
    EXPECT_FALSE(c.notes.empty());
  }
  ContourBuilder larger(2, {10, 0, 0});
  larger.arc({10 + 4e-7, 1e-8, 0}, {10, 5, 0}, true);
  EXPECT_NEAR(larger.finish().path.length(), 10 * 3.14159265358979, 1e-5);
}

TEST(ContourBuilder, AReaderOfTextNamesLines) {
  ContourBuilder b(2, {}, "gcode");
  b.at_line(3);
  b.start({1, 0, 0});
  b.line({1, 1e-8, 0});
  b.at_line(7);
  b.line({5, 0, 0});
  const Contour c = b.finish();
  EXPECT_EQ(c.path[0].source(), 7u);
  EXPECT_NEAR(c.path.length(), 4, 1e-12);
  ASSERT_EQ(c.notes.size(), 1u);
  EXPECT_EQ(c.notes[0].rfind("line 3: dropped", 0), 0u);
}

TEST(ContourBuilder, AReaderOfTextHasItsOwnPlace) {
  ContourBuilder b(2, {}, "gcode");
  b.at_line(12);
  b.block(Mode::cut, 0);
  b.arc({10, 0, 0}, {4, 0, 0}, true);  // radii 4 and 6
  b.at_line(13);
  b.arc({0, 10, 0}, {0, 0, 0}, true);  // from where the wrong one should have ended
  b.fault({}, "odd");
  const auto faults = faults_of(b);
  ASSERT_EQ(faults.size(), 3u);
  for (const InputFault& f : faults) EXPECT_EQ(pointer(f), "/contour/gcode");
  EXPECT_EQ(faults[0].message.rfind("line 12: ", 0), 0u);
  EXPECT_EQ(faults[1].message.rfind("line 12: ", 0), 0u);
  EXPECT_EQ(faults[2].message, "line 13: odd");
}

TEST(ContourBuilder, KeepsAHundredFaults) {
  ContourBuilder b(2, {});
  for (int i = 0; i < 200; ++i) b.block(Mode::cut, -1);
  EXPECT_TRUE(b.full());
  EXPECT_EQ(faults_of(b).size(), 100u);
}

TEST(ContourBuilder, DwellsRestAtTheCurrentPoint) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.dwell(0.5);
  b.line({10, 0, 0});
  b.dwell(1);
  b.dwell(0);
  b.block(Mode::position, none);
  b.dwell(2);
  b.block(Mode::cut, none);
  b.line({20, 0, 0});
  b.dwell(longest_rest);
  const Contour c = b.finish();
  EXPECT_EQ(c.path.size(), 2u);
  ASSERT_EQ(c.blocks.size(), 3u);
  const std::vector<std::array<double, 3>> expected{{0, 0.5, 0}, {1, 1, 0}, {1, 0, 0}, {1, 2, 1}, {2, longest_rest, 2}};
  ASSERT_EQ(c.rests.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(static_cast<double>(c.rests[i].segment), expected[i][0]);
    EXPECT_EQ(c.rests[i].seconds, expected[i][1]);
    EXPECT_EQ(static_cast<double>(c.rests[i].block), expected[i][2]);
  }
  EXPECT_EQ(c.rest_places(), (std::vector{true, true, true}));
  EXPECT_EQ(c.dwell(), 3.5 + longest_rest);
}

TEST(ContourBuilder, DwellsWithoutAMeaningAndContoursOfDwellsAlone) {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  b.dwell(-1);
  b.dwell(nan);
  b.dwell(1.001 * longest_rest);
  const auto faults = faults_of(b);
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_EQ(pointer(faults[1]), "/contour/blocks/0/segments/2/dwell");
  ContourBuilder still(2, {});
  still.dwell(1);
  ASSERT_EQ(faults_of(still).size(), 1u);
}

TEST(Contour, StopsWhereTheModeChanges) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 400);
  b.line({10, 0, 0});
  b.block(Mode::cut, 200);
  b.line({20, 0, 0});
  b.block(Mode::position, none);
  b.dwell(1);
  b.block(Mode::cut, 200);  // the head was at rest here anyway
  b.line({30, 0, 0});
  b.dwell(2);
  b.block(Mode::position, none);
  b.line({40, 0, 0});
  b.block(Mode::cut, none);
  b.line({50, 0, 0});
  Contour c = b.finish();
  stop_at_mode_changes(c);
  std::string rests;
  for (const Rest& rest : c.rests)
    rests += std::to_string(rest.segment) + ":" + std::to_string(rest.block) + ":" +
             std::to_string(std::lround(rest.seconds)) + " ";
  EXPECT_EQ(rests, "2:2:1 3:3:2 3:4:0 4:5:0 ");
}

TEST(Joints, AngleAndStep) {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  b.line({10, 10, 0});
  b.line({10, 20, 0});
  const auto list = joints(b.finish().path);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_NEAR(list[0].angle, M_PI / 2, 1e-15);
  EXPECT_NEAR(list[0].step.x, -1, 1e-15);
  EXPECT_EQ(list[0].next, 1u);
  EXPECT_EQ(list[1].angle, 0);
}

}  // namespace
}  // namespace bahnwerk
