#include "core/probe/optimal/point_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/numeric/linear/symmetric_band.hpp"

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

  /// Returns the derivatives of orders 1 to 3 at u [de Boor].
  std::array<Vec, 3> derivatives(double u) const {
    const std::size_t k = span(u);
    std::array<Vec, degree + 1> c;
    std::copy_n(c_.begin() + static_cast<std::ptrdiff_t>(k - degree), degree + 1, c.begin());
    std::array<Vec, 3> out;
    for (std::size_t order = 1; order <= 3; ++order) {
      const std::size_t p = degree - order;
      // c[j] belongs to the knots t_(k−p+j) … t_(k+1+j).
      for (std::size_t j = 0; j <= p; ++j)
        c[j] = static_cast<double>(p + 1) / (t_[k + 1 + j] - t_[k - p + j]) * (c[j + 1] - c[j]);
      std::array<Vec, degree + 1> d = c;
      for (std::size_t r = 1; r <= p; ++r)
        for (std::size_t j = p; j >= r; --j) {
          const double low = t_[k - p + j], high = t_[k + 1 + j - r];
          d[j] = d[j - 1] + (u - low) / (high - low) * (d[j] - d[j - 1]);
        }
      out[order - 1] = d[p];
    }
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
    const std::size_t k = span(u);
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
  // Returns k with t_k ≤ u < t_(k+1).
  std::size_t span(double u) const {
    const auto inner = static_cast<std::ptrdiff_t>(degree) + 1;
    return static_cast<std::size_t>(std::upper_bound(t_.begin() + inner, t_.end() - inner, u) - t_.begin()) - 1;
  }

  std::vector<double> t_;
  std::vector<Vec> c_;
};

/// Normal equations of a band. Unknowns are the coordinates of the coefficients in turn.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t n) : a_(3 * n), b_(3 * n, 0.0) {}
  /// Adds weight · |Σ row_i c_(first + i) − value|², with distances along the unit vector `u` counted by `share` alone.
  template <std::size_t N>
  void add(std::size_t first, const std::array<double, N>& row, double weight, Vec value, Vec u = {},
           double share = 1) {
    const Vec target = weight * (value - (1 - share) * dot(u, value) * u);
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t e = 0; e < 3; ++e) {
        const double metric = weight * ((d == e ? 1.0 : 0.0) - (1 - share) * u[d] * u[e]);
        if (metric == 0) continue;
        for (std::size_t i = 0; i < N; ++i)
          for (std::size_t j = 0; j <= i; ++j)
            if (3 * i + d >= 3 * j + e) a_.at(3 * (first + i) + d, 3 * (first + j) + e) += metric * row[i] * row[j];
      }
      for (std::size_t i = 0; i < N; ++i) b_[3 * (first + i) + d] += row[i] * target[d];
    }
  }
  std::vector<Vec> solve() {
    a_.factor();
    a_.solve(b_);
    std::vector<Vec> out(b_.size() / 3);
    for (std::size_t i = 0; i < b_.size(); ++i) out[i / 3][i % 3] = b_[i];
    return out;
  }

 private:
  SymmetricBand<3 * (degree + 1) - 1> a_;
  std::vector<double> b_;
};

}  // namespace

PointFit fit_points(const std::vector<Vec>& points, std::vector<double> u, double radius,
                    const std::vector<double>& knots, bool begin_given, bool end_given) {
  constexpr int rounds = 20, first_rounds = 3;  // parameters settle in the first ones
  constexpr double largest_power = 100, growth = 1.5, near = 0.95;
  constexpr double least_weight = 1e-3, given_weight = 1e6, snap = 1e-5, acceleration = 1e-8;
  constexpr double along_share = 1e-2;  // weight of distances along the curve
  const std::size_t n = points.size();
  FitSpline spline(knots);
  PointFit fit{std::vector<Vec>(n, points.front()), points, u, {}}, best;
  FitSpline nearest = spline;
  for (Vec& off : fit.off) off = off - points.front();
  std::vector<Vec> direction(n);  // directions of the curve
  double least = 0, power = 2, scale = radius;
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
        const double weight = std::max(std::pow(norm(fit.off[i]) / scale, power - 2), least_weight);
        equations.add(first, value, (power - 1) * weight, x + fit.off[i] / (power - 1), direction[i],
                      round > 0 ? along_share : 1);
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
      direction[i] = v2 > 0 ? v / std::sqrt(v2) : Vec{};
      fit.off[i] = off - dot(off, direction[i]) * direction[i];
      largest = std::max(largest, norm(fit.off[i]));
      if (i > 0 && i + 1 < n) u[i] = std::clamp(u[i] + along, u.front(), u.back());
    }
    scale = std::max(largest, near * radius);
    if (round + 1 < first_rounds) continue;
    if (best.at.empty() || largest < least) best = fit, best.along = u, nearest = spline, least = largest;
    if (largest < 2 * radius) power = std::min(growth * power, largest_power);
  }
  if (begin_given) best.at.front() = points.front();
  if (end_given) best.at.back() = points.back();
  for (double at : best.along) best.derivative.push_back(nearest.derivatives(at));
  return best;
}

}  // namespace bahnwerk
