#pragma once
/// How much wire the needle has drawn: the free wire between the needle and where the wire lies already.
///
/// The wire lies up to a place A. From there it goes straight, touches the circle of radius ρ in which it bends at the
/// needle's mouth (core/winding/needle/wire_pull.hpp), and follows it into the needle's axis, which points along d out
/// of the tip p. In the plane of d and A − p, with x along d and y across it towards A, the circle's centre is (0, ρ):
///
///   straight ℓ = √(x² + y² − 2 ρ y),   bend α = atan2(y − ρ, x) + atan2(ρ, ℓ),   free wire W = ℓ + ρ α.
///
/// At a support point A, the place of the wire, and the circle's tangent are in line by construction: so the free wire
/// is as long, and grows as fast, from a place that the wire has reached as from the one before. What it lacks: the
/// wire's stiffness beyond the bend, its stretch (F/(E A), 0.04 % at 30 N on 0.9 mm), and any contact between A and the
/// needle.
#include <cstddef>
#include <vector>

#include "core/numeric/taylor.hpp"
#include "core/winding/needle/support_points.hpp"
#include "core/winding/part/turns.hpp"
#include "core/winding/path/needle_path.hpp"

namespace bahnwerk::winding {

/// A number and its first two derivatives by the length of the needle's way.
using Rate = Taylor<2>;

/// Where the wire lies already while the needle passes one piece of its path: at one place, or, behind the winding
/// tools of a stator, up to one that follows the needle on an arc about the part's axis, at the distance that the
/// support points leave between them (core/winding/needle/support_points.hpp): straight wire and bend.
struct Anchor {
  Space begin;             ///< where the wire lies when the piece begins
  double sweep = 0;        ///< of the arc, rad, counterclockwise positive; 0: no arc
  double out = 0, up = 0;  ///< by how much the arc gets farther from the axis, and higher, mm
  bool free = false;       ///< the wire is not where it was at the end of the piece before: between two coils
};

/// One anchor per piece of the needle's path. Between a fixed piece and the next the wire is held where the next one's
/// support points take it to be. `pieces`: as needle_path() made them of `support`. O(pieces).
std::vector<Anchor> anchors(const std::vector<NeedlePiece>& pieces, const std::vector<FixedPiece>& support,
                            const std::vector<Turn>& turns);

/// The needle's pose, x, y, z (mm), φ, ψ (rad).
struct PoseRates {
  Rate x, y, z, phi, psi;
};
struct FreeWire {
  Rate length;  ///< W, and what has come to lie along the arc since the piece began, mm
  Rate bend;    ///< α, rad
};
/// Nearer than 0.01 mm to the circle, or within it, the straight wire counts as 0.01 mm long.
FreeWire free_wire(const PoseRates& needle, const Anchor& anchor, double bend_radius, double free_length);

}  // namespace bahnwerk::winding
