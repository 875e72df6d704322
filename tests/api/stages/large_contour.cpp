// Large documents of kind contour: long paths of every form, by every method.
#include <cmath>
#include <cstdio>

#include "large_documents.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api::test {
namespace {

using nlohmann::json;

json machine_xy(bool jerk = false) {
  json axis{{"velocity", 1800}, {"acceleration", 16000}};
  if (jerk) axis["jerk"] = 800000;
  return {{"kinematics", "cartesian"}, {"axes", {{"x", axis}, {"y", axis}}}, {"cycle_time", 0.001}};
}

json contour_spec(json contour, const std::string& method, json corner = nullptr) {
  json planning{{"method", method}};
  if (!corner.is_null()) planning["corner"] = std::move(corner);
  return {{"contour", std::move(contour)}, {"machine", machine_xy(method == "jerk_limited")}, {"planning", planning}};
}

/// Half circles end to end.
json snake(int arcs) {
  auto segments = json::array();
  for (int i = 1; i <= arcs; ++i)
    segments.push_back(
        {{"arc", {{"to", {2 * i, 0}}, {"center", {2 * i - 1, 0}}, {"direction", i % 2 ? "cw" : "ccw"}}}});
  return {{"start", {0, 0}}, {"blocks", {{{"mode", "cut"}, {"segments", segments}}}}};
}

/// Chords of waves: turns small enough to pass, and every hundredth point a corner.
json waves(int points) {
  auto list = json::array();
  for (int i = 0; i < points; ++i) list.push_back({0.2 * i, 5 * std::sin(0.01 * i) + (i % 100 == 50 ? 0.05 : 0.0)});
  return {{"points", list}};
}

json zigzag(int lines) {
  auto segments = json::array();
  for (int i = 1; i <= lines; ++i) segments.push_back({{"line", {0.7 * i, i % 2 ? 0.4 : 0.0}}});
  return {{"start", {0, 0}}, {"blocks", {{{"mode", "cut"}, {"feed", 300}, {"segments", segments}}}}};
}

json free_form(int curves) {
  auto segments = json::array();
  for (int i = 0; i < curves; ++i)
    segments.push_back({{"nurbs",
                         {{"degree", 3},
                          {"points", {{3 * i, 0}, {3 * i + 1, 0.6}, {3 * i + 2, -0.6}, {3 * i + 3, 0}}},
                          {"weights", {1, 2, 0.5, 1}},
                          {"knots", {0, 0, 0, 0, 1, 1, 1, 1}}}}});
  return {{"start", {0, 0}}, {"blocks", {{{"mode", "cut"}, {"segments", segments}}}}};
}

json program(int lines) {
  std::string text = "G21 G90 F12000\n";
  char line[80];
  for (int i = 1; i <= lines; ++i) {
    std::snprintf(line, sizeof line, "G1 X%.4f Y%.4f\n", 0.3 * i, 3 * std::sin(0.05 * i));
    text += line;
  }
  return {{"gcode", text + "M30\n"}};
}

/// Lines end to end, drawn in a shuffled order.
json drawing(int lines) {
  std::string text = "0\nSECTION\n2\nENTITIES\n";
  char entity[200];
  for (int k = 0; k < lines; ++k) {
    const int i = static_cast<int>((static_cast<long>(k) * 7919) % lines);
    std::snprintf(entity, sizeof entity, "0\nLINE\n8\n0\n10\n%.6f\n20\n%.6f\n11\n%.6f\n21\n%.6f\n", 0.3 * i,
                  3 * std::sin(0.05 * i), 0.3 * (i + 1), 3 * std::sin(0.05 * (i + 1)));
    text += entity;
  }
  return {{"dxf", text + "0\nENDSEC\n0\nEOF\n"}, {"order", "nearest"}, {"unit", 1}};
}

std::vector<Large> contour_large(double size) {
  const json blend{{"mode", "blend"}, {"tolerance", 0.02}};
  const auto n = [size](int full) { return static_cast<int>(size * full); };
  return {
      {"waves", "contour", contour_spec(waves(n(60'000)), "time_optimal"), true},
      {"waves, braking reserve", "contour", contour_spec(waves(n(60'000)), "braking_reserve"), true},
      {"waves, jerk", "contour", contour_spec(waves(n(20'000)), "jerk_limited"), true},
      {"snake", "contour", contour_spec(snake(n(1'000)), "time_optimal"), true},
      {"snake, jerk", "contour", contour_spec(snake(n(300)), "jerk_limited"), true},
      {"zigzag, blended", "contour", contour_spec(zigzag(n(3'000)), "time_optimal", blend), true},
      {"zigzag, blended, jerk", "contour", contour_spec(zigzag(n(1'500)), "jerk_limited", blend), true},
      {"waves, blended", "contour", contour_spec(waves(n(10'000)), "time_optimal", blend), true},
      {"free-form", "contour", contour_spec(free_form(n(1'000)), "time_optimal"), true},
      {"free-form, blended", "contour", contour_spec(free_form(n(1'000)), "time_optimal", blend), true},
      {"part program", "contour", contour_spec(program(n(40'000)), "time_optimal"), true},
      {"drawing", "contour", contour_spec(drawing(n(10'000)), "time_optimal"), true},
  };
}

std::vector<Large> contour_small() {
  std::vector<Large> all{{"contour minimal", "contour", read_json(source("schemas/examples/contour/minimal.json"))}};
  for (const std::string file : {"bracket", "circle", "helix", "line", "polyline"})
    all.push_back({file, "contour", read_json(source("examples/" + file + ".json"))["spec"]});
  return all;
}

const KindDocuments contour_documents("contour", contour_large, contour_small);

}  // namespace
}  // namespace bahnwerk::api::test
