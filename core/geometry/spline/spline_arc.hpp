#pragma once
/// Circular arcs and helices as rational pieces [Herrmann (4.35)–(4.45)], with angles that follow the turn.
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"

namespace bahnwerk {

/// Returns the arc from `from` around the axis through `centre` along `normal` (any length) by `sweep`, rad,
/// right-handed. `change` is added over the arc to z′ (along the axis, mm, change[2]) and to the two angles (change[3],
/// change[4]); change[0] and change[1] are not used.
///
/// It consists of ⌈|sweep|/(π/2)⌉ pieces of equal angle α with weights 1, cos(α/2), 1: the circle is exact to
/// round-off. (In the source α_i/2 with α_i = iα/N_a, (4.45), gives a circle for i = 1 only; its angle from the cross
/// product is undefined at π and never larger.) If nothing but the place in the plane changes, the degree is 2.
/// Otherwise it is 2k + 1: an angle that is linear over the arc is no rational function of the parameter, but a
/// numerator of degree 2k + 1 has its k derivatives at both ends, so that pieces join with G^k in all five coordinates.
/// The angle is within 1.3e-3·change of linear inside a quarter turn for k = 1; tests hold k = 2 … 4. (A numerator of
/// degree 2, with mean values at the odd points, is off by 2.1 % of the change and only G¹.) Throws
/// std::invalid_argument for a zero normal, radius or sweep, and k outside 1 … 4.
std::vector<BezierPiece> spline_arc(const SplinePoint& from, Vec centre, Vec normal, double sweep,
                                    const SplinePoint& change = {}, std::size_t continuity = 3);

}  // namespace bahnwerk
