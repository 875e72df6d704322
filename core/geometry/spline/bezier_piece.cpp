#include "core/geometry/spline/bezier_piece.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double binomial[spline_orders][spline_orders] = {
    {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};

HomogeneousPoint mixed(const HomogeneousPoint& a, const HomogeneousPoint& b, double v) {
  HomogeneousPoint r;
  for (std::size_t d = 0; d < r.size(); ++d) r[d] = (1 - v) * a[d] + v * b[d];
  return r;
}

}  // namespace

HomogeneousPoint homogeneous(const SplinePoint& p, double weight) {
  HomogeneousPoint h;
  for (std::size_t d = 0; d < spline_dimension; ++d) h[d] = weight * p[d];
  h[spline_dimension] = weight;
  return h;
}

SplinePoint projected(const HomogeneousPoint& p) {
  SplinePoint s;
  for (std::size_t d = 0; d < spline_dimension; ++d) s[d] = p[d] / p[spline_dimension];
  return s;
}

SplineJet projected(const HomogeneousJet& jet) {
  constexpr std::size_t w = spline_dimension;
  SplineJet s{};
  for (std::size_t n = 0; n < spline_orders; ++n)
    for (std::size_t d = 0; d < spline_dimension; ++d) {
      double rest = jet[n][d];
      for (std::size_t j = 1; j <= n; ++j) rest -= binomial[n][j] * jet[j][w] * s[n - j][d];
      s[n][d] = rest / jet[0][w];
    }
  return s;
}

BezierPiece::BezierPiece(std::vector<HomogeneousPoint> points) : points_(std::move(points)) {
  if (points_.size() < 2 || points_.size() > max_degree + 1)
    throw std::invalid_argument("Bézier piece of degree 1 to 9 needed");
  for (const auto& p : points_)
    if (!(p[spline_dimension] > 0)) throw std::invalid_argument("weights of a Bézier piece have to be positive");
}

BezierPiece BezierPiece::line(const SplinePoint& from, const SplinePoint& to) {
  return BezierPiece({homogeneous(from, 1), homogeneous(to, 1)});
}

HomogeneousJet BezierPiece::homogeneous_at(double v) const {
  const std::size_t p = degree();
  std::array<HomogeneousPoint, max_degree + 1> b;
  std::copy(points_.begin(), points_.end(), b.begin());
  HomogeneousJet jet{};
  // Level l of the scheme has p − l + 1 points; the derivative of order p − l is made of their differences.
  for (std::size_t l = 0; l <= p; ++l) {
    const std::size_t order = p - l;
    if (order < spline_orders) {
      double factor = 1;
      for (std::size_t i = 0; i < order; ++i) factor *= static_cast<double>(p - i);
      for (std::size_t j = 0; j <= order; ++j) {
        const double share = ((order - j) % 2 == 0 ? factor : -factor) * binomial[order][j];
        for (std::size_t d = 0; d < jet[order].size(); ++d) jet[order][d] += share * b[j][d];
      }
    }
    for (std::size_t j = 0; j + l < p; ++j) b[j] = mixed(b[j], b[j + 1], v);
  }
  return jet;
}

BezierPiece BezierPiece::elevated(std::size_t degree) const {
  if (degree < this->degree() || degree > max_degree)
    throw std::invalid_argument("degree below the piece's, or above 9");
  std::vector<HomogeneousPoint> points = points_;
  while (points.size() <= degree) {
    const std::size_t n = points.size();  // the new degree
    std::vector<HomogeneousPoint> next(n + 1);
    next.front() = points.front(), next.back() = points.back();
    for (std::size_t i = 1; i < n; ++i)
      next[i] = mixed(points[i], points[i - 1], static_cast<double>(i) / static_cast<double>(n));
    points = std::move(next);
  }
  return BezierPiece(std::move(points));
}

BezierPiece BezierPiece::scaled(double factor) const {
  std::vector<HomogeneousPoint> points = points_;
  for (auto& p : points)
    for (double& c : p) c *= factor;
  return BezierPiece(std::move(points));
}

}  // namespace bahnwerk
