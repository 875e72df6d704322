#pragma once
/// The needle's tip for a wanted place of the wire [Herrmann 4.2.6, (4.15), (4.24)].
///
/// The wire is held at one point of the region before and drawn from there over its place P. It continues straight, in
/// the direction u from where it is held to P, for the length l, and then bends in a circle of radius ρ into the
/// needle's axis, which points along d out of the needle. The exit angle α is the angle between the needle's axis and
/// the wire as it leaves: cos α = −d·u; 0 is straight out. The circle's tangents meet ρ tan(α/2) from both of its ends,
/// so the tip is at
///
///   P + (l + ρ tan(α/2)) u − ρ tan(α/2) d.
///
/// The radius is the one at which the tension's moment about the needle's mouth, at α = 90°, equals the wire's
/// resistance to bending, F ρ (1 − cos α) = M, and at least the radius that the enamel allows: ρ = max(ρ_min, M/F).
/// [Herrmann] says that the circle depends on the tension and has a least radius, but gives no formula.
#include <optional>

#include "core/winding/part/vec3.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk::winding {

struct Pull {
  double force = 30;          ///< F, tension of the wire, N
  double bend_radius = 5;     ///< ρ_min, mm
  double bending_moment = 0;  ///< M, resistance of the wire to bending, N mm; see bending_moment()
  double free_length = 2;     ///< l of straight wire between its place and the bend, mm
};

/// Returns M of a round wire that yields over its whole section: σ d³/6 with its copper diameter d, N mm.
/// `yield_stress` N/mm²: soft-annealed copper that has been drawn over pulleys.
inline constexpr double bending_stress = 150;
double bending_moment(const Wire& wire, double yield_stress = bending_stress);

/// Returns ρ, mm. Throws InvalidInput naming pull.force, pull.bend_radius, pull.bending_moment or pull.free_length
/// where they are negative, not finite, or the force is 0.
double bend_radius(const Pull& pull);

struct TipOffset {
  Vec3 offset;            ///< vector from the wire's place to the tip, mm
  double exit_angle = 0;  ///< α, rad
};
/// `along` is u and `needle` is d, both of unit length. Returns none where the wire would leave the needle backwards,
/// within 1e-3 rad of its axis: no circle fits.
std::optional<TipOffset> tip_offset(Vec3 along, Vec3 needle, double bend_radius, double free_length);

}  // namespace bahnwerk::winding
