#pragma once
/// Faults of a contour, a machine and planning options, and contradictions between them. A fault's place is that in a
/// document of kind "contour", such as {"machine", "axes", "z"}; `axes` are the machine's in their order.
#include <cstddef>
#include <vector>

#include "core/base/errors.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/tool_machine.hpp"
#include "core/plan/contour/contour_plan.hpp"

namespace bahnwerk {

/// Returns a fault for every limit or cycle time that is not a positive number and every range without extent. A schema
/// excludes them, but a machine built by a program may have them.
std::vector<InputFault> machine_faults(const Machine& machine);

/// Returns faults of the planning options that do not depend on the contour: whatever the method needs and machine or
/// options lack.
std::vector<InputFault> planning_faults(const Machine& machine, const ContourPlanning& planning);

/// Returns a fault if an axis that the contour moves is missing (`z`, for a machine with kinematics), if no moved axis
/// has the jerk limit that the method needs, or if the motion would have more than planning.max_setpoints even at full
/// speed. O(segments).
std::vector<InputFault> contour_faults(const Contour& contour, const ToolMachine& machine,
                                       const ContourPlanning& planning);

/// The following functions are parts of those above, for machines whose head carries other axes; each adds its faults.
/// `member` is the machine's member with the axes that its head needs.
void check_axes(const Contour& contour, const Machine& head, const char* member, std::vector<InputFault>& faults);
/// Returns a lower bound of the duration, s: no segment is passed faster than its feed or all axes at full speed
/// permit. Axes outside the plane of a planar contour stand still. Through kinematics, feeds alone count.
double shortest_time(const Contour& contour, const ToolMachine& head);
void check_setpoints(double shortest, const Machine& head, double max_setpoints, std::vector<InputFault>& faults);
void check_corners(const ContourPlanning& planning, std::vector<InputFault>& faults);

}  // namespace bahnwerk
