#pragma once
/// Cutting a rational piece where its parametric tangent vanishes, so that what remains is regular inside.
#include <vector>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

/// Curvature times length beyond which a curve counts as turning in a point: passing it, at v² = A/κ, would save less
/// than 1/√(κ L) of the time that the curve takes, against a rest there.
constexpr double sharpest_bend = 1e8;

/// The pieces between the parameters at which dh/du vanishes, in order. A piece with such a point at an end is expanded
/// about it (Rational::vanishing_begin/_end say to which order); a piece with one at both ends is cut in the middle,
/// where it is smooth.
///
/// A tangent counts as vanishing to order m when the Taylor coefficients 1 … m of h there are below 1e-12 of the
/// piece's extent (or what rounding of the coordinates may have caused); they are then exactly 0. A minimum of the
/// speed below 1e-7 of the largest coefficient that does not qualify is cut there too, without touching the
/// coefficients, and so is a needle point, where the curve turns round within nanometres: curvature times length above
/// `sharpest_bend`. Pieces beside that are expanded about it. Curves whose speed vanishes nowhere come back as they
/// are. Cost: O(degree²) per bisection, a few µs for ordinary cubics.
std::vector<Rational> regular_pieces(const Rational& curve);

}  // namespace bahnwerk
