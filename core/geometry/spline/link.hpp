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

/// The neighbours of a link: the end of the piece before and the beginning of the one after, each by its own parameter.
struct LinkEnds {
  SplineJet before, after;
};
/// The β of (4.55) and (4.56) (see reparametrise.hpp) and one weight per control point; no weights mean all 1.
///
/// The end conditions are those of the curve, not of its homogeneous form as in (4.57): G^k holds with any positive
/// weights, for lines and arcs. (The source solves for weights from the neighbours' and changes w₃, w₄ afterwards,
/// which preserves G² only where the neighbour is an arc; its weights become negative for some β.)
struct LinkShape {
  Betas before{1, 0, 0, 0}, after{1, 0, 0, 0};
  std::vector<double> weights;
};

/// Returns the number of control points of a link: k + 1 from the conditions at each end.
constexpr std::size_t link_points(std::size_t continuity) { return 2 * continuity + 2; }

/// Returns the link of this continuity, on [0, 1]. O(k²). Throws std::invalid_argument for k outside 1 … 4, β₁ ≤ 0,
/// weights that are not positive, and counts that do not match.
BezierPiece link(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape);

/// Computes the adjoint of link(): converts the gradient of a function by w·(x, y, z) of every control point to the
/// gradient by β₁ … β_k before, then after, with constant weights. O(k²). Throws what link() throws, and for counts
/// that do not match.
void link_gradient(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape, std::span<const Vec> by_points,
                   std::span<double> gradient);

}  // namespace bahnwerk
