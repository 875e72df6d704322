#pragma once
/// Cuts: consecutive curves of a drawing, made from loose entities and written as the blocks of a contour.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/dxf/read/drawing.hpp"
#include "core/contour/dxf/read/drawn.hpp"

namespace bahnwerk {

/// Consecutive curves that become one block.
struct Cut {
  std::vector<Drawn> curves;       ///< consecutive curves; ends may miss each other by the chaining tolerance
  std::vector<std::size_t> lines;  ///< line of the file in which each curve begins
  bool closed = false;
};

/// Removes entities that are drawn again, in either direction, and returns their number. Two are equal if corresponding
/// points are within `tolerance` (mm). O(n).
std::size_t drop_duplicates(std::vector<DxfStrand>& strands, double tolerance, Progress progress);

/// Chains strands within the tolerance, mm. O(n log n).
std::vector<Cut> cuts(std::vector<DxfStrand> strands, double tolerance, Progress progress);

/// Orders cuts by nearest neighbours. O(n log n).
std::vector<Cut> nearest(std::vector<Cut> cuts, Progress progress);

/// Number and size of the closed gaps.
struct GapReport {
  std::size_t moved = 0, bridged = 0;
  double worst = 0;  ///< mm
};

/// Appends a cut to the block begun in `builder`, whose position is the cut's start.
void write_cut(ContourBuilder& builder, const Cut& cut, GapReport& gaps, ProgressScope& progress);

}  // namespace bahnwerk
