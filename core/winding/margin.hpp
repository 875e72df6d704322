#pragma once
/// Bounds of the effect of rounding on a wire's place, mm, which define "fits exactly". Every distance in a slot is
/// compared with them.
///
/// Documents hold coordinates up to 1e4 mm and radii up to M = 1e5 mm. In double precision, u = 2⁻⁵³, a point carries
/// an error of at most 2 u M after it has been read and turned into a parallel (two roundings of numbers up to M), a
/// distance from it to a line or circle one of at most 12 u M (a foot on the carrier: six products and sums, each of
/// which passes on what it got; the difference and its root: six more). Two such distances with the points that they
/// are measured from differ by less than 2 · (2 + 12) u M = 3.1e-10 mm from what they would be without rounding. For
/// coordinates up to 1e4 mm, without arcs, it is a tenth of that.
namespace bahnwerk::winding {

/// A planner calls a place free if it lacks at most this.
inline constexpr double fit_margin = 5e-10;
/// The verifier computes the distances by other formulas, with as much rounding again. No wire that it accepts lacks
/// more. The bound on the count covers all layouts that lack at most this.
inline constexpr double verify_margin = 2 * fit_margin;

}  // namespace bahnwerk::winding
