#pragma once
/// The space of splines of one degree over clamped knots: values, derivatives and control points of derivatives as
/// linear functions (rows) of the control points [Bock 4.2.1].
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

/// A linear function of the control points d: Σ weights[r] · d[first + r], r < count.
struct SplineRow {
  std::size_t first = 0, count = 0;
  std::array<double, max_spline_degree + 1> weights{};
};

class SplineSpace {
 public:
  /// `degree` is 1 … 5; end knots have the multiplicity degree + 1, inner ones at most `degree`. Knots are times, s.
  SplineSpace(std::size_t degree, std::vector<double> knots);

  std::size_t degree() const { return degree_; }
  std::size_t size() const { return knots_.size() - degree_ - 1; }  ///< number of control points
  const std::vector<double>& knots() const { return knots_; }
  double begin() const { return knots_.front(); }
  double end() const { return knots_.back(); }
  /// Returns the Greville abscissa of control point i [Bock Def. 4.14].
  double greville(std::size_t i) const;

  /// Returns k with t in [knots[k], knots[k + 1]], searched from `hint` on if knots[hint] ≤ t.
  std::size_t span(double t, std::size_t hint) const {
    std::size_t k = hint >= degree_ && hint < size() && knots_[hint] <= t ? hint : degree_;
    while (k + 1 < size() && (knots_[k + 1] <= t || !(knots_[k + 1] > knots_[k]))) ++k;
    return k;
  }
  /// Writes the degree + 1 B-splines that do not vanish in a span to `out`: the weights of at(t, 0). O(degree²).
  void values(std::size_t span, double t, double* out) const;
  /// Returns the row of the derivative of order 0 … 3 at t. `span` is a hint and receives the span. O(degree²).
  SplineRow at(double t, std::size_t order, std::size_t& span) const;
  /// Computes the row of control point i < size() − order of the derivative of that order [Bock (4.1), (4.23)]. Returns
  /// false if the knots leave the derivative undefined there.
  bool control(std::size_t order, std::size_t i, SplineRow& row) const;
  /// Returns the spline with these control points as polynomials from time 0 on.
  TimeSpline spline(const std::vector<double>& controls) const;

 private:
  std::size_t degree_;
  std::vector<double> knots_;
};

}  // namespace bahnwerk
