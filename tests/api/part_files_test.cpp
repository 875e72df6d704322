// The part files under examples/parts: read without a fault, with the size and shape that their design asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "api/kinds/contour/contour.hpp"
#include "core/contour/dxf.hpp"
#include "core/contour/gcode.hpp"
#include "core/geometry/curve/arc.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;
using std::numbers::pi;

std::string part(const std::string& name) { return test::source("examples/parts/" + name); }
bool ends_with(const std::string& name, std::string_view end) { return name.ends_with(end); }

Contour read_part(const std::string& name, const DxfOptions& drawing = {}) {
  if (ends_with(name, ".ngc")) return read_gcode(test::read_file(part(name)));
  if (ends_with(name, ".dxf")) return read_dxf(test::read_file(part(name)), drawing);
  return contour::geometry(test::read_json(part(name))["spec"]);
}

Vec begin_of(const Segment& s) { return s.curve().at(s.curve().begin()).value; }
Vec end_of(const Segment& s) { return s.curve().at(s.curve().end()).value; }

struct Size {
  std::size_t cuts = 0, closed = 0;
  double cut_length = 0;  // mm
};
Size size_of(const Contour& c) {
  Size size;
  for (const Block& b : c.blocks) {
    if (b.mode != Mode::cut || b.first == b.last) continue;
    ++size.cuts;
    size.cut_length += c.path[b.last - 1].s1() - c.path[b.first].s0();
    if (norm(end_of(c.path[b.last - 1]) - begin_of(c.path[b.first])) < 1e-9) ++size.closed;
  }
  return size;
}

// Closed forms, mm.
double rounded_rectangle(double width, double height, double radius) {
  return 2 * (width + height) - (8 - 2 * pi) * radius;
}
double bracket_outline() {  // six right angles: five roundings of 8, one of 12
  return 2 * (140 + 110) - (2 - pi / 2) * (5 * 8 + 12);
}
double bracket_cuts() {
  const double holes = 2 * pi * (4 * 4.5 + 11), slot = 44 + 2 * pi * 4.5;
  return holes + slot + rounded_rectangle(31, 25, 5) + bracket_outline();
}
double bracket_leads() { return pi * (4 * 2.25 + 5.5) + 3 * std::hypot(4, 4); }
double sheet_cuts() { return 1000 * 5 * pi + 12 * (32 + 6 * pi) + rounded_rectangle(440, 310, 10); }
double gear_bore() {
  const double half = std::asin(0.3);
  return 10 * (2 * pi - 2 * half) + 6 + 2 * (12.8 - 10 * std::cos(half));
}
double gear_teeth() {
  const double alpha = pi / 9, base = 24 * std::cos(alpha), tip = 26, root = 21.5, fillet = 0.6;
  const double roll = std::sqrt(tip * tip / (base * base) - 1);
  const double half = pi / 48 + std::tan(alpha) - alpha, lost = std::asin(fillet / (root + fillet));
  const double radial = base - (root + fillet) * std::cos(lost);
  const double tooth = 2 * tip * (half - roll + std::atan(roll)) + 2 * root * (pi / 24 - half - lost) +
                       base * roll * roll + 2 * radial + 2 * fillet * (pi / 2 - lost);
  return 24 * tooth;
}
double thread_cuts() {
  const double half_turn = std::hypot(pi * 0.0625, 0.05), turn = std::hypot(2 * pi * 0.125, 0.1);
  double length = 6 * (0.8 + 2 * half_turn + 6 * turn) + 0.1;
  length += 5 * std::hypot(rounded_rectangle(2, 1.2, 0.25), 0.05) + 3 * std::hypot(0.075, 0.15);
  for (const int i : {0, 1, 2, 3}) length += rounded_rectangle(2 - 0.3 * i, 1.2 - 0.3 * i, 0.25 - 0.075 * i);
  return 25.4 * length;
}

struct Expected {
  const char* file;
  std::size_t dimension, segments, blocks, cuts, closed, notes;
  double cut_length, tolerance;  // mm
};

