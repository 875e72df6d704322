#pragma once
/// Chooses section by section, between two rests, the quicker one of two motions: along the rounded contour, or along
/// the given one with stops at its corners.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/blend.hpp"
#include "core/machine/machine.hpp"
#include "core/plan/contour/contour_axes.hpp"
#include "core/plan/planning_method.hpp"

namespace bahnwerk {

struct RoundingChoice {
  std::shared_ptr<const Contour> driven;
  MethodResult planned;  ///< the result; its time law is without dwells, on the method's first grid
};

/// Returns the contour to drive. `sections` and `rounded` are results of `blend`. `machine` has the limits of the
/// moving ones of `axes`, as the method keeps them.
///
/// The rounded contour is planned. A section stays rounded if its rounded time does not exceed the lower bound of its
/// time with stops (core/plan/contour/stopping_time.hpp; 0 where axes are not the tool's coordinates). Every other
/// section is also planned with its corners; if that is quicker it is driven exactly as given, and a note states how
/// many such sections there are and where the first one is. The two laws are joined without further planning. No
/// section therefore takes longer than with stops, planned by the same method on the same grid.
///
/// Cost: 0.1 µs per given segment, and the method's cost for the sections in doubt (none of polygons, few of arcs).
RoundingChoice choose_rounding(const std::shared_ptr<const Contour>& given, std::shared_ptr<const Contour> rounded,
                               const std::vector<BlendSection>& sections, const ContourAxes& axes,
                               const Machine& machine, const MethodRow& method, const MethodOptions& options,
                               Progress progress);

}  // namespace bahnwerk
