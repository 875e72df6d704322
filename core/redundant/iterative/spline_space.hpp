#pragma once
/// Splines of one degree over clamped knots, and the rows that value, derivatives and their control points are of the
/// control points [Bock 4.2.1].
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

/// Σ weights[r] · d[first + r].
struct SplineRow {
  std::size_t first = 0, count = 0;
  std::array<double, max_spline_degree + 1> weights{};
};

class SplineSpace {
 public:
  /// Degree 1 … 5; the end knots count degree + 1 times, inner ones at most `degree` times.
  SplineSpace(std::size_t degree, std::vector<double> knots);

  std::size_t degree() const { return degree_; }
  std::size_t size() const { return knots_.size() - degree_ - 1; }  ///< control points
  const std::vector<double>& knots() const { return knots_; }
  double begin() const { return knots_.front(); }
  double end() const { return knots_.back(); }
  /// [Bock Def. 4.14]: where control point i acts.
  double greville(std::size_t i) const;

  /// The knot k with t in knots[k] … knots[k + 1], from `hint` on where that is not behind t.
  std::size_t span(double t, std::size_t hint) const {
    std::size_t k = hint >= degree_ && hint < size() && knots_[hint] <= t ? hint : degree_;
    while (k + 1 < size() && (knots_[k + 1] <= t || !(knots_[k + 1] > knots_[k]))) ++k;
    return k;
  }
  /// The degree + 1 B-splines that do not vanish in a span: the weights of at(t, 0). O(degree²).
  void values(std::size_t span, double t, double* out) const;
  /// The derivative of order 0 … 3 at t. `span` is the hint, and is updated. O(degree²).
  SplineRow at(double t, std::size_t order, std::size_t& span) const;
  /// Control point i < size() − order of the derivative of that order [Bock (4.1), (4.23)]. False: the knots leave the
  /// derivative undefined there.
  bool control(std::size_t order, std::size_t i, SplineRow& row) const;
  /// The spline with these control points, from time 0 on.
  TimeSpline spline(const std::vector<double>& controls) const;

 private:
  std::size_t degree_;
  std::vector<double> knots_;
};

}  // namespace bahnwerk
