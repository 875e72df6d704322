#include "api/scene.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/named.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;
using Kind = SceneBody::Kind;

constexpr Named<Kind> kinds_of_bodies[] = {{Kind::extrusion, "extrusion"},
                                           {Kind::polyline, "polyline"},
                                           {Kind::tube, "tube"},
                                           {Kind::cylinder, "cylinder"},
                                           {Kind::points, "points"}};

ordered_json numbers(const Vec& p) { return {p.x, p.y, p.z}; }

ordered_json line(const std::vector<Vec>& points) {
  ordered_json out = ordered_json::array();
  for (const Vec& p : points) out.push_back(numbers(p));
  return out;
}

ordered_json line(const std::vector<SceneBody::Flat>& points) {
  ordered_json out = ordered_json::array();
  for (const auto& p : points) out.push_back({p[0], p[1]});
  return out;
}

ordered_json document(const SceneBody& body) {
  ordered_json out{{"name", body.name}, {"kind", name_of<Kind>(body.kind, kinds_of_bodies)}, {"moves", body.moves}};
  if (body.coil) out["coil"] = *body.coil;
  if (body.slot) out["slot"] = *body.slot;
  if (body.kind != Kind::extrusion) {
    if (body.radius > 0) out["radius"] = body.radius;
    if (body.kind == Kind::cylinder) out["round_end"] = body.round_end;
    out["points"] = line(body.points);
    if (!body.times.empty()) out["times"] = body.times;
    return out;
  }
  out["outline"] = line(body.outline);
  if (!body.holes.empty()) {
    out["holes"] = ordered_json::array();
    for (const auto& hole : body.holes) out["holes"].push_back(line(hole));
  }
  out["from"] = body.from;
  out["to"] = body.to;
  if (body.frame)
    out["frame"] = {{"origin", numbers(body.frame->origin)},
                    {"x", numbers(body.frame->x)},
                    {"y", numbers(body.frame->y)},
                    {"z", numbers(body.frame->z)}};
  if (body.assumed_outline) out["assumed"] = ordered_json::array({"outline"});
  return out;
}

/// The box of points; null without any.
class BoxInSpace {
 public:
  void widen(const Vec& p, double by) {
    for (std::size_t k = 0; k < 3; ++k)
      low_[k] = std::min(low_[k], p[k] - by), high_[k] = std::max(high_[k], p[k] + by);
  }
  void widen(const SceneBody& body) {
    for (const Vec& p : body.points) widen(p, body.radius);
    const SceneBody::Frame frame = body.frame.value_or(SceneBody::Frame{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    for (const double w : {body.from, body.to})
      for (const auto& p : body.outline) widen(frame.origin + p[0] * frame.x + p[1] * frame.y + w * frame.z, 0);
  }
  ordered_json document() const {
    if (low_.x > high_.x) return nullptr;
    return {numbers(low_), numbers(high_)};
  }

 private:
  static constexpr double far = std::numeric_limits<double>::infinity();
  Vec low_{far, far, far}, high_{-far, -far, -far};
};

}  // namespace

std::size_t SceneBody::vertices() const {
  std::size_t sum = points.size() + outline.size();
  for (const auto& hole : holes) sum += hole.size();
  return sum;
}

std::size_t Scene::vertices() const {
  std::size_t sum = 0;
  for (const SceneBody& body : bodies) sum += body.vertices();
  return sum;
}

void Scene::add(SceneBody body, std::size_t most) {
  if (vertices() + body.vertices() > most)
    ++left_out;
  else
    bodies.push_back(std::move(body));
}

ordered_json scene_document(std::string_view kind, const Scene& scene) {
  BoxInSpace box;
  ordered_json bodies = ordered_json::array(), movers = ordered_json::object();
  for (const SceneBody& body : scene.bodies) {
    if (body.moves == "none") box.widen(body);
    bodies.push_back(document(body));
  }
  for (const SceneMover& mover : scene.movers) {
    ordered_json columns{{"position", mover.position}};
    if (mover.turns) columns.update({{"phi", "phi"}, {"psi", "psi"}});
    movers[mover.name] = std::move(columns);
  }
  ordered_json place = nullptr;
  if (const auto& at = scene.place) place = {{"x", at->x}, {"y", at->y}, {"z", at->z}, {"angle", at->angle}};
  return {{"kind", kind},
          {"unit", "mm"},
          {"frame", scene.frame},
          {"place", std::move(place)},
          {"vertices", scene.vertices()},
          {"tolerance", scene.tolerance},
          {"left_out", scene.left_out},
          {"box", box.document()},
          {"movers", std::move(movers)},
          {"bodies", std::move(bodies)}};
}

}  // namespace bahnwerk::api
