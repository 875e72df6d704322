#pragma once
/// Rounded corners where they pay, corners as they are where they do not: section by section between two rests, what is
/// driven is the quicker one of both motions.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/contour/blend.hpp"
#include "core/machine/machine.hpp"
#include "core/plan/planning_method.hpp"

namespace bahnwerk {

class Progress;

struct RoundingChoice {
  std::shared_ptr<const Contour> driven;
  MethodResult planned;  ///< its law, without dwells, on the method's first grid
};

/// `sections`: of `blend`, with its result `rounded`. `machine`: limits of the axes that move, as the method holds
/// them.
///
/// The rounded contour is planned. A section that this takes no longer than stopping at its corners takes at least
/// (core/plan/contour/stopping_time.hpp) stays rounded; all others are planned with their corners, too, and if that is
/// quicker they are driven so, exactly as they were given, with a note of how many there are and where the first one
/// is. The two laws are put together without planning anything again. Hence no section takes longer than with stops,
/// planned by the same method on the same grid.
///
/// Cost: 0.1 µs per given segment and, for the sections in doubt, what the method takes: none of polygons, few of arcs.
RoundingChoice choose_rounding(const std::shared_ptr<const Contour>& given, std::shared_ptr<const Contour> rounded,
                               const std::vector<BlendSection>& sections, const Machine& machine,
                               const MethodRow& method, const MethodOptions& options, Progress& progress, double from,
                               double to);

}  // namespace bahnwerk
