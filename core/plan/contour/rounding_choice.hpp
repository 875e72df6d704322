#pragma once
/// Chooses section by section, between two rests, the quicker one of two motions: along the rounded contour, or along
/// the given one with stops at its corners.
#include <memory>
#include <optional>

#include "core/base/progress.hpp"
#include "core/plan/contour/prepared_contour.hpp"

namespace bahnwerk {

struct DrivenContour {
  std::shared_ptr<const Contour> contour;
  std::optional<MethodResult> law;  ///< without dwells, on the method's first grid; none where nothing was rounded
};

/// Returns the contour to drive, with its law.
///
/// The rounded contour is planned. A section stays rounded if its rounded time does not exceed the lower bound of its
/// time with stops (core/plan/contour/stopping_time.hpp; 0 where axes are not the tool's coordinates). Every other
/// section is also planned with its corners; if that is quicker it is driven exactly as given, and a note states how
/// many such sections there are and where the first one is. The two laws are joined without further planning. No
/// section therefore takes longer than with stops, planned by the same method on the same grid.
///
/// Cost: 0.1 µs per given segment, and the method's cost for the rounded contour and the sections in doubt (none of
/// polygons, few of arcs). Throws as the method does.
DrivenContour choose_rounding(const PreparedContour& prepared, const MethodOptions& options, Progress progress);

}  // namespace bahnwerk
