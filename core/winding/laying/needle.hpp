#pragma once
/// Simulates needle winding wire by wire [Herrmann 4.2.4, Algorithm 4.4]: in every region the tension draws a wire to
/// the place at which the piece of wire from the region before is shortest.
#include <array>

#include "core/base/progress.hpp"
#include "core/winding/laying/laying_regions.hpp"
#include "core/winding/layout/layout.hpp"

namespace bahnwerk::winding {

/// Layouts of the four regions, with equally many wires. `tension_points` are the points that drew each wire, in
/// coordinates of its region.
using NeedleLayout = std::array<Layout, 4>;

/// The first wire of the first slot is drawn to `tie_in` (4.12), every other one to the foot of the point at which the
/// wire left the region before (4.13)–(4.20). The simulation ends when a region has no place for a wire; a turn that
/// does not fit in all regions does not count. The optimum of each place is global, see core/winding/layout/sites.hpp.
/// O(n · open corners) for n turns.
NeedleLayout needle(const LayingRegions& regions, double radius, Point tie_in, Progress progress);

/// Returns the points that draw the wires of the second slot (`regions.at[2]`) if all regions have this layout, as an
/// orthocyclic one in a rotor: every wire comes from its own place in the head before. In the first slot it comes from
/// the turn before, which guides the wire to the next row between two rows.
std::vector<Point> turn_pulls(const LayingRegions& regions, const Layout& layout);

/// Simulates a stator slot with its heads and tie-in point.
NeedleLayout needle(const Slot& slot, double radius, const StatorHeads& heads, Progress progress);
NeedleLayout needle(const Slot& slot, double radius, const RotorHeads& heads, Progress progress);

}  // namespace bahnwerk::winding
