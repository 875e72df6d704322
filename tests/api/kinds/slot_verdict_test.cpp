/// Kinds fill_factor and winding decide with one code whether a coil can be wound: for one slot, wire and needle both
/// have the same places and the same verdict.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "core/geometry/region/point.hpp"
#include "core/numeric/random.hpp"
#include "tests/api/kinds/winding_documents.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

/// A slot and the part that has it: members of kind winding's `part` but `slot`.
struct Wound {
  std::string name;
  json slot, part;
};

json drawn(const std::vector<Point>& points, double liner, Point left, Point right) {
  json list = json::array();
  for (const Point p : points) list.push_back({p.x, p.y});
  return {{"type", "polygon"}, {"points", list}, {"liner", liner}, {"opening", {{left.x, left.y}, {right.x, right.y}}}};
}

/// A slot with rounded base corners, flanks that lean inwards, and tooth tips.
json tipped(double base, double top, double height, double opening, double tip, double corner, double turned) {
  std::vector<Point> points;
  for (const double side : {-1.0, 1.0})
    for (int k = 0; k <= 8; ++k) {
      const double angle = (side < 0 ? std::numbers::pi : 1.5 * std::numbers::pi) + k * std::numbers::pi / 16;
      points.push_back(Point{side * (base / 2 - corner), corner} + corner * Point{std::cos(angle), std::sin(angle)});
    }
  const Point left{-opening / 2, height}, right{opening / 2, height};
  for (const Point p : {Point{top / 2, height - tip},
                        {opening / 2, height - tip},
                        right,
                        left,
                        {-opening / 2, height - tip},
                        {-top / 2, height - tip}})
    points.push_back(p);
  const Point x{std::cos(turned), std::sin(turned)}, y = left_of(x);
  const auto place = [&](Point p) { return Point{turned == 0 ? 0. : 30, 0} + p.x * x + p.y * y; };
  for (Point& p : points) p = place(p);
  return drawn(points, 0.2, place(left), place(right));
}

/// All slots of the shipped examples, and drawn ones: upright, turned, with parallel flanks, without tooth tips.
std::vector<Wound> wound_slots() {
  std::vector<Wound> list;
  std::set<std::string> known;
  const auto add = [&](const std::string& name, json slot, const json& part) {
    slot.erase("type");
    if (known.insert(slot.dump() + part.dump()).second) list.push_back({name, std::move(slot), part});
  };
  for (const char* folder : {"examples", "schemas/examples/fill_factor", "schemas/examples/winding"})
    for (const std::string& file : test::json_files(folder)) {
      json spec = test::read_json(file);
      if (spec.contains("spec")) spec = json(spec["spec"]);
      json part = json::object();
      if (spec.contains("part")) {
        part = spec["part"];
        add(file, part["slot"], part);
      } else if (spec.contains("slot") && spec["slot"]["type"] != "polygon") {
        part = spec.value("heads", json::object());
        for (const char* member : {"slot_pitch", "span"}) part.erase(member);
        part["type"] = spec["slot"]["type"];
        add(file, spec["slot"], part);
      }
    }
  for (Wound& each : list) each.part.erase("slot");
  const json stator{{"type", "stator"}, {"base_radius", 48}, {"slots", 24}};
  const json trapezoid = drawn({{0, 0}, {6, 0}, {5, 12}, {1, 12}}, 0.2, {1, 12}, {5, 12});
  list.push_back({"trapezoid", trapezoid, stator});
  list.push_back({"tooth tips", tipped(6, 4, 13, 2.8, 0.8, 1.2, 0), stator});
  list.push_back({"tooth tips, turned", tipped(6, 4, 13, 2.8, 0.8, 1.2, 2), stator});
  list.push_back({"narrow", tipped(3.92, 3.14, 12.3, 1.64, 0.82, 1, 0), stator});
  json shifted = stator;
  shifted["tool_shift"] = 0.7, shifted["tool_height"] = 9, shifted["tool_radius"] = 50;
  list.push_back({"other tools", tipped(6, 6, 12, 2.4, 1, 0.5, -1), shifted});
  return list;
}

json fill_of(const Wound& wound, const json& wire, const json& needle) {
  json heads = json::object();
  for (const auto& [member, value] : wound.part.items())
    if (member != "type" && member != "slots" && (member != "base_radius" || wound.slot.contains("points")))
      heads[member] = value;
  json slot = wound.slot;
  if (!slot.contains("points")) slot["type"] = wound.part["type"];
  json spec{{"slot", slot}, {"wires", {wire}}, {"algorithms", {"needle"}}, {"heads", heads}, {"drawings", false}};
  spec["needle_width"] = needle["width"];
  spec["needle_swivels"] = !needle["pivot_limit"].is_null();
  return spec;
}

