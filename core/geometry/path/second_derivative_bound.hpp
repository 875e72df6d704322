#pragma once
/// Proven bounds of the distance between a curve and its chord.
#include <array>
#include <vector>

#include "core/geometry/curve/curve.hpp"

namespace bahnwerk {

/// Bounds |h_uu| of one curve. A curve and its chord, both traversed linearly in u over [u0, u1], are nowhere further
/// apart than max|h_uu| (u1 − u0)²/8.
class SecondDerivativeBound {
 public:
  explicit SecondDerivativeBound(const Curve& curve);
  /// Returns an upper bound of |h_uu| over [u0, u1], tight as the interval shrinks: in closed form for lines and arcs;
  /// for rational pieces from the magnitudes of the derivatives' Taylor coefficients about the middle. O(degree²).
  double at(double u0, double u1) const;

 private:
  const Curve* curve_;
  double constant_ = 0;  ///< the bound of a line or an arc
  bool rational_ = false, weighted_ = false;
};

}  // namespace bahnwerk
