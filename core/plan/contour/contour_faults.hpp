#pragma once
/// What contradicts itself in a contour, a machine and what is asked for. A fault's place is that in a document of kind
/// "contour", such as {"machine", "axes", "z"}; `axes` are the machine's in their order.
#include <cstddef>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/plan/contour_plan.hpp"

namespace bahnwerk {

/// Limits and cycle times that are no positive numbers, ranges without extent. A schema excludes them; a machine that
/// is built by hand may have them.
std::vector<InputFault> machine_faults(const Machine& machine);

/// What the planning asks for and machine and options do not give, whatever the contour.
std::vector<InputFault> planning_faults(const Machine& machine, const ContourPlanning& planning);

/// An axis is missing that the contour moves; none that it moves has the jerk limit that the method needs; or the
/// motion would have more than planning.max_setpoints even at full speed. O(segments).
std::vector<InputFault> contour_faults(const Contour& contour, const Machine& machine, const ContourPlanning& planning);

/// Parts of the above, for machines whose head has other axes behind it; each adds its faults.
/// `member` of the machine has the axes that its head needs.
void check_axes(const Contour& contour, const Machine& head, const char* member, std::vector<InputFault>& faults);
/// s: no motion along a segment is faster than its feed or all axes at full speed together. Axes beyond the plane of a
/// planar contour stand still.
double shortest_time(const Contour& contour, const Machine& head);
void check_setpoints(double shortest, const Machine& head, double max_setpoints, std::vector<InputFault>& faults);
void check_corners(const ContourPlanning& planning, std::vector<InputFault>& faults);

}  // namespace bahnwerk
