#pragma once
/// The length of wire that the needle has drawn: the free wire between the needle and the laid wire.
///
/// The wire lies up to a place A. From there it is straight until it touches the circle of radius ρ in which it bends
/// at the needle's mouth (core/winding/needle/wire_pull.hpp), and follows it into the needle's axis, which points along
/// d out of the tip p. In the plane of d and A − p, with x along d and y across it towards A, the circle's centre is
/// (0, ρ):
///
///   straight ℓ = √(x² + y² − 2 ρ y),   bend α = atan2(y − ρ, x) + atan2(ρ, ℓ),   free wire W = ℓ + ρ α.
///
/// At a support point A, the place of the wire and the circle's tangent are in line by construction, so the free wire
/// has one length, and one rate, from a place that the wire has reached and from the one before. The model neglects the
/// wire's stiffness beyond the bend, its strain (F/(E A), 0.04 % at 30 N on 0.9 mm), and any contact between A and the
/// needle.
#include <cstddef>
#include <vector>

#include "core/numeric/taylor.hpp"
#include "core/winding/needle/support_points.hpp"
#include "core/winding/part/turns.hpp"
#include "core/winding/path/needle_path.hpp"

namespace bahnwerk::winding {

/// A number and its first two derivatives by the length of the needle's path.
using Rate = Taylor<2>;

/// The end of the laid wire while the needle passes one piece of its path: one place, or, behind the winding tools of a
/// stator, a place that follows the needle on an arc about the part's axis at the distance of the support points
/// (core/winding/needle/support_points.hpp): straight wire and bend.
struct Anchor {
  Vec3 begin;              ///< end of the laid wire at the beginning of the piece
  double sweep = 0;        ///< rad, sweep of the arc, counterclockwise positive; 0: no arc
  double out = 0, up = 0;  ///< increase of the arc's distance from the axis, and of its height, mm
  bool free = false;       ///< whether the wire's end differs from that of the piece before: between two coils
};

/// Returns one anchor per piece of the needle's path. Between a fixed piece and the next the wire is held where the
/// next one's support points assume it. `pieces` are those of needle_path() for `support`. O(pieces).
std::vector<Anchor> anchors(const std::vector<NeedlePiece>& pieces, const std::vector<FixedPiece>& support,
                            const std::vector<Turn>& turns);

/// The needle's pose, x, y, z (mm), φ, ψ (rad).
struct PoseRates {
  Rate x, y, z, phi, psi;
};
struct FreeWire {
  Rate length;  ///< W plus the wire laid along the arc since the beginning of the piece, mm
  Rate bend;    ///< α, rad
};
/// Computes the free wire. Nearer than 0.01 mm to the circle, or within it, the straight wire counts as 0.01 mm long.
FreeWire free_wire(const PoseRates& needle, const Anchor& anchor, double bend_radius, double free_length);

}  // namespace bahnwerk::winding
