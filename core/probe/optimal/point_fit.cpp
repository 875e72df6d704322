#include "core/probe/optimal/point_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr std::size_t degree = 5;
using BasisRow = std::array<double, degree + 1>;

class FitSpline {
 public:
  explicit FitSpline(const std::vector<double>& knots) {
    t_.assign(degree, knots.front());
    t_.insert(t_.end(), knots.begin(), knots.end());
    t_.insert(t_.end(), degree, knots.back());
    c_.resize(knots.size() + degree - 1);
  }
  std::size_t size() const { return c_.size(); }
  Vec& coefficient(std::size_t i) { return c_[i]; }

  /// The basis functions that are not 0 at u, and their slopes; returns the index of the first [de Boor].
  std::size_t basis(double u, BasisRow& value, BasisRow& slope) const {
    const auto inner = static_cast<std::ptrdiff_t>(degree) + 1;
    const auto next = std::upper_bound(t_.begin() + inner, t_.end() - inner, u);
    const auto k = static_cast<std::size_t>(next - t_.begin()) - 1;  // t_k ≤ u < t_k+1
    value = {1};
    for (std::size_t d = 1; d <= degree; ++d) {
      if (d == degree) {
        slope = {};
        for (std::size_t i = 0; i < d; ++i) {
          const double s = degree * value[i] / (t_[k + 1 + i] - t_[k + 1 + i - d]);
          slope[i] -= s, slope[i + 1] += s;
        }
      }
      double saved = 0;
      for (std::size_t i = 0; i < d; ++i) {
        const double right = t_[k + 1 + i] - u, left = u - t_[k + 1 + i - d], term = value[i] / (right + left);
        value[i] = saved + right * term;
        saved = left * term;
      }
      value[d] = saved;
    }
    return k - degree;
  }

 private:
  std::vector<double> t_;
  std::vector<Vec> c_;
};

/// Normal equations of a band, solved by Cholesky factors.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t n) : a_(n), b_(n) {}
  template <std::size_t N>
  void add(std::size_t first, const std::array<double, N>& row, double weight, Vec value) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j <= i; ++j) a_[first + i][i - j] += weight * row[i] * row[j];
      b_[first + i] += weight * row[i] * value;
    }
  }
  std::vector<Vec> solve() {
    for (std::size_t i = 0; i < a_.size(); ++i) {
      for (std::size_t d = std::min(i, degree) + 1; d-- > 0;) {
        double s = a_[i][d];
        for (std::size_t k = d + 1; k <= degree && k <= i; ++k) s -= a_[i][k] * a_[i - d][k - d];
        a_[i][d] = d == 0 ? std::sqrt(s) : s / a_[i - d][0];
      }
      for (std::size_t d = 1; d <= degree && d <= i; ++d) b_[i] += -a_[i][d] * b_[i - d];
      b_[i] = b_[i] / a_[i][0];
    }
    for (std::size_t i = a_.size(); i-- > 0;) {
      for (std::size_t d = 1; d <= degree && i + d < a_.size(); ++d) b_[i] += -a_[i + d][d] * b_[i + d];
      b_[i] = b_[i] / a_[i][0];
    }
    return b_;
  }

 private:
  std::vector<BasisRow> a_;  // a_[i][d]: row i, column i − d
  std::vector<Vec> b_;
};

}  // namespace

PointFit fit_points(const std::vector<Vec>& points, std::vector<double> u, double radius,
                    const std::vector<std::size_t>& knots, bool begin_given, bool end_given) {
  constexpr int rounds = 16, first_rounds = 3;  // parameters settle in the first ones
  constexpr double near_enough = 0.1, least_weight = 1e-2, given_weight = 1e6, smoothing = 1e-8;
  const std::size_t n = points.size();
  std::vector<double> weight(n, 1.0), knot;
  for (std::size_t k : knots) knot.push_back(u[k]);
  FitSpline spline(knot);
  PointFit fit{std::vector<Vec>(n), std::vector<Vec>(n)}, best;
  double least = 0;
  BasisRow value, slope;
  for (int round = 0; round < rounds; ++round) {
    NormalEquations equations(spline.size());
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t first = spline.basis(u[i], value, slope);
      const bool given = (i == 0 && begin_given) || (i + 1 == n && end_given);
      equations.add(first, value, given ? given_weight : weight[i], points[i] - points.front());
    }
    // Where points do not determine the curve it is as straight as may be.
    for (std::size_t i = 0; i + 3 < spline.size(); ++i)
      equations.add(i, std::array<double, 4>{-1, 3, -3, 1}, smoothing, {});
    const std::vector<Vec> c = equations.solve();
    for (std::size_t i = 0; i < spline.size(); ++i) spline.coefficient(i) = c[i];
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t first = spline.basis(u[i], value, slope);
      Vec x, v;
      for (std::size_t k = 0; k <= degree; ++k)
        x += value[k] * spline.coefficient(first + k), v += slope[k] * spline.coefficient(first + k);
      const Vec off = points[i] - points.front() - x;
      const double v2 = dot(v, v), along = v2 > 0 ? dot(off, v) / v2 : 0;
      fit.at[i] = points.front() + x;
      fit.off[i] = off - along * v;
      largest = std::max(largest, norm(fit.off[i]));
      if (i > 0 && i + 1 < n) u[i] = std::clamp(u[i] + along, u.front(), u.back());
    }
    if (round + 1 < first_rounds) continue;
    if (best.at.empty() || largest < least) best = fit, least = largest;
    if (least <= near_enough * radius) break;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      double most = 0;
      for (std::size_t i = knots[k]; i <= knots[k + 1]; ++i) most = std::max(most, norm(fit.off[i]));
      double heaviest = 0;
      for (std::size_t i = knots[k] + (k > 0); i <= knots[k + 1]; ++i) {
        weight[i] *= most > 0 ? least_weight + norm(fit.off[i]) / most : 1;
        heaviest = std::max(heaviest, weight[i]);
      }
      for (std::size_t i = knots[k] + (k > 0); i <= knots[k + 1]; ++i)
        weight[i] = std::max(weight[i] / heaviest, least_weight);
    }
  }
  if (begin_given) best.at.front() = points.front();
  if (end_given) best.at.back() = points.back();
  return best;
}

}  // namespace bahnwerk
