#include "core/geometry/spline/link.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/geometry/spline/end_conditions.hpp"

namespace bahnwerk {
namespace {

constexpr double binomial[spline_orders][spline_orders] = {
    {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};

void check(std::size_t continuity, const LinkShape& shape) {
  if (continuity < 1 || continuity >= spline_orders) throw std::invalid_argument("a link needs a continuity of 1 to 4");
  if (!(shape.before[0] > 0) || !(shape.after[0] > 0)) throw std::invalid_argument("β₁ has to be positive");
  if (shape.weights.empty()) return;
  if (shape.weights.size() != link_points(continuity) ||
      !std::all_of(shape.weights.begin(), shape.weights.end(), [](double w) { return w > 0; }))
    throw std::invalid_argument("a positive weight per control point");
}

/// One end of a link. At the last end everything counts from there: control points backwards, derivatives by 1 − v.
struct End {
  std::size_t continuity;
  bool last;
  std::size_t degree = 2 * continuity + 1;

  std::size_t point(std::size_t i) const { return last ? degree - i : i; }
  double sign(std::size_t order) const { return last && order % 2 == 1 ? -1 : 1; }

  /// Derivatives 0 … k of the weight, from this end on.
  std::array<double, spline_orders> weights(const std::vector<double>& points) const {
    std::array<double, spline_orders> w{1};
    if (points.empty()) return w;
    double falling = 1;  // p!/(p − n)!
    for (std::size_t n = 0; n <= continuity; ++n) {
      w[n] = 0;
      for (std::size_t i = 0; i <= n; ++i)
        w[n] += ((n - i) % 2 == 0 ? 1 : -1) * binomial[n][i] * points[point(i)] * falling;
      falling *= static_cast<double>(degree - n);
    }
    return w;
  }
};

}  // namespace

BezierPiece link(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape) {
  check(continuity, shape);
  std::vector<HomogeneousPoint> points(link_points(continuity));
  for (const bool last : {false, true}) {
    const End end{continuity, last};
    const SplineJet curve =
        reparametrised(last ? ends.after : ends.before, inverse_change(last ? shape.after : shape.before));
    const auto weight = end.weights(shape.weights);
    for (std::size_t d = 0; d < spline_dimension; ++d) {
      std::array<double, spline_orders> product{};  // derivatives of weight times curve, by Leibniz
      for (std::size_t n = 0; n <= continuity; ++n)
        for (std::size_t j = 0; j <= n; ++j)
          product[n] += binomial[n][j] * weight[j] * end.sign(n - j) * curve[n - j][d];
      for (std::size_t i = 0; i <= continuity; ++i) points[end.point(i)][d] = end_point(product, end.degree, i);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i][spline_dimension] = shape.weights.empty() ? 1.0 : shape.weights[i];
  return BezierPiece(std::move(points));
}

void link_gradient(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape, std::span<const Vec> by_points,
                   std::span<double> gradient) {
  check(continuity, shape);
  if (by_points.size() != link_points(continuity) || gradient.size() != 2 * continuity)
    throw std::invalid_argument("a gradient by the control points and one by the betas");
  for (const bool last : {false, true}) {
    const End end{continuity, last};
    const Series change = inverse_change(last ? shape.after : shape.before);
    const SplineJet curve = reparametrised(last ? ends.after : ends.before, change);
    const auto weight = end.weights(shape.weights);
    // Gradients by the derivatives of weight times curve, then by those of the curve, both from this end on.
    std::array<Vec, spline_orders> by_product{}, by_curve{};
    for (std::size_t n = 0; n <= continuity; ++n) {
      std::array<double, spline_orders> unit{};
      unit[n] = 1;
      for (std::size_t i = n; i <= continuity; ++i)
        by_product[n] += end_point(unit, end.degree, i) * by_points[end.point(i)];
      for (std::size_t j = 0; j <= n; ++j)
        by_curve[n - j] += binomial[n][j] * weight[j] * end.sign(n - j) * by_product[n];
    }
    for (std::size_t j = 1; j <= continuity; ++j) {
      const SplineJet slope = beta_derivative(curve, change, j);
      double sum = 0;
      for (std::size_t n = 0; n <= continuity; ++n) sum += dot(by_curve[n], place(slope[n]));
      gradient[(last ? continuity : 0) + j - 1] = sum;
    }
  }
}

}  // namespace bahnwerk
