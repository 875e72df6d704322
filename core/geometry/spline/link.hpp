#pragma once
/// Free links between two given pieces with geometric continuity G^k, k = 1 … 4 [Herrmann (4.52)–(4.57), 4.3.4].
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/spline/nurbs_path.hpp"
#include "core/geometry/spline/reparametrise.hpp"

namespace bahnwerk {

/// What all links of one continuity share: knots and the solved system of (4.57). With `via` ∈ (0, 1) two knots are
/// there, which make room for a value and a derivative (the stator's extra point and tangent); 0: none.
///
/// Degree 2k + 1 (4.53). The source does not say at which parameter the extra point is met nor where the two control
/// points come from; a double knot keeps the degree, and the curve C^(2k−1) there.
class LinkBasis {
 public:
  /// Throws std::invalid_argument for k outside 1 … 4 and via outside [0, 1).
  explicit LinkBasis(std::size_t continuity, double via = 0);

  std::size_t continuity() const { return continuity_; }
  std::size_t degree() const { return 2 * continuity_ + 1; }
  std::size_t size() const { return size_; }  ///< of control points, and of conditions
  double via() const { return via_; }
  const std::vector<double>& knots() const { return knots_; }
  /// Conditions, in order: derivatives 0 … k at 0; value and derivative at via; derivatives k … 0 at 1.
  /// condition = Σ row(condition, i) · point_i, and back.
  double row(std::size_t condition, std::size_t point) const { return rows_[condition * size_ + point]; }
  double inverse(std::size_t point, std::size_t condition) const { return inverse_[point * size_ + condition]; }

 private:
  std::size_t continuity_, size_;
  double via_;
  std::vector<double> knots_, rows_, inverse_;
};

struct LinkVia {
  SplinePoint point, tangent;  ///< the tangent by the link's parameter; its length shapes the link like a β
};
/// What a link joins: the end of the piece before and the beginning of the one after, each by its own parameter.
struct LinkEnds {
  SplineJet before, after;
  std::optional<LinkVia> via;  ///< there if the basis has a place for it
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

/// The link, on [0, 1]. O(size²). Throws std::invalid_argument for β₁ ≤ 0, weights that are not positive, and counts
/// that do not fit.
NurbsPath link(const LinkBasis& basis, const LinkEnds& ends, const LinkShape& shape);

/// Weights that continue the homogeneous derivatives of the neighbours as (4.57) has it: the source's link. Between
/// lines they are 1. For large β₂, β₃ beside arcs they may be zero or negative; link() refuses those. `before`,
/// `after`: the neighbour's weight and its derivatives at the joint.
std::vector<double> inherited_weights(const LinkBasis& basis, const std::array<double, spline_orders>& before,
                                      const std::array<double, spline_orders>& after, const LinkShape& shape);

/// Derivatives of the link's homogeneous control points by β: before β₁ … β_k, then after β₁ … β_k.
/// result[parameter][point]; weights are held, so the last coordinate is 0.
std::vector<std::vector<HomogeneousPoint>> link_derivatives(const LinkBasis& basis, const LinkEnds& ends,
                                                            const LinkShape& shape);

}  // namespace bahnwerk
