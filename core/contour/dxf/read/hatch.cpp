// HATCH: the outlines of its areas. A boundary path is a polyline with bulges, or edges: lines, arcs, ellipses, splines
// (DXF reference, "Boundary path data").
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "core/contour/dxf/read/entity.hpp"

namespace bahnwerk {
namespace {

using Tags = std::span<const DxfTag>;

constexpr double turn = 2 * std::numbers::pi, degree = std::numbers::pi / 180;

struct Edge {
  std::vector<Drawn> curves;
  std::optional<Drawn> other;  ///< second reading of an ellipse, whose angles some programs write as parameters
};

struct Angles {
  double start = 0, end = 360;
  bool counter_clockwise = true;
  /// Returns the angle in the direction of travel, (0, 360].
  double swept() const {
    const double angle = std::fmod(end - start, 360.0);
    return angle > 1e-9 ? angle : angle + 360;
  }
};

/// Clockwise arcs have their angles counted clockwise.
DrawnArc arc_between(Vec centre, Vec a, Vec b, double start, double sweep, bool counter_clockwise) {
  const double sign = counter_clockwise ? 1 : -1;
  return {centre, a, b, std::remainder(sign * start, turn), sign * std::min(sweep, turn)};
}

Edge arc_edge(Tags tags) {
  Vec centre;
  double radius = 0;
  Angles angles;
  for (const DxfTag& tag : tags) {
    if (tag.code == 73) angles.counter_clockwise = dxf_integer(tag) != 0;
    take_point(tag, 10, centre) || take_number(tag, 40, radius) || take_number(tag, 50, angles.start) ||
        take_number(tag, 51, angles.end);
  }
  if (radius < 0) refuse_dxf(tags.front().line, "HATCH: the radius of an edge has to be positive");
  if (radius == 0) return {};
  double c = 1, s = 0;
  dxf_direction(angles.counter_clockwise ? angles.start : -angles.start, c, s);
  const Vec a{radius * c, radius * s, 0}, b{-radius * s, radius * c, 0};
  return {{arc_between(centre, a, b, 0, angles.swept() * degree, angles.counter_clockwise)}, {}};
}

/// Returns the parameter of the point seen at an angle, both in rad; whole turns are preserved.
double parameter(double angle, double ratio) {
  const double whole = std::round(angle / turn) * turn, rest = angle - whole;
  return whole + std::atan2(std::sin(rest) / ratio, std::cos(rest));
}

Edge ellipse_edge(Tags tags) {
  Vec centre, major;
  double ratio = 1;
  Angles angles;
  for (const DxfTag& tag : tags) {
    if (tag.code == 73) angles.counter_clockwise = dxf_integer(tag) != 0;
    take_point(tag, 10, centre) || take_point(tag, 11, major) || take_number(tag, 40, ratio) ||
        take_number(tag, 50, angles.start) || take_number(tag, 51, angles.end);
  }
  if (!(norm(major) > 0)) return {};
  if (!(ratio >= 1e-6 && ratio <= 1e6))
    refuse_dxf(tags.front().line, "HATCH: the ratio of an ellipse's axes has to be between 1e-6 and 1");
  const Vec minor = ratio * Vec{-major.y, major.x, 0};
  const auto between = [&](double start, double end) {
    double sweep = std::fmod(end - start, turn);
    if (sweep < 1e-9) sweep += turn;
    return arc_between(centre, major, minor, start, sweep, angles.counter_clockwise);
  };
  const double start = angles.start * degree, end = angles.end * degree;
  Edge edge{{between(parameter(start, ratio), parameter(end, ratio))}, {}};
  if (angles.swept() < 360) edge.other = between(start, end);
  return edge;
}

/// Reads a spline edge, with the group codes of a SPLINE.
Edge spline_edge(Tags tags, DxfTags& file) {
  DxfRecord record{"SPLINE", tags.front().line, {}};
  for (DxfTag tag : tags) {
    if (tag.code == 73 || tag.code == 95 || tag.code == 96 || tag.code == 97 || tag.code == 330) continue;
    tag.code = tag.code == 94 ? 71 : tag.code == 74 ? 70 : tag.code == 42 ? 41 : tag.code;
    record.tags.push_back(tag);
  }
  return {dxf_spline(record, file).curves, {}};
}

Edge line_edge(Tags tags) {
  DrawnLine line;
  for (const DxfTag& tag : tags) take_point(tag, 10, line.from) || take_point(tag, 11, line.to);
  if (line.from == line.to) return {};
  return {{line}, {}};
}

Edge edge_of(Tags tags, DxfTags& file) {
  switch (const long kind = dxf_integer(tags.front())) {
    case 1:
      return line_edge(tags);
    case 2:
      return arc_edge(tags);
    case 3:
      return ellipse_edge(tags);
    case 4:
      return spline_edge(tags, file);
    default:
      refuse_dxf(tags.front().line, "HATCH: there is no edge of type " + std::to_string(kind));
  }
}

/// Chooses of the two readings of an ellipse's angles the one whose ends are nearer to the neighbouring edges.
void settle_ellipses(std::vector<Edge>& edges) {
  const std::size_t n = edges.size();
  for (std::size_t i = 0; i < n; ++i) {
    Edge& edge = edges[i];
    if (!edge.other || n < 2) continue;
    const Edge &before = edges[(i + n - 1) % n], &behind = edges[(i + 1) % n];
    const auto gap = [&](const Drawn& curve) {
      return norm(first_point(curve) - last_point(before.curves.back())) +
             norm(last_point(curve) - first_point(behind.curves.front()));
    };
    if (gap(*edge.other) < gap(edge.curves.front())) edge.curves.front() = *edge.other;
  }
}

/// Edges end to end are one shape; where the next one begins elsewhere another shape does.
std::vector<DxfShape> chained(const std::vector<Edge>& edges, const Affine& map) {
  constexpr double same = 1e-6;  // part of the size of curves by which ends that meet may differ
  std::vector<DxfShape> shapes;
  for (const Edge& edge : edges)
    for (const Drawn& curve : edge.curves) {
      const bool joins = !shapes.empty() && norm(first_point(curve) - last_point(shapes.back().curves.back())) <=
                                                same * (extent(curve) + extent(shapes.back().curves.back()));
      if (!joins) shapes.emplace_back();
      shapes.back().curves.push_back(curve);
    }
  for (DxfShape& shape : shapes)
    for (Drawn& curve : shape.curves) curve = mapped(map, std::move(curve));
  return shapes;
}

std::vector<DxfShape> edge_path(Tags tags, const Affine& map, double elevation, DxfTags& file) {
  std::vector<Edge> edges;
  std::size_t without_length = 0;
  const auto begins = [](const DxfTag& tag) { return tag.code == 72; };
  for (auto at = std::find_if(tags.begin(), tags.end(), begins); at != tags.end();) {
    const auto next = std::find_if(at + 1, tags.end(), begins);
    Edge edge = edge_of({at, next}, file);
    if (edge.curves.empty())
      ++without_length;
    else
      edges.push_back(std::move(edge));
    at = next;
  }
  settle_ellipses(edges);
  const Affine up{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, elevation}};
  std::vector<DxfShape> shapes = chained(edges, map * up);
  if (without_length > 0) {
    if (shapes.empty()) shapes.emplace_back();
    shapes.front().without_length = without_length;
  }
  return shapes;
}

DxfShape polyline_path(Tags tags, const Affine& map, double elevation, DxfTags& file) {
  std::vector<DxfVertex> vertices;
  DxfVertex none;
  for (const DxfTag& tag : tags) {
    if (tag.code == 10) vertices.emplace_back();
    DxfVertex& vertex = vertices.empty() ? none : vertices.back();
    take_number(tag, 10, vertex.at.x) || take_number(tag, 20, vertex.at.y) || take_number(tag, 42, vertex.bulge);
  }
  for (DxfVertex& vertex : vertices) vertex.at.z = elevation;
  return dxf_joined(vertices, true, map, file);  // closed, because it bounds an area
}

}  // namespace

