// Documents of contours as they are read, and what is refused in them.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kind.hpp"
#include "api/kinds/contour/contour.hpp"
#include "api/text/base64.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;

json example(const std::string& name) {
  return test::read_json(test::source("schemas/examples/contour/" + name + ".json"));
}

TEST(ContourInput, ReadsEveryFormOfSegment) {
  const Contour contour = geometry(example("complete"));
  EXPECT_EQ(contour.dimension, 2u);
  ASSERT_EQ(contour.blocks.size(), 2u);
  EXPECT_EQ(contour.blocks[0].mode, Mode::cut);
  EXPECT_EQ(contour.blocks[0].feed, 400);
  EXPECT_EQ(contour.blocks[1].mode, Mode::position);
  EXPECT_EQ(contour.blocks[1].feed, unlimited);
  ASSERT_GE(contour.path.size(), 5u);
  EXPECT_NEAR(contour.path[0].length(), 40, 1e-12);
  EXPECT_NEAR(contour.path[1].length(), 10 * std::numbers::pi / 2, 1e-9);
  const Vec end = contour.path.at(contour.path.length()).value;
  EXPECT_NEAR(end.x, 0, 1e-9);
  EXPECT_NEAR(end.y, 60, 1e-9);
  EXPECT_EQ(contour.path[4].source(), 4u);
}

TEST(ContourInput, ReadsSpace) {
  const Contour contour = geometry(example("space"));
  EXPECT_EQ(contour.dimension, 3u);
  const double turn = 2 * std::numbers::pi * 10;
  EXPECT_NEAR(contour.path[0].length(), std::sqrt(turn * turn + 25), 1e-9);
  EXPECT_NEAR(contour.path.at(contour.path.length()).value.z, 8, 1e-9);
}

TEST(ContourInput, ClosesAPolylineOnDemand) {
  json spec = example("points");
  const double closed = geometry(spec).path.length();
  spec["contour"]["closed"] = false;
  EXPECT_NEAR(closed - geometry(spec).path.length(), std::hypot(12, 12), 1e-9);
  EXPECT_EQ(geometry(spec).blocks[0].feed, 150);
  spec["contour"].erase("feed");
  EXPECT_EQ(geometry(spec).blocks[0].feed, unlimited);
}

TEST(ContourInput, RowsOfDifferentLengthAreFilledWithZeros) {
  json spec = example("minimal");
  spec["contour"]["blocks"][0]["segments"] = {{{"polynomial", {{"coefficients", {{0, 10}, {0, 0, 5}}}}}}};
  const Vec end = geometry(spec).path.at(1e9).value;
  EXPECT_NEAR(end.x, 10, 1e-9);
  EXPECT_NEAR(end.y, 5, 1e-9);
}

TEST(ContourInput, ReadsMachineAndPlanningWithTheirDefaults) {
  const Machine limits = machine(example("space"));
  ASSERT_EQ(limits.dimension(), 3u);
  EXPECT_EQ(limits.axes[2].name, "z");
  EXPECT_EQ(limits.axes[2].velocity, 500);
  EXPECT_EQ(limits.axes[2].acceleration, 5000);
  EXPECT_EQ(limits.axes[2].jerk, unlimited);
  EXPECT_EQ(limits.cycle_time, 0.002);
  EXPECT_EQ(machine(example("minimal")).cycle_time, 0.001);

  const ContourPlanning defaults = planning(example("minimal"));
  EXPECT_EQ(defaults.method, PlanningMethod::braking_reserve);
  EXPECT_EQ(defaults.braking_reserve, 0.7);
  EXPECT_DOUBLE_EQ(defaults.corner_angle, 0.1 * std::numbers::pi / 180);
  json spec = example("complete");
  spec["planning"] = {{"method", "time_optimal"}, {"braking_reserve", 0.5}, {"corner", {{"angle", 90}}}};
  const ContourPlanning given = planning(spec);
  EXPECT_EQ(given.method, PlanningMethod::time_optimal);
  EXPECT_EQ(given.braking_reserve, 0.5);
  EXPECT_DOUBLE_EQ(given.corner_angle, std::numbers::pi / 2);
}

TEST(ContourInput, ReadsJerkBlendingAndLimitsAlongThePath) {
  const json spec = example("blend");
  EXPECT_EQ(machine(spec).axes[1].jerk, 800000);
  const ContourPlanning given = planning(spec);
  EXPECT_EQ(given.method, PlanningMethod::jerk_limited);
  EXPECT_EQ(given.corner_mode, CornerMode::blend);
  EXPECT_EQ(given.blend_tolerance, 0.05);
  EXPECT_EQ(given.along.velocity, 120);
  EXPECT_EQ(given.along.acceleration, 10000);
  EXPECT_EQ(given.along.jerk, 500000);
}

TEST(ContourInput, ReadsPartPrograms) {
  const Contour program = geometry(example("gcode"));
  ASSERT_EQ(program.blocks.size(), 2u);
  EXPECT_EQ(program.blocks[0].mode, Mode::cut);
  EXPECT_EQ(program.blocks[0].feed, 150);
  EXPECT_EQ(program.blocks[1].mode, Mode::position);
  const Contour drawing = geometry(example("dxf"));
  EXPECT_EQ(drawing.blocks[0].feed, 120);
  double cut = 0;
  for (const Block& block : drawing.blocks)
    for (std::size_t i = block.first; i < block.last; ++i)
      if (block.mode == Mode::cut) cut += drawing.path[i].length();
  EXPECT_NEAR(cut, 40 + 10 * std::numbers::pi + 8 * std::numbers::pi, 1e-9);
}

