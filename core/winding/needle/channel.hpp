#pragma once
/// Moves the needle's tip into the channel that the part leaves, where the straight wire would put it outside. Lengths
/// mm, angles rad.
///
/// The source's tip lies in the direction u from the point where the wire is held over its place [Herrmann (4.15),
/// (4.24)]. Where a needle there would touch the part, the wire bends at its place instead, which the part and the
/// wires below hold, and continues in the direction of u + k n, n a unit vector across the channel, k the least (of
/// either sign) with which the needle keeps its distance. Bend and exit angle are those of the wire's actual direction,
/// for which (4.24) gives the tip. Hence k, and with it the tip, changes continuously with the wire's place and is 0
/// where the needle keeps its distance anyway. Where no |k| up to 1.5 suffices, the k with the largest distance is
/// taken. The clearance along the whole path is checked separately (core/winding/needle/clearance.hpp).
#include <functional>

#include "core/winding/needle/obstacles.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {

/// Returns an estimate, not a bound, of the distance of a standing needle from the nearest obstacle, mm, from points
/// along its axis 0.5 mm apart and a search about the nearest of them. It takes some 20 µs.
double room(const NeedlePose& pose, const NeedleShape& needle, const std::vector<const Obstacle*>& obstacles);
/// Returns the least distance over 25 poses from one to the other, tip and angles linear.
double room(const NeedlePose& from, const NeedlePose& to, const NeedleShape& needle,
            const std::vector<const Obstacle*>& obstacles);
/// Returns that distance for a move through a slot from one height to the other, seen in sections as if the slot were
/// infinite. A line that ends between these heights is continued, by half its length at most: the link that begins
/// there leaves the slot along it.
double slot_room(const NeedlePose& from, const NeedlePose& to, double low, double high, const NeedleShape& needle,
                 const Obstacle& iron);

/// Returns the support point of a wire in the direction `along`, of unit length, or in a changed direction with enough
/// distance. `support` computes the support point of any direction; `left` is the distance of a pose, mm. The result is
/// that of `along` itself if it has `enough` distance; otherwise it takes up to 90 calls of both.
Expected<SupportPoint, NoSupport> kept_clear(Vec3 along, Vec3 across,
                                             const std::function<Expected<SupportPoint, NoSupport>(Vec3)>& support,
                                             const std::function<double(const NeedlePose&)>& left, double enough);

}  // namespace bahnwerk::winding
