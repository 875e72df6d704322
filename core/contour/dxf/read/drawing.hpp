#pragma once
/// A whole DXF file: sections, unit, layers, blocks; everything drawn in model space, blocks resolved, in mm. Paper
/// space is read instead, with a note, if model space holds no curve at all, hidden ones included.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contour/dxf/drawn.hpp"

namespace bahnwerk {

class Progress;

struct DxfReading {
  std::vector<std::string> layers;             ///< only these (upper and lower case are the same); empty = all
  std::optional<double> millimetres_per_unit;  ///< instead of what the file says
  std::size_t max_curves = 2'000'000;          ///< after blocks are resolved; more are refused
  bool hatch = false;                          ///< whether the outlines of HATCH are drawn
};

/// One entity: curves end to end.
struct DxfStrand {
  std::vector<Drawn> curves;
  std::size_t line = 0;  ///< of the entity in the file
};

struct DxfDrawing {
  std::vector<DxfStrand> strands;  ///< in the order of the file, none without length
  std::vector<std::string> notes;
};

/// Throws InvalidInput with all faults found, 100 at most; Stopped.
DxfDrawing read_dxf_drawing(std::string_view text, const DxfReading& reading, Progress& progress);

}  // namespace bahnwerk
