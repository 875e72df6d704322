#pragma once
/// Reads drawings as contours: DXF, ASCII or binary, releases R12 to 2018. Faults of a binary file name the line of its
/// ASCII form.
///
/// It reads LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE and POLYLINE (bulges; 3-D ones, too), SPLINE (control points with
/// weights, or fit points alone: then the cubic spline through them) and INSERT (nested, arrays, any scale, mirrored);
/// with an option the outlines of HATCH. Nothing is approximated: an ellipse becomes a rational curve of degree 2, an
/// arc in a block scaled unequally an ellipse. Extrusion directions follow the arbitrary axis algorithm. Other entities
/// in model space are skipped with a note per type, and so are entities on layers that are frozen, switched off or
/// (unless requested by name) not plotted, and invisible ones. Paper space is read, with a note, only where model space
/// has no curve at all: the sheet among the entities, else the first sheet with a curve.
///
/// Entities whose ends meet become one block (core/contour/dxf/cut/chain.hpp). A gap is closed by moving an end where
/// the curve beside it is 100 times as long (a line turns, an arc is moved and scaled with constant sweep, control
/// points of a spline are shifted in proportion), otherwise by a short line. Entities drawn twice, in either direction,
/// are dropped with a note (whole entities only). Straight moves with Mode::position connect the blocks. The contour
/// starts at the beginning of its first block.
///
/// The contour is planar if every entity is flat; different heights are then moved into one plane with a note. If one
/// entity has points more than 1e-6 mm apart in height, the contour is spatial.
///
/// Cost: O(n log n). CPU time for files of 10 MB (one thread, virtual machine at 2.3 GHz): 73 000 loose LINEs 0.11 s,
/// LWPOLYLINEs with 380 000 vertices 0.24 s, 90 000 CIRCLEs 0.14 s; the order of nearest neighbours takes up to 0.2 s
/// more. SPLINEs cost what their arc length does: some 9 µs per span, 2 s for 200 000 spans.
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"

namespace bahnwerk {

/// The order of the blocks: as in the file, or by nearest neighbours.
enum class DxfOrder { as_drawn, nearest };

/// The options of a document with a drawing.
struct DxfOptions {
  double tolerance = 0.01;  ///< largest distance of ends that are joined, mm; 0 … 10
  DxfOrder order =
      DxfOrder::as_drawn;             ///< order of the blocks: that of their first entities in the file, or nearest
                                      ///< neighbours (which may reverse open blocks and turn the start of closed ones)
  std::vector<std::string> layers{};  ///< the only layers to read, each of which has to exist; empty: all
  double feed = std::numeric_limits<double>::infinity();  ///< mm/s, > 0; infinite: limited by the axes alone
  std::optional<double> millimetres_per_unit{};           ///< > 0; unset: as $INSUNITS says, or 1 with a note
  std::size_t max_curves =
      2'000'000;       ///< largest number of curves, with blocks resolved; a drawing with more is refused
  bool hatch = false;  ///< whether the outlines of HATCH are cut, too
};

/// Returns the contour. Throws InvalidInput with up to 100 faults at {"contour","dxf"}, each with a message "line 123:
/// …"; for an option without a meaning at {"contour","tolerance"}, {"contour","feed"}, {"contour","unit"} or
/// {"contour","layers",index}, whose message lists the layers that exist.
Contour read_dxf(std::string_view text, const DxfOptions& options = {});
/// Reports the stage "reading" to `progress` at least every 100 ms and passes its exceptions on.
Contour read_dxf(std::string_view text, const DxfOptions& options, Progress progress);

}  // namespace bahnwerk
