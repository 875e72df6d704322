#pragma once
/// Keeps the needle's tip inside the channel that the part leaves it, where the straight run of the wire would put it
/// outside. Lengths mm, angles rad.
///
/// The source's tip lies in the direction u from where the wire is held over its place [Herrmann (4.15), (4.24)]. Where
/// a needle there would touch the part, the wire bends at its place instead, which the part and the wires below hold,
/// and runs on in the direction of u + k n, n a unit vector across the channel, k the least (of either sign) with which
/// the needle keeps its distance. Bend and exit angle are those of the wire's actual direction: the tip is where (4.24)
/// puts it for that. So k, and with it the tip, changes continuously with the wire's place and is 0 where the needle
/// keeps its distance anyway. Where no |k| up to 1.5 gives the distance, the one that gives most is taken: what the
/// needle's clearance is along the whole path is another question (core/winding/needle/clearance.hpp).
#include <functional>

#include "core/winding/needle/obstacles.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {

/// Distance of a standing needle from the nearest obstacle, mm, by looks along its axis 0.5 mm apart and a search about
/// the nearest of them. No bound: an estimate to aim with, some 20 µs.
double room(const NeedlePose& pose, const NeedleShape& needle, const std::vector<const Obstacle*>& obstacles);
/// The least of 25 poses from one to the other, tip and angles changing evenly.
double room(const NeedlePose& from, const NeedlePose& to, const NeedleShape& needle,
            const std::vector<const Obstacle*>& obstacles);
/// The same through a slot, of what of the line lies between two heights: seen in sections, as if the slot went on.
double slot_room(const NeedlePose& from, const NeedlePose& to, double low, double high, const NeedleShape& needle,
                 const Obstacle& iron);

/// The support point of a wire that would run on in the direction `along`, of unit length. `support` makes that of any
/// direction, and may throw Infeasible; `left` is what a pose leaves, mm. That of `along` itself where this leaves
/// `enough`. Up to 90 calls of both otherwise.
SupportPoint kept_clear(Space along, Space across, const std::function<SupportPoint(Space)>& support,
                        const std::function<double(const NeedlePose&)>& left, double enough);

}  // namespace bahnwerk::winding
