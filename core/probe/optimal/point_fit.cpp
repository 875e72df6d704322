#include "core/probe/optimal/point_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

constexpr std::size_t degree = 5;
using BasisRow = std::array<double, degree + 1>;
using DerivativeRow = std::array<double, degree>;

class FitSpline {
 public:
  explicit FitSpline(const std::vector<double>& knots) {
    t_.assign(degree, knots.front());
    t_.insert(t_.end(), knots.begin(), knots.end());
    t_.insert(t_.end(), degree, knots.back());
    c_.resize(knots.size() + degree - 1);
  }
  std::size_t size() const { return c_.size(); }
  void set(std::vector<Vec> coefficients) { c_ = std::move(coefficients); }

  struct State {
    Vec x, v;
  };
  State at(double u) const {
    BasisRow value, slope;
    const std::size_t first = basis(u, value, slope);
    State out;
    for (std::size_t k = 0; k <= degree; ++k) out.x += value[k] * c_[first + k], out.v += slope[k] * c_[first + k];
    return out;
  }

  /// The coefficients of c_i … c_(i+order) in coefficient i of derivative `order`, order ≤ 4, times the power `order`
  /// of the distance of the knots there. Those of derivative 4 are its values at the knots.
  DerivativeRow derivative(std::size_t i, std::size_t order) const {
    std::array<DerivativeRow, 5> row{};
    for (std::size_t k = 0; k <= order; ++k) row[k][k] = 1;
    for (std::size_t r = 1; r <= order; ++r)
      for (std::size_t k = 0; k + r <= order; ++k)
        for (std::size_t d = 0; d <= order; ++d)
          row[k][d] = (row[k + 1][d] - row[k][d]) * static_cast<double>(degree + 1 - r) /
                      (t_[i + k + degree + 1] - t_[i + k + r]);
    const std::size_t from = std::max(i + 4, degree), to = std::min(i + 6, t_.size() - 1 - degree);
    const double distance = (t_[to] - t_[from]) / static_cast<double>(to - from);
    for (double& d : row[0]) d *= std::pow(distance, order);
    return row[0];
  }

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
                    const std::vector<double>& knots, bool begin_given, bool end_given) {
  constexpr int rounds = 20, first_rounds = 3;  // parameters settle in the first ones
  constexpr double largest_power = 100, growth = 1.5, near = 0.95;
  constexpr double least_weight = 1e-3, largest_weight = 1e6, given_weight = 1e6, snap = 1e-5, acceleration = 1e-8;
  const std::size_t n = points.size();
  FitSpline spline(knots);
  PointFit fit{std::vector<Vec>(n, points.front()), points}, best;
  for (Vec& off : fit.off) off = off - points.front();
  double least = 0, power = 2;
  for (int round = 0; round < rounds; ++round) {
    NormalEquations equations(spline.size());
    BasisRow value, slope;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t first = spline.basis(u[i], value, slope);
      const bool given = (i == 0 && begin_given) || (i + 1 == n && end_given);
      const Vec x = fit.at[i] - points.front();
      if (given) {
        equations.add(first, value, given_weight, points[i] - points.front());
      } else {
        const double weight =
            std::clamp(std::pow(norm(fit.off[i]) / (near * radius), power - 2), least_weight, largest_weight);
        equations.add(first, value, (power - 1) * weight, x + fit.off[i] / (power - 1));
      }
    }
    for (std::size_t i = 0; i + 4 < spline.size(); ++i) equations.add(i, spline.derivative(i, 4), snap, {});
    for (std::size_t i = 0; i + 4 < spline.size(); ++i) equations.add(i, spline.derivative(i, 2), acceleration, {});
    spline.set(equations.solve());
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [x, v] = spline.at(u[i]);
      const Vec off = points[i] - points.front() - x;
      const double v2 = dot(v, v), step = (knots.back() - knots.front()) / static_cast<double>(knots.size() - 1);
      const double along = v2 > 0 ? std::clamp(dot(off, v) / v2, -step / 2, step / 2) : 0;
      fit.at[i] = points.front() + x + along * v;
      fit.off[i] = v2 > 0 ? off - dot(off, v) / v2 * v : off;
      largest = std::max(largest, norm(fit.off[i]));
      if (i > 0 && i + 1 < n) u[i] = std::clamp(u[i] + along, u.front(), u.back());
    }
    if (round + 1 < first_rounds) continue;
    if (best.at.empty() || largest < least) best = fit, least = largest;
    if (largest < 2 * radius) power = std::min(growth * power, largest_power);
  }
  if (begin_given) best.at.front() = points.front();
  if (end_given) best.at.back() = points.back();
  return best;
}

}  // namespace bahnwerk
