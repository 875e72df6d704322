#pragma once
/// Cuts: curves of a drawing that follow each other, from loose entities to the blocks of a contour.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/contour/builder.hpp"
#include "core/contour/dxf/drawn.hpp"
#include "core/contour/dxf/read/drawing.hpp"

namespace bahnwerk {

class Progress;

struct Cut {
  std::vector<Drawn> curves;       ///< ends may miss each other by the chaining tolerance
  std::vector<std::size_t> lines;  ///< of the file, one per curve
  bool closed = false;
};

/// Entities that are drawn again, in either direction, are taken out; how many. Two count as the same if corresponding
/// points are within `tolerance` (mm). O(n).
std::size_t drop_duplicates(std::vector<DxfStrand>& strands, double tolerance, Progress& progress);

/// Chained within the tolerance, mm. O(n log n).
std::vector<Cut> cuts(std::vector<DxfStrand> strands, double tolerance, Progress& progress);

/// Into the order of nearest neighbours. O(n log n).
std::vector<Cut> nearest(std::vector<Cut> cuts, Progress& progress);

/// What closing gaps took.
struct GapReport {
  std::size_t moved = 0, bridged = 0;
  double worst = 0;  ///< mm
};

/// Adds a cut to the block begun in `builder`, which stands at its start.
void write_cut(ContourBuilder& builder, const Cut& cut, GapReport& gaps, ProgressScope& progress);

}  // namespace bahnwerk