TEST(ContourInput, ReadsWhatAPartProgramNeeds) {
  json spec = example("shop_program");
  const Contour program = geometry(spec);
  EXPECT_TRUE(program.notes.empty());
  const auto first = [&] { return geometry(spec).path.at(0).value; };
  const Vec plain = first();
  spec["contour"]["offsets"]["G54"] = {57, 40, 3};
  EXPECT_EQ(first().x, plain.x + 7);
  EXPECT_EQ(first().y, plain.y - 10);
  EXPECT_EQ(first().z, plain.z + 3);
  for (const char* name : {"G56", "G59", "G59.1", "G59.3"}) {
    spec["contour"] = {{"gcode", std::string(name) + " G0 X0 Y0\nG1 X1"}, {"offsets", {{name, {5, 6}}}}};
    EXPECT_EQ(first().x, 5) << name;
    EXPECT_TRUE(geometry(spec).notes.size() == 1) << name;  // no feed
  }
  spec["contour"] = {{"gcode", "G0 X0 Y0\nG42 D08 G1 X9\nY9"}, {"cutter_radius", {{"8", 2}}}};
  // Along the tangent of the circle of the cutter about (9, 0), then round it.
  EXPECT_NEAR(geometry(spec).path[0].length(), std::sqrt(9 * 9 - 2 * 2), 1e-12);
  spec["contour"] = {{"gcode", "G0 X0 Y0\nG1 X9\nG30 X1"}, {"reference_points", {{"G30", {20, 0}}}}};
  EXPECT_EQ(geometry(spec).path.size(), 3u);
  spec["contour"] = {{"gcode", "G1 X1\no1 repeat [11]\nX#1\no1 endrepeat"}, {"steps", 20}};
  EXPECT_NO_THROW(geometry(spec));
  spec["contour"]["steps"] = 19;
  EXPECT_THROW(geometry(spec), InvalidInput);
}

TEST(ContourInput, TheDocumentSaysHowAPartProgramIsMeant) {
  json spec;
  spec["contour"] = {{"gcode", "G0 X30 Y10\nG3 X20 Y20 I20 J10"}, {"arc_centers", "absolute"}};
  EXPECT_NEAR(geometry(spec).path.length(), 5 * std::numbers::pi, 1e-12);
  spec["contour"]["arc_centers"] = "relative";
  EXPECT_THROW(geometry(spec), InvalidInput);
  spec["contour"] = {{"gcode", "G70 G1 X1\nG71 X20"}, {"g70_g71", "units"}};
  EXPECT_NEAR(geometry(spec).path.length(), 25.4 + 5.4, 1e-12);
  spec["contour"].erase("g70_g71");
  EXPECT_THROW(geometry(spec), InvalidInput);
  for (const char* word : {"G0", "G1"}) {
    spec["contour"] = {{"gcode", "X4 Y3\nG1 X8"}, {"initial_motion", word}};
    EXPECT_EQ(geometry(spec).path.length(), word[1] == '0' ? 4 : 9);  // a first G0 tells where the contour begins
  }
}

TEST(ContourInput, HatchesAndBinaryDrawings) {
  json spec;
  const std::string square =
      "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n9\n11\n12\n0\nHATCH\n8\n0\n91\n1\n92\n2\n72\n0\n73\n1\n93\n4\n10\n0"
      "\n20\n0\n"
      "10\n4\n20\n0\n10\n4\n20\n4\n10\n0\n20\n4\n97\n0\n0\nENDSEC\n0\nEOF\n";
  spec["contour"] = {{"dxf", square}};
  EXPECT_EQ(geometry(spec).blocks.size(), 1u);
  spec["contour"]["hatch"] = "cut";
  EXPECT_EQ(geometry(spec).blocks.size(), 3u);
  // A line from 0 to 8 in a binary file of one byte per group code.
  std::string bytes(
      "AutoCAD Binary DXF\r\n\x1A\0\0SECTION\0\2ENTITIES\0\0LINE\0\x0B\0\0\0\0\0\0\x20\x40\0ENDSEC\0\0EOF\0", 69);
  spec["contour"] = {{"dxf", base64(bytes)}};
  EXPECT_EQ(geometry(spec).path.length(), 8);
  spec["contour"]["dxf"] = base64(bytes) + "?";
  EXPECT_THROW(geometry(spec), InvalidInput);
}

TEST(ContourInput, NamesEveryPointOfTheWrongDimension) {
  json spec = example("points");
  for (int i = 1; i < 4; ++i) spec["contour"]["points"][i].push_back(0);
  try {
    Progress silent;
    find_kind("contour")->check(spec, silent);
    FAIL();
  } catch (const Problem& problem) {
    EXPECT_EQ(test::pointers(problem),
              (std::vector<std::string>{"/spec/contour/points/1", "/spec/contour/points/2", "/spec/contour/points/3"}));
  }
}

TEST(ContourInput, ReadsDwellsAndModeChanges) {
  const json spec = example("dwell");
  const Contour contour = geometry(spec);
  ASSERT_EQ(contour.rests.size(), 3u);
  EXPECT_EQ(contour.rests[1].seconds, 0.4);
  EXPECT_EQ(contour.rests[1].segment, 3u);
  EXPECT_EQ(contour.rests[1].block, 2u);
  EXPECT_TRUE(planning(spec).stop_at_mode_change);
  EXPECT_FALSE(planning(example("complete")).stop_at_mode_change);
}

}  // namespace
}  // namespace bahnwerk::api::contour
