#pragma once
/// Free links between two given pieces with geometric continuity G^k, k = 1 … 4 [Herrmann (4.52)–(4.57)]: rational
/// Bézier pieces of degree 2k + 1 (4.53).
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/geometry/spline/reparametrise.hpp"

namespace bahnwerk {

/// What a link joins: the end of the piece before and the beginning of the one after, each by its own parameter.
struct LinkEnds {
  SplineJet before, after;
};
/// The β of (4.55) and (4.56) (see reparametrise.hpp) and a weight per control point, none = all 1.
///
/// The end conditions are those of the curve, not of its homogeneous form as in (4.57): G^k holds with any positive
/// weights, for lines and arcs alike. (The source solves for weights from the neighbours' and changes w₃, w₄
/// afterwards: that keeps G² only where the neighbour is an arc, and weights solved for turn negative for some β.)
struct LinkShape {
  Betas before{1, 0, 0, 0}, after{1, 0, 0, 0};
  std::vector<double> weights;
};

/// Control points of a link: k + 1 from the conditions at each end, 2k + 2 in all.
constexpr std::size_t link_points(std::size_t continuity) { return 2 * continuity + 2; }

/// The link of this continuity, on [0, 1]. O(k²). Throws std::invalid_argument for k outside 1 … 4, β₁ ≤ 0, weights
/// that are not positive, and counts that do not fit.
BezierPiece link(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape);

/// Weights that continue the homogeneous derivatives of the neighbours as (4.57) has it: the source's link. Between
/// lines they are 1. For large β₂, β₃ beside arcs they may be zero or negative; link() refuses those. `before`,
/// `after`: the neighbour's weight and its derivatives at the joint.
std::vector<double> inherited_weights(std::size_t continuity, const std::array<double, spline_orders>& before,
                                      const std::array<double, spline_orders>& after, const LinkShape& shape);

/// Backwards through link(): from the gradient of a function by w·(x, y, z) of every control point to that by β₁ … β_k
/// before, then after; weights are held. O(k²). Throws what link() throws, and for counts that do not fit.
void link_gradient(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape, std::span<const Vec> by_points,
                   std::span<double> gradient);

}  // namespace bahnwerk
