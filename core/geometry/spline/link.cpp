#include "core/geometry/spline/link.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/geometry/spline/basis_row.hpp"

namespace bahnwerk {
namespace {

constexpr double binomial[spline_orders][spline_orders] = {
    {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};

/// Gauss–Jordan with pivoting by rows; a few numbers, once per basis.
std::vector<double> inverted(std::vector<double> a, std::size_t n) {
  std::vector<double> b(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) b[i * n + i] = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(a[r * n + c]) > std::abs(a[pivot * n + c])) pivot = r;
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(a[c * n + j], a[pivot * n + j]);
      std::swap(b[c * n + j], b[pivot * n + j]);
    }
    const double scale = 1 / a[c * n + c];
    for (std::size_t j = 0; j < n; ++j) a[c * n + j] *= scale, b[c * n + j] *= scale;
    for (std::size_t r = 0; r < n; ++r) {
      const double factor = a[r * n + c];
      if (r == c || factor == 0) continue;
      for (std::size_t j = 0; j < n; ++j) a[r * n + j] -= factor * a[c * n + j], b[r * n + j] -= factor * b[c * n + j];
    }
  }
  return b;
}

double condition_of(const LinkBasis& basis, std::size_t condition, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < basis.size(); ++i) sum += basis.row(condition, i) * values[i];
  return sum;
}

/// Which weights the shape has, checked.
std::vector<double> weights_of(const LinkBasis& basis, const LinkEnds& ends, const LinkShape& shape) {
  if (ends.via.has_value() != (basis.via() > 0)) throw std::invalid_argument("a place on the way and knots for it");
  if (!(shape.before[0] > 0) || !(shape.after[0] > 0)) throw std::invalid_argument("β₁ has to be positive");
  if (shape.weights.empty()) return std::vector<double>(basis.size(), 1.0);
  if (shape.weights.size() != basis.size() ||
      !std::all_of(shape.weights.begin(), shape.weights.end(), [](double w) { return w > 0; }))
    throw std::invalid_argument("a positive weight per control point");
  return shape.weights;
}

/// Row of a condition: derivatives 0 … k at 0, two at via, then k … 0 at 1.
std::size_t before_row(std::size_t order) { return order; }
std::size_t after_row(const LinkBasis& basis, std::size_t order) { return basis.size() - 1 - order; }

/// Homogeneous derivative of order n from those of weight and curve (Leibniz).
template <class Row>
HomogeneousPoint product(const SplineJet& curve, std::size_t n, Row&& weight) {
  HomogeneousPoint h{};
  for (std::size_t j = 0; j <= n; ++j) {
    const double w = binomial[n][j] * weight(j);
    for (std::size_t d = 0; d < spline_dimension; ++d) h[d] += w * curve[n - j][d];
  }
  return h;
}

std::vector<HomogeneousPoint> solved(const LinkBasis& basis, const std::vector<HomogeneousPoint>& conditions) {
  std::vector<HomogeneousPoint> points(basis.size(), HomogeneousPoint{});
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (std::size_t c = 0; c < basis.size(); ++c)
      for (std::size_t d = 0; d < spline_dimension; ++d) points[i][d] += basis.inverse(i, c) * conditions[c][d];
  return points;
}

}  // namespace

LinkBasis::LinkBasis(std::size_t continuity, double via)
    : continuity_(continuity), size_(2 * continuity + 2 + (via > 0 ? 2 : 0)), via_(via) {
  if (continuity < 1 || continuity >= spline_orders || !(via >= 0 && via < 1))
    throw std::invalid_argument("a link needs a continuity of 1 to 4 and a place within it");
  knots_.assign(degree() + 1, 0.0);
  if (via > 0) knots_.insert(knots_.end(), 2, via);
  knots_.insert(knots_.end(), degree() + 1, 1.0);
  const auto add = [&](std::size_t order, double u) {
    const auto row = basis_row(knots_, degree(), order, u);
    rows_.insert(rows_.end(), row.begin(), row.end());
  };
  for (std::size_t n = 0; n <= continuity; ++n) add(n, 0);
  if (via > 0) add(0, via), add(1, via);
  for (std::size_t n = continuity + 1; n-- > 0;) add(n, 1);
  inverse_ = inverted(rows_, size_);
}

NurbsPath link(const LinkBasis& basis, const LinkEnds& ends, const LinkShape& shape) {
  const std::vector<double> weights = weights_of(basis, ends, shape);
  const std::size_t k = basis.continuity();
  const SplineJet before = reparametrised(ends.before, inverse_change(shape.before)),
                  after = reparametrised(ends.after, inverse_change(shape.after));
  std::vector<HomogeneousPoint> conditions(basis.size());
  for (std::size_t n = 0; n <= k; ++n) {
    conditions[before_row(n)] =
        product(before, n, [&](std::size_t j) { return condition_of(basis, before_row(j), weights); });
    conditions[after_row(basis, n)] =
        product(after, n, [&](std::size_t j) { return condition_of(basis, after_row(basis, j), weights); });
  }
  if (ends.via) {
    const SplineJet middle{ends.via->point, ends.via->tangent};
    for (std::size_t n = 0; n < 2; ++n)
      conditions[k + 1 + n] =
          product(middle, n, [&](std::size_t j) { return condition_of(basis, k + 1 + j, weights); });
  }
  NurbsPath path{basis.degree(), solved(basis, conditions), basis.knots()};
  for (std::size_t i = 0; i < basis.size(); ++i) path.points[i][spline_dimension] = weights[i];
  // The ends without the round-off of the solution: neighbours share their points.
  path.points.front() = homogeneous(before[0], weights.front());
  path.points.back() = homogeneous(after[0], weights.back());
  return path;
}

std::vector<double> inherited_weights(const LinkBasis& basis, const std::array<double, spline_orders>& before,
                                      const std::array<double, spline_orders>& after, const LinkShape& shape) {
  const std::size_t k = basis.continuity();
  const auto first = reparametrised(before, inverse_change(shape.before)),
             last = reparametrised(after, inverse_change(shape.after));
  std::vector<double> conditions(basis.size(), 0.0), weights(basis.size(), 0.0);
  for (std::size_t n = 0; n <= k; ++n) conditions[before_row(n)] = first[n], conditions[after_row(basis, n)] = last[n];
  if (basis.via() > 0) conditions[k + 1] = 1;
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (std::size_t c = 0; c < basis.size(); ++c) weights[i] += basis.inverse(i, c) * conditions[c];
  return weights;
}

std::vector<std::vector<HomogeneousPoint>> link_derivatives(const LinkBasis& basis, const LinkEnds& ends,
                                                            const LinkShape& shape) {
  const std::vector<double> weights = weights_of(basis, ends, shape);
  const std::size_t k = basis.continuity();
  std::vector<std::vector<HomogeneousPoint>> result;
  result.reserve(2 * k);
  for (const bool first : {true, false}) {
    const Series change = inverse_change(first ? shape.before : shape.after);
    const SplineJet curve = reparametrised(first ? ends.before : ends.after, change);
    const auto row = [&](std::size_t n) { return first ? before_row(n) : after_row(basis, n); };
    for (std::size_t j = 1; j <= k; ++j) {
      const SplineJet slope = beta_derivative(curve, change, j);
      std::vector<HomogeneousPoint> conditions(basis.size(), HomogeneousPoint{});
      for (std::size_t n = 0; n <= k; ++n)
        conditions[row(n)] = product(slope, n, [&](std::size_t i) { return condition_of(basis, row(i), weights); });
      result.push_back(solved(basis, conditions));
    }
  }
  return result;
}

}  // namespace bahnwerk