std::vector<DxfShape> dxf_hatch(const DxfRecord& record, DxfTags& file) {
  Vec normal{0, 0, 1};
  double elevation = 0;
  const auto path = [](const DxfTag& tag) { return tag.code == 92; };
  const Tags tags(record.tags);
  const auto first = std::find_if(tags.begin(), tags.end(), path);
  for (const DxfTag& tag : Tags(tags.begin(), first)) take_number(tag, 30, elevation) || take_point(tag, 210, normal);
  // Style, pattern and seed points follow the paths.
  const auto last = std::find_if(first, tags.end(), [](const DxfTag& tag) { return tag.code == 75 || tag.code == 98; });
  const Affine map = dxf_object_system(normal, record.line);
  std::vector<DxfShape> shapes;
  for (auto at = first; at != last;) {
    file.progress().work();
    const auto next = std::find_if(at + 1, last, path);
    constexpr long polyline = 2;
    if ((dxf_integer(*at) & polyline) != 0) {
      shapes.push_back(polyline_path({at, next}, map, elevation, file));
    } else {
      std::vector<DxfShape> more = edge_path({at, next}, map, elevation, file);
      shapes.insert(shapes.end(), more.begin(), more.end());
    }
    at = next;
  }
  if (shapes.empty()) shapes.push_back({{}, 0, "skipped: a HATCH without an outline"});
  return shapes;
}

}  // namespace bahnwerk
