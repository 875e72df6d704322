#pragma once
/// Measures of the smoothness of a link, with gradients by its β [Herrmann (4.59)–(4.61)].
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/link.hpp"
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// The weights in J = curvature · ∫ κ dv + rate · ∫ |dκ/dv| dv, with κ that of the first three coordinates, 1/mm.
///
/// (4.60) prints d|κ|/dv in the second integral, which is κ(1) − κ(0) for any link. The total variation of κ is meant,
/// which does not depend on the parameter; the first integral does, unless taken by the arc length.
struct SmoothnessWeights {
  double curvature = 1, rate = 8;
  bool by_length = false;  ///< whether the first integral is ∫ κ ds, the turned angle, instead of ∫ κ dv
  /// Radius r of smoothing, 1/mm: κ and |κ′| are replaced by √(x² + r²) − r where they are not differentiable. This
  /// lowers J by up to (curvature
  /// + rate)·r.
  double rounding = 1e-5;
};

/// Points and weights of Gauss's rule on [0, 1], with the Bernstein polynomials of a link there, two points at a time.
class SmoothnessRule {
 public:
  /// Throws std::invalid_argument for a continuity outside 1 … 4.
  explicit SmoothnessRule(std::size_t continuity, std::size_t points = 32);

  std::size_t continuity() const { return continuity_; }
  std::size_t pairs() const { return weights_.size(); }
  Lanes<2> weight(std::size_t pair) const { return weights_[pair]; }
  /// Returns derivative `order` ≤ 3 of all Bernstein polynomials at a pair of points.
  std::span<const Lanes<2>> row(std::size_t pair, std::size_t order) const {
    return {&rows_[(pair * 4 + order) * link_points(continuity_)], link_points(continuity_)};
  }

 private:
  std::size_t continuity_;
  std::vector<Lanes<2>> weights_, rows_;
};

/// Returns J of the link by the rule and, unless `gradient` is empty, its gradient: ∂/∂β₁ … β_k before, then after. The
/// gradient is that of the sum, exact to round-off. The result is not finite where the derivative of the link vanishes.
/// About 4 µs for k = 3 with gradient.
double smoothness(const SmoothnessRule& rule, const LinkEnds& ends, const LinkShape& shape,
                  const SmoothnessWeights& weights, std::span<double> gradient = {});

/// Returns the distance of the last control point that the beginning determines to the first one that the end
/// determines, first three coordinates, mm (4.61), with its gradient. It is smoothed at 0 like |κ′|, with 1e-6 mm. Its
/// minimum is not unique: between straight neighbours both points lie on fixed lines. The caller has to add a term that
/// makes it unique.
double control_distance(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape,
                        std::span<double> gradient = {});

}  // namespace bahnwerk
