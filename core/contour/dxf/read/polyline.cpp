// LWPOLYLINE and POLYLINE with VERTEX: straight parts and arcs given by their bulge, tan(sweep/4), positive =
// counter-clockwise (DXF reference, group code 42).
#include <cmath>

#include "core/contour/dxf/read/entity.hpp"

namespace bahnwerk {
namespace {

/// An arc of a smaller bulge is straight to 5e-4 mm even over a chord of 1e9 mm.
constexpr double straight = 1e-12;

constexpr const char* wide = "a polyline with a width: its centre line was taken";

/// Widths at both ends (40, 41), and of an LWPOLYLINE that of all its parts (43).
bool has_width(const DxfTag& tag, bool lightweight) {
  if (tag.code != 40 && tag.code != 41 && !(lightweight && tag.code == 43)) return false;
  double width = 0;
  return take_number(tag, tag.code, width) && width != 0;
}

DrawnArc bulged(Vec from, Vec to, double bulge) {
  // Centre on the bisector of the chord, (1 − b²)/(4b) chords to its left.
  const Vec chord = to - from, left{-chord.y, chord.x, 0};
  const Vec centre = from + 0.5 * chord + (1 - bulge * bulge) / (4 * bulge) * left;
  const Vec a = from - centre;
  return {centre, a, {-a.y, a.x, 0}, 0, 4 * std::atan(bulge)};
}

}  // namespace

DxfShape dxf_joined(const std::vector<DxfVertex>& vertices, bool closed, const Affine& map, DxfTags& tags) {
  DxfShape shape;
  if (vertices.size() < 2) return {{}, 1, {}};
  shape.curves.reserve(vertices.size());
  Vec from = vertices.front().at;
  const auto go = [&](const DxfVertex& start, Vec to, bool last) {
    tags.progress().work();
    if (from == to) {  // a closed polyline may repeat its first vertex
      shape.without_length += last ? 0 : 1;
    } else if (std::abs(start.bulge) < straight) {
      shape.curves.push_back(mapped(map, DrawnLine{from, to}));
    } else {
      shape.curves.push_back(mapped(map, bulged(from, to, start.bulge)));
    }
    from = to;
  };
  for (std::size_t i = 1; i < vertices.size(); ++i) go(vertices[i - 1], vertices[i].at, false);
  if (closed) go(vertices.back(), vertices.front().at, true);
  return shape;
}

DxfShape dxf_lightweight_polyline(const DxfRecord& record, DxfTags& tags) {
  std::vector<DxfVertex> vertices;
  Vec normal{0, 0, 1};
  double elevation = 0;
  bool closed = false, width = false;
  DxfVertex none;
  for (const DxfTag& tag : record.tags) {
    tags.progress().work();
    width = has_width(tag, true) || width;
    if (tag.code == 10) vertices.emplace_back();
    if (tag.code == 70) closed = (dxf_integer(tag) & 1) != 0;
    DxfVertex& vertex = vertices.empty() ? none : vertices.back();
    if (take_number(tag, 20, vertex.at.y) && vertices.empty())
      refuse_dxf(tag.line, "a vertex has to begin with its x coordinate (group code 10)");
    take_number(tag, 10, vertex.at.x) || take_number(tag, 42, vertex.bulge) || take_number(tag, 38, elevation) ||
        take_point(tag, 210, normal);
  }
  for (DxfVertex& v : vertices) v.at.z = elevation;
  DxfShape shape = dxf_joined(vertices, closed, dxf_object_system(normal, record.line), tags);
  if (width && !shape.curves.empty()) shape.note = wide;
  return shape;
}

DxfShape dxf_polyline(const DxfRecord& record, DxfTags& tags) {
  Vec normal{0, 0, 1};
  double elevation = 0;
  long flags = 0;
  bool width = false;
  for (const DxfTag& tag : record.tags) {
    width = has_width(tag, false) || width;
    if (tag.code == 70) flags = dxf_integer(tag);
    take_number(tag, 30, elevation) || take_point(tag, 210, normal);
  }
  const bool in_space = (flags & 8) != 0;
  std::vector<DxfVertex> vertices;
  std::vector<InputFault> faults;  // collected, because all vertices have to be read
  DxfRecord part;
  for (;;) {
    const auto mark = tags.mark();
    if (!tags.next(part) || part.type == "SEQEND") break;
    if (part.type != "VERTEX") {
      tags.seek(mark);
      break;
    }
    try {
      DxfVertex v;
      long kind = 0;
      for (const DxfTag& tag : part.tags) {
        width = has_width(tag, false) || width;
        if (tag.code == 70) kind = dxf_integer(tag);
        take_point(tag, 10, v.at) || take_number(tag, 42, v.bulge);
      }
      if (!in_space) v.at.z = elevation;
      if (in_space) v.bulge = 0;
      if ((kind & 16) == 0) vertices.push_back(v);  // 16: control point of a polyline that a spline was fitted to
    } catch (const InvalidInput& e) {
      if (faults.size() < 100) faults.insert(faults.end(), e.faults.begin(), e.faults.end());
    }
  }
  if ((flags & (16 | 64)) != 0) return {{}, 0, "skipped: a POLYLINE that is a mesh"};
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  DxfShape shape =
      dxf_joined(vertices, (flags & 1) != 0, in_space ? Affine{} : dxf_object_system(normal, record.line), tags);
  if (width && !in_space && !shape.curves.empty()) shape.note = wide;
  return shape;
}

}  // namespace bahnwerk
