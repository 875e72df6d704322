#pragma once
/// Binary DXF files: the same groups as in ASCII, their values as bytes (DXF reference, "Binary DXF files"). Releases
/// up to R12 have group codes of one byte, later ones of two.
#include <string>
#include <string_view>

namespace bahnwerk {

class Progress;

bool dxf_is_binary(std::string_view bytes);

/// The drawing in ASCII, up to its EOF: numbers as short as they are exact, data chunks empty. Throws InvalidInput at
/// {"contour","dxf"}, with the line of the ASCII form that would follow, for what is cut off or begins with no section.
/// O(bytes).
std::string dxf_ascii(std::string_view bytes, Progress& progress);

}  // namespace bahnwerk
