#include "api/kinds/contour/contour_scene.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/plan/contour/contour_outline.hpp"

namespace bahnwerk::api::contour {
namespace {

/// Returns the places that the fine axes reach from where the coarse ones stand.
SceneBody fine_range(const CoarseFineMachine& machine) {
  std::array<double, 3> stroke{};
  for (std::size_t k = 0; k < std::min(stroke.size(), machine.axes.size()); ++k) stroke[k] = machine.axes[k].stroke;
  const auto [x, y, z] = stroke;
  SceneBody body{.name = "fine range", .kind = SceneBody::Kind::extrusion, .moves = "coarse"};
  body.outline = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  body.from = -z, body.to = z;
  return body;
}

/// Adds a line per row of edges with one mode.
void add_lines(const Outline& shape, Scene& scene) {
  SceneBody line;
  for (std::size_t i = 1; i < shape.vertices.size(); ++i) {
    if (line.points.empty()) line = {.name = shape.cut[i] ? "cut" : "position", .points = {shape.vertices[i - 1]}};
    line.points.push_back(shape.vertices[i]);
    if (i + 1 < shape.vertices.size() && shape.cut[i + 1] == shape.cut[i]) continue;
    scene.add(std::exchange(line, {}));
  }
}

}  // namespace

Scene contour_scene(const Contour& contour, const CoarseFineMachine& machine, Progress progress) {
  const Outline shape = outline(contour, max_scene_vertices / 2, progress);
  Scene scene;
  scene.tolerance = shape.tolerance;
  scene.movers = {{"tool", {"x", "y", "z"}}, {"coarse", {"xc", "yc", "zc"}}};
  scene.add({.name = "head", .kind = SceneBody::Kind::points, .moves = "tool", .points = {{}}});
  scene.add(fine_range(machine));
  add_lines(shape, scene);
  return scene;
}

}  // namespace bahnwerk::api::contour