json winding_of(const Wound& wound, const json& wire, const json& needle) {
  json part = wound.part;
  part["slot"] = wound.slot;
  const bool stator = part["type"] == "stator";
  json spec = example(stator ? "complete" : "rotor");
  spec["part"] = part, spec["wire"] = wire, spec["needle"] = needle;
  spec["needle"]["clearance"] = -20;
  spec["coil"] = {{"slots", {0, stator ? 5 : 1}}, {"turns", 1}};
  spec["feed"] = {{"method", "natural"}};
  for (const char* member : {"path", "pull", "grade", "tool", "producible"}) spec.erase(member);
  for (auto& [name, axis] : spec["machine"]["axes"].items()) axis["range"] = nullptr;
  return spec;
}

TEST(SlotVerdict, BothKindsHaveOneForEverySlot) {
  std::size_t blocked = 0, whole = 0;
  for (const Wound& wound : wound_slots())
    for (const double copper : {0.82, 1.12})
      for (const json& pivot : {json(nullptr), json(10)}) {
        SCOPED_TRACE(wound.name + ", " + std::to_string(copper) + ", pivot " + pivot.dump());
        const json wire{{"copper", copper}, {"outer", copper + 0.08}};
        const json needle{{"width", 1.5}, {"pivot_limit", pivot}};
        Progress silent;
        const json filled = find_kind("fill_factor")->plan(fill_of(wound, wire, needle), silent).result;
        const json wind = find_kind("winding")->plan(winding_of(wound, wire, needle), silent).result;
        const json &places = filled["details"]["layouts"][0], &layout = wind["details"]["layout"];
        EXPECT_EQ(places["count"], layout["count"]);
        EXPECT_EQ(places["windable"], layout["windable"]);
        EXPECT_EQ(places["windable"]["turns"], wind["summary"]["windable_turns"]);
        const bool all = places["producible"];
        all ? ++whole : ++blocked;
        for (const json& obstacle : places["blocked_by"])
          EXPECT_TRUE(pivot.is_null() || obstacle["part"] != "channel") << "a needle that swivels needs no channel";
      }
  EXPECT_GT(blocked, 3u);
  EXPECT_GT(whole, 3u);
}

/// Only the places of the tools relative to the slot's base count, which have defaults.
TEST(SlotVerdict, ADrawnSlotNeedsNoRadius) {
  const Wound wound{"", tipped(6, 4, 13, 2.8, 0.8, 1.2, 0), {{"type", "stator"}}};
  const auto layout = [&](const json& heads) {
    json spec = fill_of(wound, 0.8, {{"width", 1.6}, {"pivot_limit", nullptr}});
    spec["heads"] = heads;
    Progress silent;
    return json(find_kind("fill_factor")->plan(spec, silent).result)["details"]["layouts"][0];
  };
  const json assumed = layout(json::object());
  for (const double radius : {30, 95})
    EXPECT_EQ(layout({{"base_radius", radius}})["windable"], assumed["windable"]) << radius;
  EXPECT_NE(layout({{"tool_shift", 0.2}})["positions"], assumed["positions"]);
}

/// Results are in the coordinates of the drawing, however it is turned.
TEST(SlotVerdict, ATurnedDrawingTakesTheSameWires) {
  const auto filled = [&](double turned) {
    const Wound wound{"", tipped(6, 4, 13, 2.8, 0.8, 1.2, turned), {{"type", "stator"}}};
    json spec = fill_of(wound, 0.8, {{"width", 1.6}, {"pivot_limit", nullptr}});
    spec["algorithms"] = {"orthocyclic_base", "raabe", "needle"};
    Progress silent;
    return json(find_kind("fill_factor")->plan(spec, silent).result)["details"];
  };
  const json upright = filled(0);
  for (const double turned : {0.7, 2.0, std::numbers::pi}) {
    const json other = filled(turned);
    for (std::size_t k = 0; k < 3; ++k) {
      const json &a = upright["layouts"][k], &b = other["layouts"][k];
      ASSERT_EQ(a["count"], b["count"]) << a["algorithm"];
      EXPECT_EQ(a["windable"], b["windable"]);
      for (std::size_t i = 0; i < a["positions"].size(); ++i) {
        const Point p{a["positions"][i][0], a["positions"][i][1]}, q{b["positions"][i][0], b["positions"][i][1]};
        const Point x{std::cos(turned), std::sin(turned)}, at = Point{30, 0} + p.x * x + p.y * left_of(x);
        EXPECT_NEAR(distance(at, q), 0, 1e-6) << a["algorithm"] << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk::api::winding_kind
