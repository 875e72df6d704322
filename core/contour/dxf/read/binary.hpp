#pragma once
/// Binary DXF files: the groups of the ASCII form with their values as bytes (DXF reference, "Binary DXF files").
/// Releases up to R12 have group codes of one byte, later ones of two.
#include <string>
#include <string_view>

#include "core/base/progress.hpp"

namespace bahnwerk {

bool dxf_is_binary(std::string_view bytes);

/// Returns the drawing in ASCII, up to its EOF, with the shortest exact numbers and empty data chunks. Throws
/// InvalidInput at {"contour","dxf"}, with the next line of the ASCII form, for a file that is cut off or does not
/// begin with a section. O(bytes).
std::string dxf_ascii(std::string_view bytes, Progress progress);

}  // namespace bahnwerk
