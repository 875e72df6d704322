#include "core/contour/dxf/read/entity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bahnwerk {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double degree = std::numbers::pi / 180;

bool gives(const DxfRecord& record, int code) {
  return std::any_of(record.tags.begin(), record.tags.end(), [&](const DxfTag& tag) { return tag.code == code; });
}

DxfShape line(const DxfRecord& record) {
  DrawnLine line;
  for (const DxfTag& tag : record.tags) take_point(tag, 10, line.from) || take_point(tag, 11, line.to);
  return {{line}, 0, {}};
}

/// Reads ARC and CIRCLE.
DxfShape circle(const DxfRecord& record, bool full) {
  Vec centre, normal{0, 0, 1};
  double radius = 0, start = 0, end = 360;
  for (const DxfTag& tag : record.tags)
    take_point(tag, 10, centre) || take_number(tag, 40, radius) || take_number(tag, 50, start) ||
        take_number(tag, 51, end) || take_point(tag, 210, normal);
  if (radius == 0 && gives(record, 40)) return {{}, 1, {}};  // a leftover of editing
  if (!(radius > 0)) refuse_dxf(record.line, "the radius has to be positive");
  DrawnArc arc;
  // The start lies on the first half-axis, so that ends at whole quarters are exact.
  double c = 1, s = 0, sweep = turn;
  if (!full) {
    dxf_direction(start, c, s);
    const double angle = std::fmod(std::fmod(end, 360.0) - std::fmod(start, 360.0), 360.0);
    sweep = (angle > 0 ? angle : angle + 360) * degree;
  }
  arc = {centre, {radius * c, radius * s, 0}, {-radius * s, radius * c, 0}, 0, sweep};
  return {{mapped(dxf_object_system(normal, record.line), arc)}, 0, {}};
}

DxfShape ellipse(const DxfRecord& record) {
  Vec centre, major, normal{0, 0, 1};
  double ratio = 1, start = 0, end = turn;
  for (const DxfTag& tag : record.tags)
    take_point(tag, 10, centre) || take_point(tag, 11, major) || take_number(tag, 40, ratio) ||
        take_number(tag, 41, start) || take_number(tag, 42, end) || take_point(tag, 210, normal);
  if (!gives(record, 11)) refuse_dxf(record.line, "the ellipse's major axis has no length");
  if (!(norm(major) > 0)) return {{}, 1, {}};
  if (!(std::abs(ratio) >= 1e-6 && std::abs(ratio) <= 1e6))
    refuse_dxf(record.line, "the ratio of the ellipse's axes has to be between 1e-6 and 1");
  if (!(std::abs(start) <= 1e6 && std::abs(end) <= 1e6))
    refuse_dxf(record.line, "the ellipse's parameters have to be angles in radians");
  const Vec n = dxf_object_system(normal, record.line).z;
  const Vec minor = cross(n, major);
  if (!(norm(minor) >= 0.5 * norm(major))) refuse_dxf(record.line, "the ellipse's major axis is not in its plane");
  double sweep = std::fmod(end - start, turn);
  if (sweep < 1e-9) sweep += turn;  // 0 → 2π may be written with rounding on either side
  return {{DrawnArc{centre, major, ratio * minor, std::remainder(start, turn), std::min(sweep, turn)}}, 0, {}};
}

}  // namespace

void dxf_direction(double degrees, double& c, double& s) {
  const double rest = std::remainder(degrees, 360.0);
  if (rest == 0 || std::abs(rest) == 180 || std::abs(rest) == 90) {
    c = std::abs(rest) == 90 ? 0 : rest == 0 ? 1 : -1;
    s = rest == 90 ? 1 : rest == -90 ? -1 : 0;
    return;
  }
  c = std::cos(rest * degree);
  s = std::sin(rest * degree);
}

bool take_number(const DxfTag& tag, int code, double& number) {
  if (tag.code != code) return false;
  number = dxf_real(tag);
  return true;
}

