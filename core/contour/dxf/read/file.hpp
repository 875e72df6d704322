#pragma once
/// Places of the parts of a DXF file, found in one pass over the text without reading entities.
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/contour/dxf/read/tags.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// State of a layer.
struct DxfLayer {
  bool frozen = false, off = false, unplotted = false;
  std::string_view name = {};  ///< name as written in the file
};
/// Place of a block's definition in the file.
struct DxfBlockPlace {
  DxfTags::Mark first;  ///< the first entity of the block
  Vec base;
  bool external = false;  ///< whether it is a reference to another file
  std::size_t line = 0;
};

/// The structure of a file.
struct DxfFile {
  long unit = 0;  ///< $INSUNITS; 0: none
  std::size_t unit_line = 0;
  std::unordered_map<std::string, DxfLayer> layers;       ///< keys are names in lower case
  std::unordered_map<std::string, DxfBlockPlace> blocks;  ///< keys are names in lower case
  std::optional<DxfTags::Mark> entities;                  ///< the first entity of the drawing
  std::vector<std::string> notes;
};

/// Converts ASCII letters to lower case: names in DXF are case-insensitive.
std::string dxf_lower(std::string_view name);

/// Reads the file's structure. Throws InvalidInput for a text that is no DXF file or is cut off. O(bytes).
DxfFile dxf_file(DxfTags& tags);

/// Returns mm per drawing unit for a value of $INSUNITS; nothing for unknown units and those beyond any machine.
std::optional<double> dxf_unit(long code);

}  // namespace bahnwerk
