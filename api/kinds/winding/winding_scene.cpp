#include "api/kinds/winding/winding_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "api/kinds/winding/winding_result.hpp"
#include "core/plan/winding/path_clearance.hpp"
#include "core/winding/drawing/part_outline.hpp"
#include "core/winding/part/turns.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using Kind = SceneBody::Kind;

// Vertices up to which bodies of each sort are added, so that what follows fits.
constexpr std::size_t most_of_part = 2500, most_of_tools = 3000, most_of_slots = 4000;
constexpr double finest = 0.02, outer_edge = 1.1;  // mm; radius of a stator's assumed outer edge by that of its slots

std::vector<SceneBody::Flat> flat(const std::vector<Point>& points) {
  std::vector<SceneBody::Flat> out;
  for (const Point& p : points) out.push_back({p.x, p.y});
  return out;
}

/// Returns a circle about the axis, outside all holes.
std::vector<Point> outer_circle(const std::vector<std::vector<Point>>& holes) {
  constexpr int corners = 120;
  double radius = 0;
  for (const auto& hole : holes)
    for (const Point& p : hole) radius = std::max(radius, norm(p));
  std::vector<Point> circle;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    circle.push_back(outer_edge * radius * Point{std::cos(angle), std::sin(angle)});
  }
  return circle;
}

SceneBody body_of(const winding::Solid& solid, const std::string& name) {
  SceneBody body{.name = name, .kind = Kind::extrusion};
  body.assumed_outline = solid.outline.empty();
  body.outline = flat(body.assumed_outline ? outer_circle(solid.holes) : solid.outline);
  for (const auto& hole : solid.holes) body.holes.push_back(flat(hole));
  body.from = solid.from, body.to = solid.to;
  if (!(solid.x == Vec{1, 0, 0} && solid.y == Vec{0, 1, 0} && solid.origin == Vec{}))
    body.frame = SceneBody::Frame{solid.origin, solid.x, solid.y, solid.z};
  return body;
}

/// Adds the obstacles: those of all coils once, the others with the number of their coil.
void add_obstacles(const WindingRequest& request, Scene& scene) {
  for (std::size_t coil = 0; coil < request.coils.size(); ++coil) {
    const winding::PartObstacles all = coil_obstacles(request, coil);
    for (std::size_t i = 0; i < all.list().size(); ++i) {
      const bool tool = all.name(i) == winding::winding_tool;
      if (coil > 0 && !tool) continue;
      SceneBody body = body_of(all.list()[i]->solid(scene.tolerance), all.name(i));
      if (tool) body.coil = coil + 1;
      scene.add(std::move(body), most_of_tools);
    }
  }
}

/// Adds the lines of the slots of all coils.
template <class Part>
void add_slots(const WindingRequest& request, const Part& part, Scene& scene) {
  constexpr bool stator = std::is_same_v<Part, winding::StatorPart>;
  const winding::Slot slot = winding::checked_slot(part);
  for (std::size_t coil = 0; coil < request.coils.size(); ++coil)
    for (const winding::Polyline3& line : winding::coil_outline(part, slot, request.coils[coil])) {
      SceneBody body{.name = stator ? "slot" : "pole"};
      body.coil = coil + 1;
      if constexpr (stator) {
        const double at = std::atan2(line.front().y, line.front().x) / part.pitch();
        body.slot = static_cast<std::size_t>((static_cast<int>(std::lround(at)) + part.slots) % part.slots);
      }
      body.points = line;
      scene.add(std::move(body), most_of_slots);
    }
}

std::vector<Point> positions(const json& regions, std::size_t region) {
  std::vector<Point> list;
  for (const json& p : regions.at(laying_region(region)).at("positions"))
    list.push_back({p.at(0).get<double>(), p.at(1).get<double>()});
  return list;
}

/// Adds a line per coil through the places of its turns, as they were laid; where there are too many, every n-th turn.
template <class Part>
void add_wires(const WindingRequest& request, const Part& part, const json& details, Scene& scene) {
  if (!details.contains("layout") || !details.contains("turns")) return;
  winding::NeedleLayout layouts;
  for (std::size_t j = 0; j < layouts.size(); ++j) layouts[j].wires = positions(details["layout"]["regions"], j);
  const json& times = details["turns"];
  const winding::Slot slot = winding::checked_slot(part);
  std::vector<winding::LayingRegions> regions;
  for (const winding::Coil& coil : request.coils) regions.push_back(winding::coil_regions(part, slot, coil));
  const std::vector<winding::Turn> turns =
      winding::turns_of(regions, layouts, times.size() / request.coils.size(), request.wire.radius(), request.parallel);
  constexpr std::size_t per_turn = 8;
  const std::size_t room = (max_scene_vertices - scene.vertices()) / per_turn, step = (turns.size() + room - 1) / room;
  SceneBody line;
  const auto add = [&] {
    if (!line.points.empty()) scene.add(std::exchange(line, {}));
  };
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (i % step != 0) {
      ++scene.left_out;
      continue;
    }
    if (line.coil != turns[i].coil + 1) {
      add();
      line = {.name = "wire", .coil = turns[i].coil + 1, .radius = request.wire.radius()};
    }
    for (const winding::Passage& passage : turns[i].at)
      for (const Vec& at : {passage.begin, passage.end}) {
        line.points.push_back(at);
        line.times.push_back(times[i].at("begins").get<double>());
      }
  }
  add();
}

SceneBody needle(const winding::NeedleShape& shape) {
  SceneBody body{.name = "needle", .kind = Kind::cylinder, .moves = "tool"};
  body.points = {{-shape.length, 0, 0}, {-shape.width / 2, 0, 0}};
  body.radius = shape.width / 2;
  body.round_end = true;
  return body;
}

}  // namespace

Scene winding_scene(const WindingRequest& request, const json& result) {
  Scene scene;
  scene.frame = "part";
  scene.place = request.frame;
  scene.movers = {{"tool", {"x", "y", "z"}, true}};
  scene.bodies.push_back(needle(request.needle));
  const winding::PartObstacles first = coil_obstacles(request, 0);
  scene.tolerance = finest;
  const auto size = [&] {
    const winding::Solid solid = first.list().front()->solid(scene.tolerance);
    return body_of(solid, {}).vertices();
  };
  while (scene.tolerance < 1 && size() > most_of_part) scene.tolerance *= 2;
  add_obstacles(request, scene);
  std::visit(
      [&](const auto& part) {
        add_slots(request, part, scene);
        add_wires(request, part, result.value("details", json::object()), scene);
      },
      request.part);
  return scene;
}

}  // namespace bahnwerk::api::winding_kind
