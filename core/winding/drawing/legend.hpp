#pragma once
/// The legend of a drawing: the meaning of its colours, numbers and lines.
#include <string>

#include "core/winding/drawing/drawing.hpp"

namespace bahnwerk::winding {

namespace look {
inline constexpr const char* liner = "#e6e9ed";
inline constexpr const char* wedge = "#cdbf9a";
inline constexpr const char* taken = "#c9d3e6";
inline constexpr const char* outline = "#4a525c";
inline constexpr const char* opening = "#1f5fbf";
inline constexpr const char* slips = "#c1121f";
inline constexpr const char* unreached = "#d97706";
inline constexpr const char* enamel = "#7a4a21";
inline constexpr const char* nowhere = "#d5d9de";
inline constexpr const char* layers[] = {"#e9c46a", "#8ab17d", "#7fb3d5", "#e8a07c", "#b39ddb", "#9fd3c7"};
inline constexpr std::size_t layer_count = std::size(layers);
}  // namespace look

struct Legend {
  std::string svg;
  double height = 0;  ///< px
};
inline constexpr double legend_width = 310;  // px

/// Returns entries for the contents of the drawing, from `at` (px) downwards, and a scale of `pixels` px per mm.
Legend legend(const Slot& slot, const DrawnWires& drawn, bool layerless, Point at, double pixels);

}  // namespace bahnwerk::winding
