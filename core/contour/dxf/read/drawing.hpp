#pragma once
/// A whole DXF file: sections, unit, layers, blocks; all entities of model space, with blocks resolved, in mm. Paper
/// space is read instead, with a note, if model space has no curve at all, hidden ones included.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/dxf/read/drawn.hpp"

namespace bahnwerk {

/// The options of reading.
struct DxfReading {
  std::vector<std::string> layers;             ///< the only layers to read, case-insensitive; empty: all
  std::optional<double> millimetres_per_unit;  ///< replaces the file's unit
  std::size_t max_curves =
      2'000'000;       ///< largest number of curves, with blocks resolved; a drawing with more is refused
  bool hatch = false;  ///< whether the outlines of HATCH are drawn
};

/// An entity of the drawing as consecutive curves.
struct DxfStrand {
  std::vector<Drawn> curves;
  std::size_t line = 0;  ///< line of the file in which the entity begins
};

/// The result of reading.
struct DxfDrawing {
  std::vector<DxfStrand> strands;  ///< strands in the order of the file; each has a length
  std::vector<std::string> notes;
};

/// Returns the drawing. Throws InvalidInput with all faults found, at most 100, and Stopped.
DxfDrawing read_dxf_drawing(std::string_view text, const DxfReading& reading, Progress progress);

}  // namespace bahnwerk
