#pragma once
/// How smooth a link is, with gradients by its β: the measures by which links are chosen [Herrmann (4.59)–(4.61)].
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/link.hpp"
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// J = curvature · ∫ κ dv + rate · ∫ |dκ/dv| dv, κ of the first three coordinates, 1/mm.
///
/// (4.60) prints d|κ|/dv in the second integral, which is κ(1) − κ(0) whatever lies between. As meant it is the total
/// variation of κ and does not depend on the parameter; the first integral does, unless taken by the arc length.
struct SmoothnessWeights {
  double curvature = 1, rate = 8;
  bool by_length = false;  ///< ∫ κ ds, the angle turned, instead of ∫ κ dv
  /// κ and |κ′| are rounded where they are not differentiable: √(x² + r²) − r, 1/mm. Lowers J by up to
  /// (curvature + rate)·r.
  double rounding = 1e-5;
};

/// Points and weights of Gauss's rule on [0, 1], with the Bernstein polynomials of a link there: two points at a time.
class SmoothnessRule {
 public:
  /// Throws std::invalid_argument for a continuity outside 1 … 4.
  explicit SmoothnessRule(std::size_t continuity, std::size_t points = 32);

  std::size_t continuity() const { return continuity_; }
  std::size_t pairs() const { return weights_.size(); }
  Lanes<2> weight(std::size_t pair) const { return weights_[pair]; }
  /// Derivative `order` ≤ 3 of all Bernstein polynomials at a pair of points.
  std::span<const Lanes<2>> row(std::size_t pair, std::size_t order) const {
    return {&rows_[(pair * 4 + order) * link_points(continuity_)], link_points(continuity_)};
  }

 private:
  std::size_t continuity_;
  std::vector<Lanes<2>> weights_, rows_;
};

/// J of the link by the rule, and unless it is empty its gradient: ∂/∂β₁ … β_k before, then after. The gradient is that
/// of the sum, exact to round-off. Not finite where the link stands still. About 4 µs for k = 3 with gradient.
double smoothness(const SmoothnessRule& rule, const LinkEnds& ends, const LinkShape& shape,
                  const SmoothnessWeights& weights, std::span<double> gradient = {});

/// Distance of the last control point that the beginning determines to the first one that the end does, first three
/// coordinates, mm (4.61), with its gradient. Rounded at 0 like |κ′|, with 1e-6 mm. Its minimum is not unique: between
/// straight neighbours both points lie on fixed lines. Whoever minimises it has to add what makes it so.
double control_distance(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape,
                        std::span<double> gradient = {});

}  // namespace bahnwerk