TEST(PartFiles, HaveTheSizeOfTheirDesign) {
  // What has no closed form: computed by the script that writes the files, by its own quadrature.
  const double lettering = 1227.599790, blades = 3199.218179, pocket = 1735.805740;
  const Expected files[] = {
      {"bracket.ngc", 2, 45, 16, 8, 0, 0, bracket_cuts() + bracket_leads(), 1e-9},
      {"bracket.dxf", 2, 36, 15, 8, 8, 2, bracket_cuts(), 1e-6},
      {"gear.ngc", 2, 581, 3, 2, 2, 0, gear_bore() + gear_teeth(), 0.001 * gear_teeth()},
      {"gear.dxf", 2, 534, 3, 2, 2, 0, gear_bore() + gear_teeth(), 5e-4},  // involutes are splines
      {"sheet.ngc", 2, 2068, 2025, 1013, 1013, 0, sheet_cuts(), 1e-6},
      {"sheet.dxf", 2, 2068, 2025, 1013, 1013, 0, sheet_cuts(), 1e-6},
      {"lettering.ngc", 2, 64, 32, 16, 1, 0, lettering, 1e-5},
      {"lettering.dxf", 2, 63, 31, 16, 1, 0, lettering, 1e-5},
      {"blades.json", 2, 844, 52, 26, 26, 0, blades, 2e-5},
      {"blades.ngc", 2, 10011, 51, 26, 26, 0, blades, 0.3},                   // chords
      {"thread.ngc", 3, 148, 22, 14, 0, 2, thread_cuts(), 6 * 16 * 25.4e-4},  // coordinates of 1e-4 in
      {"pocket.json", 3, 54, 3, 1, 0, 1, pocket, 1e-5},
  };
  for (const Expected& e : files) {
    SCOPED_TRACE(e.file);
    const Contour c = read_part(e.file);
    const Size size = size_of(c);
    EXPECT_EQ(c.dimension, e.dimension);
    EXPECT_EQ(c.path.size(), e.segments);
    EXPECT_EQ(c.blocks.size(), e.blocks);
    EXPECT_EQ(size.cuts, e.cuts);
    EXPECT_EQ(size.closed, e.closed);
    EXPECT_EQ(c.notes.size(), e.notes) << (c.notes.empty() ? "" : c.notes.front());
    EXPECT_NEAR(size.cut_length, e.cut_length, e.tolerance);
  }
}

TEST(PartFiles, FitTheMachineTheyAreMeantFor) {
  for (const auto& entry : std::filesystem::directory_iterator(test::source("examples/parts"))) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    EXPECT_LT(entry.file_size(), 600'000u);
    if (ends_with(name, ".json")) continue;  // a job of its own
    json job = test::read_json(part(name == "thread.ngc" ? "mill.json" : "laser.json"));
    job["spec"]["contour"] = {{ends_with(name, ".dxf") ? "dxf" : "gcode", test::read_file(entry.path().string())},
                              {"feed", job["spec"]["contour"]["feed"]}};
    const auto problem = test::refusal(job.dump());
    EXPECT_FALSE(problem) << problem->document().dump(1);
  }
}

/// Points along one block, a chord's sagitta at most 1e-4 mm where the radius is 0.5 mm.
std::vector<Vec> sampled(const Contour& c, const Block& block) {
  constexpr double step = 0.02;
  std::vector<Vec> points{begin_of(c.path[block.first])};
  for (std::size_t i = block.first; i < block.last; ++i) {
    const Segment& s = c.path[i];
    const int parts = s.straight() ? 1 : static_cast<int>(std::ceil(s.length() / step));
    for (int k = 1; k <= parts; ++k) points.push_back(s.at(s.s0() + s.length() * k / parts).value);
  }
  return points;
}
double distance(Vec p, Vec a, Vec b) {
  const Vec d = b - a;
  const double t = dot(d, d) > 0 ? std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0) : 0;
  return norm(a + t * d - p);
}
/// Largest distance of a point to the polygon.
double deviation(const std::vector<Vec>& points, const std::vector<Vec>& polygon) {
  double worst = 0;
  for (const Vec& p : points) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < polygon.size(); ++i) best = std::min(best, distance(p, polygon[i - 1], polygon[i]));
    worst = std::max(worst, best);
  }
  return worst;
}
/// Every so many of them.
std::vector<Vec> some(const std::vector<Vec>& points, std::size_t every) {
  std::vector<Vec> kept;
  for (std::size_t i = 0; i < points.size(); i += every) kept.push_back(points[i]);
  return kept;
}

TEST(PartFiles, GearsAgreeInShape) {
  const Contour program = read_part("gear.ngc"), drawing = read_part("gear.dxf");
  const double whole = size_of(drawing).cut_length;
  EXPECT_NEAR(size_of(program).cut_length, whole, 0.001 * whole);
  const std::vector<Vec> chords = sampled(program, program.blocks[2]), curve = sampled(drawing, drawing.blocks[2]);
  EXPECT_GT(chords.size(), 24u * 20);
  EXPECT_LT(deviation(chords, curve), 4e-4);                  // splines 1.6e-4, 4 decimals, sampling
  EXPECT_LT(deviation(some(curve, 4), chords), 0.01 + 4e-4);  // the chord error
  EXPECT_GT(deviation(some(curve, 4), chords), 0.005);        // they are chords
}

TEST(PartFiles, BladesAgreeInShape) {
  const Contour program = read_part("blades.ngc"), job = read_part("blades.json");
  std::size_t compared = 0;
  // One pass in four: the blades repeat by rotation.
  for (std::size_t i = 0; i < 26; i += 4) {
    const Block &chords = program.blocks[2 * i], &curve = job.blocks[2 * i + 1];
    ASSERT_EQ(chords.mode, Mode::cut);
    ASSERT_EQ(curve.mode, Mode::cut);
    const std::vector<Vec> points = some(sampled(program, chords), 5);
    EXPECT_LT(deviation(points, sampled(job, curve)), 3e-4);
    compared += points.size();
  }
  EXPECT_GT(compared, 400u);
}

