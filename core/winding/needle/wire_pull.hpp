#pragma once
/// From where the wire shall lie to where the needle's tip must be [Herrmann 4.2.6, (4.15), (4.24)].
///
/// The wire is held at one point of the region before and drawn from there over its place P. It goes on straight, in
/// the direction u from where it is held to P, for the length l, and then bends in a circle of radius ρ into the
/// needle's axis, which points along d out of the needle. The exit angle α is that between the needle's axis and the
/// wire as it leaves: cos α = −d·u; 0 is straight out. The circle's tangents meet ρ tan(α/2) from both of its ends, so
/// the tip is at
///
///   P + (l + ρ tan(α/2)) u − ρ tan(α/2) d.
///
/// The radius is the one at which the tension's moment about the needle's mouth, at α = 90°, is what the wire's own
/// bending resists: F ρ (1 − cos α) = M; never less than what the enamel bears: ρ = max(ρ_min, M/F). [Herrmann] says
/// that the circle depends on the tension and has a least radius, but gives no formula.
#include "core/winding/part/space.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk::winding {

struct Pull {
  double force = 30;          ///< F, tension of the wire, N
  double bend_radius = 5;     ///< ρ_min, mm
  double bending_moment = 0;  ///< M that the wire resists with, N mm; see bending_moment()
  double free_length = 2;     ///< l of straight wire between its place and the bend, mm
};

/// M of a round wire that yields all over its section: σ d³/6 with its copper diameter d, N mm.
/// `yield_stress` N/mm²: soft-annealed copper that has been drawn over pulleys.
inline constexpr double bending_stress = 150;
double bending_moment(const Wire& wire, double yield_stress = bending_stress);

/// ρ, mm. Throws InvalidInput naming pull.force, pull.bend_radius, pull.bending_moment or pull.free_length where they
/// are negative, not finite, or the force is 0.
double bend_radius(const Pull& pull);

struct TipOffset {
  Space offset;           ///< from the wire's place to the tip, mm
  double exit_angle = 0;  ///< α, rad
};
/// `along` u and `needle` d, both of unit length. Throws Infeasible where the wire would leave the needle backwards,
/// within 1e-3 rad of its axis: no circle does that.
TipOffset tip_offset(Space along, Space needle, double bend_radius, double free_length);

}  // namespace bahnwerk::winding