bool take_point(const DxfTag& tag, int code, Vec& point) {
  return take_number(tag, code, point.x) || take_number(tag, code + 10, point.y) ||
         take_number(tag, code + 20, point.z);
}

Affine dxf_object_system(Vec normal, std::size_t line) {
  const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  if (!(largest > 0)) refuse_dxf(line, "the extrusion direction has no length");
  normal = normal / largest;  // avoids overflow of the square
  const Vec n = normal / norm(normal);
  Vec x = std::abs(n.x) < 1.0 / 64 && std::abs(n.y) < 1.0 / 64 ? cross({0, 1, 0}, n) : cross({0, 0, 1}, n);
  x = x / norm(x);
  return {x, cross(n, x), n, {}};
}

DxfCommon dxf_common(const DxfRecord& record) {
  DxfCommon common;
  for (const DxfTag& tag : record.tags) {
    if (tag.code == 8) common.layer = tag.value;
    if (tag.code == 67) common.paper = dxf_integer(tag) == 1;
    if (tag.code == 60) common.invisible = dxf_integer(tag) == 1;
    if (tag.code == 101) break;  // an embedded object has codes of its own
  }
  return common;
}

Affine DxfInsert::map(Vec block_base, std::size_t row, std::size_t column) const {
  const Vec x{cosine, sine, 0}, y{-sine, cosine, 0};
  const Vec cell = static_cast<double>(column) * column_spacing * x + static_cast<double>(row) * row_spacing * y;
  const Affine placed{scale.x * x, scale.y * y, {0, 0, scale.z}, at + cell};
  return dxf_object_system(normal, 0) * placed * Affine{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, -block_base};
}

DxfInsert dxf_insert(const DxfRecord& record) {
  DxfInsert insert;
  const auto count = [](const DxfTag& tag, int code, std::size_t& number) {
    if (tag.code != code) return false;
    const long n = dxf_integer(tag);
    if (n < 0 || n > 32767) refuse_dxf(tag.line, "the number of rows and columns has to be between 1 and 32767");
    number = n == 0 ? std::size_t{1} : static_cast<std::size_t>(n);
    return true;
  };
  double rotation = 0;
  for (const DxfTag& tag : record.tags) {
    if (tag.code == 2) insert.block = tag.value;
    take_point(tag, 10, insert.at) || take_number(tag, 41, insert.scale.x) || take_number(tag, 42, insert.scale.y) ||
        take_number(tag, 43, insert.scale.z) || take_number(tag, 44, insert.column_spacing) ||
        take_number(tag, 45, insert.row_spacing) || take_number(tag, 50, rotation) || count(tag, 70, insert.columns) ||
        count(tag, 71, insert.rows) || take_point(tag, 210, insert.normal);
  }
  dxf_direction(rotation, insert.cosine, insert.sine);
  if (insert.scale.x == 0 || insert.scale.y == 0) refuse_dxf(record.line, "a scale factor of the INSERT is zero");
  insert.normal = dxf_object_system(insert.normal, record.line).z;
  return insert;
}

bool dxf_has_curves(std::string_view type) {
  return type == "LINE" || type == "ARC" || type == "CIRCLE" || type == "ELLIPSE" || type == "LWPOLYLINE" ||
         type == "POLYLINE" || type == "SPLINE";
}

DxfShape dxf_shape(const DxfRecord& record, DxfTags& tags) {
  if (record.type == "LINE") return line(record);
  if (record.type == "ARC") return circle(record, false);
  if (record.type == "CIRCLE") return circle(record, true);
  if (record.type == "ELLIPSE") return ellipse(record);
  if (record.type == "LWPOLYLINE") return dxf_lightweight_polyline(record, tags);
  if (record.type == "POLYLINE") return dxf_polyline(record, tags);
  if (record.type == "SPLINE") return dxf_spline(record, tags);
  return {};
}

}  // namespace bahnwerk
