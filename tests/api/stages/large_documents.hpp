#pragma once
/// Specs of every kind whose every stage has something to do.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "tests/api/documents.hpp"

namespace bahnwerk::api::test {

struct Large {
  std::string name, kind;
  nlohmann::json spec;
};

/// The document as it would be posted.
inline std::string job(const Large& large) { return nlohmann::json{{"kind", large.kind}, {"spec", large.spec}}.dump(); }

inline void PrintTo(const Large& large, std::ostream* out) { *out << large.name; }

inline nlohmann::json machine_xy(bool jerk = false) {
  nlohmann::json axis{{"velocity", 1800}, {"acceleration", 16000}};
  if (jerk) axis["jerk"] = 800000;
  return {{"kinematics", "cartesian"}, {"axes", {{"x", axis}, {"y", axis}}}, {"cycle_time", 0.001}};
}

inline nlohmann::json contour_spec(nlohmann::json contour, const std::string& method, nlohmann::json corner = nullptr) {
  nlohmann::json planning{{"method", method}};
  if (!corner.is_null()) planning["corner"] = std::move(corner);
  return {{"contour", std::move(contour)}, {"machine", machine_xy(method == "jerk_limited")}, {"planning", planning}};
}

/// Half circles end to end.
inline nlohmann::json snake(int arcs) {
  auto segments = nlohmann::json::array();
  for (int i = 1; i <= arcs; ++i)
    segments.push_back(
        {{"arc", {{"to", {2 * i, 0}}, {"center", {2 * i - 1, 0}}, {"direction", i % 2 ? "cw" : "ccw"}}}});
  return {{"start", {0, 0}}, {"blocks", {{{"mode", "cut"}, {"segments", segments}}}}};
}

/// Chords of waves: turns small enough to pass, and every hundredth point a corner.
inline nlohmann::json waves(int points) {
  auto list = nlohmann::json::array();
  for (int i = 0; i < points; ++i) list.push_back({0.2 * i, 5 * std::sin(0.01 * i) + (i % 100 == 50 ? 0.05 : 0.0)});
  return {{"points", list}};
}

inline nlohmann::json zigzag(int lines) {
  auto segments = nlohmann::json::array();
  for (int i = 1; i <= lines; ++i) segments.push_back({{"line", {0.7 * i, i % 2 ? 0.4 : 0.0}}});
  return {{"start", {0, 0}}, {"blocks", {{{"mode", "cut"}, {"feed", 300}, {"segments", segments}}}}};
}

inline nlohmann::json free_form(int curves) {
  auto segments = nlohmann::json::array();
  for (int i = 0; i < curves; ++i)
    segments.push_back({{"nurbs",
                         {{"degree", 3},
                          {"points", {{3 * i, 0}, {3 * i + 1, 0.6}, {3 * i + 2, -0.6}, {3 * i + 3, 0}}},
                          {"weights", {1, 2, 0.5, 1}},
                          {"knots", {0, 0, 0, 0, 1, 1, 1, 1}}}}});
  return {{"start", {0, 0}}, {"blocks", {{{"mode", "cut"}, {"segments", segments}}}}};
}

inline nlohmann::json program(int lines) {
  std::string text = "G21 G90 F12000\n";
  char line[80];
  for (int i = 1; i <= lines; ++i) {
    std::snprintf(line, sizeof line, "G1 X%.4f Y%.4f\n", 0.3 * i, 3 * std::sin(0.05 * i));
    text += line;
  }
  return {{"gcode", text + "M30\n"}};
}

/// Lines end to end, drawn in a shuffled order.
inline nlohmann::json drawing(int lines) {
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

/// A slot with a wavy outline of that many corners.
inline nlohmann::json wavy_slot(int corners) {
  auto points = nlohmann::json::array();
  for (int i = 0; i < corners; ++i) {
    const double t = 2 * std::numbers::pi * i / corners;
    points.push_back({(7 + 0.05 * std::sin(40 * t)) * std::cos(t), 15 + (13 + 0.05 * std::sin(40 * t)) * std::sin(t)});
  }
  return {{"type", "polygon"}, {"points", points}, {"liner", 0.2}};
}

/// A stator coil, links by time.
inline nlohmann::json winding_spec(int turns) {
  nlohmann::json spec = read_json(source("schemas/examples/winding/complete.json"));
  spec["coil"] = {{"slots", spec["coil"]["slots"]}, {"turns", turns}};
  spec["path"]["objective"] = "minimum_time";
  return spec;
}

/// A round slot of that many corners for a wide wire, which no layout takes many of, and a thin one.
inline nlohmann::json round_slot_spec(int corners) {
  auto points = nlohmann::json::array();
  for (int k = 0; k < corners; ++k) {
    const double t = 2 * std::numbers::pi * k / corners;
    points.push_back({5 * std::cos(t), 5 * std::sin(t)});
  }
  const std::size_t n = points.size(), k = n / 5;
  const nlohmann::json opening{points[k], points[n / 2 - k]};
  return {{"slot", {{"type", "polygon"}, {"points", points}, {"opening", opening}}},
          {"wires",
           {{{"copper", 0.7}, {"outer", 0.75}, {"tolerance", 0.03}},
            {{"copper", 8.8}, {"outer", 9.2}, {"tolerance", 0.02}}}},
          {"needle_width", 2},
          {"effort", 0.1},
          {"robustness", {{"samples", 1}, {"slot_tolerance", 0.01}}}};
}

/// `size`: 1, or less for smaller documents of the same kind; those of the same place in the list belong together.
inline std::vector<Large> large_documents(double size = 1) {
  const nlohmann::json blend{{"mode", "blend"}, {"tolerance", 0.02}};
  const auto n = [size](int full) { return static_cast<int>(size * full); };
  return {
      {"waves", "contour", contour_spec(waves(n(60'000)), "time_optimal")},
      {"waves, braking reserve", "contour", contour_spec(waves(n(60'000)), "braking_reserve")},
      {"waves, jerk", "contour", contour_spec(waves(n(20'000)), "jerk_limited")},
      {"snake", "contour", contour_spec(snake(n(1'000)), "time_optimal")},
      {"snake, jerk", "contour", contour_spec(snake(n(300)), "jerk_limited")},
      {"zigzag, blended", "contour", contour_spec(zigzag(n(3'000)), "time_optimal", blend)},
      {"zigzag, blended, jerk", "contour", contour_spec(zigzag(n(1'500)), "jerk_limited", blend)},
      {"waves, blended", "contour", contour_spec(waves(n(10'000)), "time_optimal", blend)},
      {"free-form", "contour", contour_spec(free_form(n(1'000)), "time_optimal")},
      {"free-form, blended", "contour", contour_spec(free_form(n(1'000)), "time_optimal", blend)},
      {"part program", "contour", contour_spec(program(n(40'000)), "time_optimal")},
      {"drawing", "contour", contour_spec(drawing(n(10'000)), "time_optimal")},
      {"wavy slot",
       "fill_factor",
       {{"slot", wavy_slot(n(2'000))}, {"wires", {0.9}}, {"algorithms", {"orthocyclic_base", "raabe", "needle"}}}},
      {"wavy slot, potential",
       "fill_factor",
       {{"slot", wavy_slot(n(1'000))}, {"wires", {1.25}}, {"algorithms", {"potential"}}}},
      {"wavy slot, robustness",
       "fill_factor",
       {{"slot", wavy_slot(n(1'000))},
        {"wires", {1.25}},
        {"algorithms", {"needle"}},
        {"robustness", {{"samples", 20}}}}},
      {"round slot", "fill_factor", round_slot_spec(n(2'000))},
      {"many wires",
       "fill_factor",
       {{"slot", wavy_slot(60)},
        {"wires", {size < 1 ? 0.71 : 0.355}},
        {"algorithms", {"orthocyclic_flank", "raabe", "potential", "needle"}}}},
      {"winding, links by time", "winding", winding_spec(size < 1 ? 1 : 4)},
  };
}

}  // namespace bahnwerk::api::test
