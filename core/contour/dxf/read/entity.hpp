#pragma once
/// Single entities of a DXF file: from records to curves, in the drawing's unit and in world coordinates of the
/// space or block that they stand in. Faults are thrown as InvalidInput that names the line. O(tags), fit splines too.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/contour/dxf/drawn.hpp"
#include "core/contour/dxf/read/tags.hpp"

namespace bahnwerk {

/// What every entity has.
struct DxfCommon {
  std::string_view layer = "0";
  bool paper = false, invisible = false;
};
DxfCommon dxf_common(const DxfRecord& record);

/// A block that stands in for its entities, once or as an array: map(row, column) takes the block's coordinates to
/// those that the INSERT is drawn in.
struct DxfInsert {
  std::string_view block;
  Vec at, scale{1, 1, 1};
  double cosine = 1, sine = 0;  ///< of the rotation
  std::size_t columns = 1, rows = 1;
  double column_spacing = 0, row_spacing = 0;
  Vec normal{0, 0, 1};
  Affine map(Vec block_base, std::size_t row, std::size_t column) const;
};

struct DxfShape {
  std::vector<Drawn> curves;       ///< end to end
  std::size_t without_length = 0;  ///< parts dropped because they have none
  std::string note;                ///< what the reader thought about it, empty = nothing
};

/// One of LINE ARC CIRCLE ELLIPSE LWPOLYLINE POLYLINE SPLINE.
bool dxf_has_curves(std::string_view type);
/// `tags` stands behind `record`; of a POLYLINE its vertices are read from there.
DxfShape dxf_shape(const DxfRecord& record, DxfTags& tags);
DxfInsert dxf_insert(const DxfRecord& record);

/// The parts of dxf_shape, each in a file of its own.
DxfShape dxf_polyline(const DxfRecord& record, DxfTags& tags);
DxfShape dxf_lightweight_polyline(const DxfRecord& record, DxfTags& tags);
DxfShape dxf_spline(const DxfRecord& record, DxfTags& tags);

/// A vertex of a polyline and its bulge, tan(sweep/4) of the arc that begins there.
struct DxfVertex {
  Vec at;
  double bulge = 0;
};
DxfShape dxf_joined(const std::vector<DxfVertex>& vertices, bool closed, const Affine& map, DxfTags& tags);

/// The outlines of a HATCH, each path as one shape or, where its edges do not meet, several.
std::vector<DxfShape> dxf_hatch(const DxfRecord& record, DxfTags& tags);

/// cos and sin of an angle in degrees, exact at whole quarters: drawings are full of them.
void dxf_direction(double degrees, double& c, double& s);

/// The object coordinate system of an extrusion direction: arbitrary axis algorithm of the DXF reference, "Object
/// Coordinate Systems". A normal without length is a fault at `line`.
Affine dxf_object_system(Vec normal, std::size_t line);

/// If the tag has this code its number is taken; for a point the codes of y and z are 10 and 20 higher.
bool take_number(const DxfTag& tag, int code, double& number);
bool take_point(const DxfTag& tag, int code, Vec& point);

}  // namespace bahnwerk
