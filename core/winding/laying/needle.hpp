#pragma once
/// Needle winding simulated wire by wire [Herrmann 4.2.4, Algorithm 4.4]: in every region a wire comes to lie where the
/// piece of wire from the region before is shortest, because its tension draws it there.
#include <array>

#include "core/winding/laying/laying_regions.hpp"
#include "core/winding/layout/layout.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

/// Layouts of the four regions; all have the same number of wires. `tension_points` holds the points that drew each
/// wire, in coordinates of its region.
using NeedleLayout = std::array<Layout, 4>;

/// The first wire of the first slot is drawn to `tie_in` (4.12), every other one to the foot of the point at which the
/// wire left the region before (4.13)–(4.20). Ends when a region has no place for a wire; a turn that not all regions
/// hold does not count. The optimum of each place is global, see core/winding/layout/sites.hpp.
/// O(n · open corners) for n turns.
NeedleLayout needle(const LayingRegions& regions, double radius, Point tie_in, Progress& progress);

/// The points that draw the wires of the second slot (`regions.at[2]`) if all regions hold this layout alike, as an
/// orthocyclic one in a rotor: every wire comes from its own place in the head before. In the first slot it comes from
/// the turn before, which between two rows is what guides the wire to the next row.
std::vector<Point> turn_pulls(const LayingRegions& regions, const Layout& layout);

/// One slot without winding heads: every wire is drawn to the same point.
Layout needle(const Region& usable_area, double radius, Point tension_point, Progress& progress);

/// The slot's own heads and tie-in point.
NeedleLayout needle(const Slot& slot, double radius, const StatorHeads& heads, Progress& progress);
NeedleLayout needle(const Slot& slot, double radius, const RotorHeads& heads, Progress& progress);

}  // namespace bahnwerk::winding
