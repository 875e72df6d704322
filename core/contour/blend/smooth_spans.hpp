#pragma once
/// The spans of a tube's spline as polynomials. Evaluating these takes a few multiplications per place, the B-splines
/// of degree 5 some fifty divisions.
#include <array>
#include <cstddef>
#include <vector>

#include "core/contour/blend/smooth.hpp"

namespace bahnwerk::blending {

/// A spline as one polynomial per span.
class SpanPolynomials {
 public:
  /// Computes each span from position and two derivatives at both ends, which determine a polynomial of degree 5.
  /// O(spans).
  explicit SpanPolynomials(const TubeSpline& spline);

  struct Place {
    Vec value, slope;  ///< f and its derivative by t
  };
  /// Evaluates break interval `span`: the value is accurate to about 1e-15 of the coordinates, the slope to that
  /// divided by the length of the span.
  Place at(std::size_t span, double t) const {
    const Span& s = spans_[span];
    const double x = (t - s.begin) * s.inverse;
    Vec value = s.c[5], slope = value;
    for (std::size_t k = 4; k > 0; --k) {
      value = x * value + s.c[k];
      slope = x * slope + value;
    }
    return {x * value + s.c[0], s.inverse * slope};
  }

 private:
  struct Span {
    double begin, inverse;  ///< x = (t − begin)·inverse ∈ [0, 1]
    std::array<Vec, 6> c;   ///< f = Σ c[k] x^k
  };
  std::vector<Span> spans_;
};

}  // namespace bahnwerk::blending
