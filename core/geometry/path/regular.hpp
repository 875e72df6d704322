#pragma once
/// Cuts a rational piece where its parametric tangent vanishes, so that the parts are regular inside.
#include <vector>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

/// Product of curvature and length beyond which a curve counts as turning in a point. Passing such a point at v² = A/κ
/// instead of resting would save less than 1/√(κ L) of the time that the curve takes.
constexpr double sharpest_curvature = 1e8;

/// Returns the pieces between the parameters at which dh/du vanishes, in order. A piece with such a point at an end is
/// expanded about it (Rational::vanishing_begin/_end give the order); a piece with one at both ends is cut in the
/// middle, where it is smooth.
///
/// A tangent vanishes to order m if the Taylor coefficients 1 … m of h there are below 1e-12 of the piece's extent (or
/// of what rounding of the coordinates may cause); they are then set to exactly 0. The curve is also cut, with
/// unchanged coefficients, at a minimum of the speed below 1e-7 of the largest coefficient that does not qualify, and
/// at a needle point, where the curve reverses within nanometres: curvature times length above `sharpest_curvature`.
/// Pieces beside such places are expanded about them. Curves whose speed vanishes nowhere are returned unchanged. Cost:
/// O(degree²) per bisection, a few µs for ordinary cubics.
std::vector<Rational> regular_pieces(const Rational& curve);

}  // namespace bahnwerk
