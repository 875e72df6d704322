#pragma once
/// Single entities of a DXF file: from records to curves, in the drawing's unit and in world coordinates of their space
/// or block. Faults are thrown as InvalidInput that names the line. O(tags), fit splines included.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/contour/dxf/read/drawn.hpp"
#include "core/contour/dxf/read/tags.hpp"

namespace bahnwerk {

/// Properties of every entity.
struct DxfCommon {
  std::string_view layer = "0";
  bool paper = false, invisible = false;
};
DxfCommon dxf_common(const DxfRecord& record);

/// A reference to a block's entities, once or as an array: map(row, column) maps the block's coordinates to those in
/// which the INSERT is drawn.
struct DxfInsert {
  std::string_view block;
  Vec at, scale{1, 1, 1};
  double cosine = 1, sine = 0;  ///< cosine and sine of the rotation
  std::size_t columns = 1, rows = 1;
  double column_spacing = 0, row_spacing = 0;
  Vec normal{0, 0, 1};
  Affine map(Vec block_base, std::size_t row, std::size_t column) const;
};

/// The curves of an entity.
struct DxfShape {
  std::vector<Drawn> curves;       ///< consecutive curves
  std::size_t without_length = 0;  ///< dropped parts without length
  std::string note;                ///< a remark of the reader; may be empty
};

/// Returns whether the type is LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE or SPLINE.
bool dxf_has_curves(std::string_view type);
/// Reads an entity. `tags` is positioned behind `record`; the vertices of a POLYLINE are read from it.
DxfShape dxf_shape(const DxfRecord& record, DxfTags& tags);
DxfInsert dxf_insert(const DxfRecord& record);

/// Read the parts of dxf_shape(), each in its own file.
DxfShape dxf_polyline(const DxfRecord& record, DxfTags& tags);
DxfShape dxf_lightweight_polyline(const DxfRecord& record, DxfTags& tags);
DxfShape dxf_spline(const DxfRecord& record, DxfTags& tags);

/// A vertex of a polyline and its bulge, tan(sweep/4) of the arc that begins there.
struct DxfVertex {
  Vec at;
  double bulge = 0;
};
DxfShape dxf_joined(const std::vector<DxfVertex>& vertices, bool closed, const Affine& map, DxfTags& tags);

/// Returns the outlines of a HATCH, each path as one shape or, where its edges do not meet, as several.
std::vector<DxfShape> dxf_hatch(const DxfRecord& record, DxfTags& tags);

/// Computes cosine and sine of an angle in degrees, exact at multiples of 90°, which are frequent in drawings.
void dxf_direction(double degrees, double& c, double& s);

/// Returns the object coordinate system of an extrusion direction: arbitrary axis algorithm of the DXF reference,
/// "Object Coordinate Systems". A normal without length is a fault at `line`.
Affine dxf_object_system(Vec normal, std::size_t line);

/// Takes the tag's number if it has this code and returns true. For a point the codes of y and z are 10 and 20 higher.
bool take_number(const DxfTag& tag, int code, double& number);
bool take_point(const DxfTag& tag, int code, Vec& point);

}  // namespace bahnwerk