/// Centres of the full circles, all of radius 2.5, in tenths of a millimetre.
std::set<std::pair<long, long>> holes(const Contour& c) {
  std::set<std::pair<long, long>> centres;
  for (std::size_t i = 0; i < c.path.size(); ++i) {
    const Segment& s = c.path[i];
    if (s.curve().kind() != CurveKind::arc || norm(end_of(s) - begin_of(s)) > 1e-9) continue;
    EXPECT_NEAR(s.length(), 5 * pi, 1e-6);
    const PathPoint at = s.at(s.s0());
    const Vec centre = at.value + 6.25 * at.d2;  // h + r² h''
    EXPECT_NEAR(norm(at.d2), 1 / 2.5, 1e-6);
    centres.emplace(std::lround(10 * centre.x), std::lround(10 * centre.y));
  }
  return centres;
}

TEST(PartFiles, SheetsHaveEveryHoleOnce) {
  std::set<std::pair<long, long>> grid;
  for (long column = 0; column < 40; ++column)
    for (long row = 0; row < 25; ++row) grid.emplace(250 + 100 * column, 350 + 100 * row);
  EXPECT_EQ(holes(read_part("sheet.ngc")), grid);
  EXPECT_EQ(holes(read_part("sheet.dxf")), grid);
  // Rows in serpentine order: one pitch from hole to hole.
  const Contour c = read_part("sheet.ngc");
  std::size_t steps = 0;
  for (const Block& b : c.blocks)
    if (b.mode == Mode::position && std::abs(c.path[b.last - 1].s1() - c.path[b.first].s0() - 10) < 1e-9) ++steps;
  EXPECT_EQ(steps, 999u);
}

TEST(PartFiles, BracketsOutlineIsALayer) {
  DxfOptions options;
  options.layers = {"outline"};
  const Contour c = read_part("bracket.dxf", options);
  EXPECT_EQ(c.blocks.size(), 1u);
  EXPECT_NEAR(c.path.length(), bracket_outline(), 1e-6);
}

TEST(PartFiles, LetteringIsWrittenTheSameBothWays) {
  const Contour program = read_part("lettering.ngc"), drawing = read_part("lettering.dxf");
  EXPECT_NEAR(size_of(program).cut_length, size_of(drawing).cut_length, 1e-6);
  // The wave: one block of 16 splines, G5 that go on with the tangent of the last one.
  const Block& wave = program.blocks[program.blocks.size() - 2];
  ASSERT_EQ(wave.last - wave.first, 16u);
  for (std::size_t i = wave.first + 1; i < wave.last; ++i) {
    const Vec before = program.path[i - 1].at_parameter(program.path[i - 1].curve().end()).d1;
    EXPECT_LT(norm(before - program.path[i].at_parameter(program.path[i].curve().begin()).d1), 1e-9);
  }
}

TEST(PartFiles, ThreadsRiseByTheirPitch) {
  const Contour c = read_part("thread.ngc");
  std::size_t turns = 0;
  double lowest = 0;
  for (std::size_t i = 0; i < c.path.size(); ++i) {
    const Segment& s = c.path[i];
    const Vec rise = end_of(s) - begin_of(s);
    lowest = std::min(lowest, end_of(s).z);
    if (s.curve().kind() != CurveKind::arc || std::hypot(rise.x, rise.y) > 1e-9) continue;
    ++turns;
    EXPECT_NEAR(rise.z, 2.54, 1e-9);
    EXPECT_NEAR(s.length(), 25.4 * std::hypot(2 * pi * 0.125, 0.1), 1e-9);
  }
  EXPECT_EQ(turns, 36u);
  EXPECT_NEAR(lowest, -0.7 * 25.4, 1e-9);
}

TEST(PartFiles, PocketsPassesLieOnItsFloorAndJoinSmoothly) {
  const Contour c = read_part("pocket.json");
  const Block& cut = c.blocks[1];
  ASSERT_EQ(cut.last - cut.first, 2u + 1 + 25 + 24);
  for (std::size_t i = cut.first + 3; i < cut.last; i += 2)  // behind helix and lead-in every other one is a pass
    for (int k = 0; k <= 20; ++k) {
      const Vec p = c.path[i].at(c.path[i].s0() + c.path[i].length() * k / 20).value;
      const double x = p.x / 40, y = p.y / 25;
      EXPECT_NEAR(p.z, -8 + 5 * x * x + 3 * y * y + 1.5 * x * x * x * y, 1e-7);
    }
  for (std::size_t i = cut.first + 1; i < cut.last; ++i) {
    const PathPoint a = c.path[i - 1].at_parameter(c.path[i - 1].curve().end());
    const PathPoint b = c.path[i].at_parameter(c.path[i].curve().begin());
    EXPECT_LT(norm(a.d1 - b.d1), 1e-7) << i;
    EXPECT_LT(norm(a.d2 - b.d2), 1e-7) << i;
  }
}

TEST(PartFiles, AreWhatTheirScriptWrites) {
  EXPECT_EQ(std::system(("python3 '" + test::source("examples/make_parts.py") + "' --check").c_str()), 0);
}

}  // namespace
}  // namespace bahnwerk::api
