#include "core/geometry/spline/nurbs_path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bahnwerk {
namespace {

HomogeneousPoint mixed(const HomogeneousPoint& a, const HomogeneousPoint& b, double share) {
  HomogeneousPoint r;
  for (std::size_t d = 0; d < r.size(); ++d) r[d] = (1 - share) * a[d] + share * b[d];
  return r;
}

/// Inserts one more knot u, which lies in [knots[k], knots[k + 1]).
void insert(NurbsPath& path, std::size_t k, double u) {
  const std::size_t p = path.degree;
  const std::vector<HomogeneousPoint> old = path.points;
  path.points.insert(path.points.begin() + static_cast<std::ptrdiff_t>(k), old[k]);
  for (std::size_t i = k - p + 1; i <= k; ++i) {
    const double low = path.knots[i], high = path.knots[i + p];
    path.points[i] = high > low ? mixed(old[i - 1], old[i], (u - low) / (high - low)) : old[i];
  }
  path.knots.insert(path.knots.begin() + static_cast<std::ptrdiff_t>(k) + 1, u);
}

}  // namespace

SplineJet NurbsPath::at(double u) const {
  const std::size_t p = degree;
  const auto after = std::upper_bound(knots.begin() + static_cast<std::ptrdiff_t>(p),
                                      knots.begin() + static_cast<std::ptrdiff_t>(points.size()), u);
  std::size_t k = static_cast<std::size_t>(after - knots.begin()) - 1;
  while (knots[k] == knots[k + 1]) --k;
  std::array<HomogeneousPoint, BezierPiece::max_degree + 1> q, b;
  for (std::size_t i = 0; i <= p; ++i) q[i] = points[k - p + i];
  HomogeneousJet jet{};
  for (std::size_t order = 0; order < std::min(spline_orders, p + 1); ++order) {
    // q[i], i = order … p, are control points of the derivative of this order, a spline of degree p − order.
    std::copy(q.begin(), q.end(), b.begin());
    for (std::size_t l = order + 1; l <= p; ++l)
      for (std::size_t i = p; i >= l; --i) {
        const std::size_t low = k - p + i, high = k + 1 + i - l;
        b[i] = mixed(b[i - 1], b[i], (u - knots[low]) / (knots[high] - knots[low]));
      }
    jet[order] = b[p];
    for (std::size_t i = p; i > order; --i) {
      const double width = knots[k + i - order] - knots[k - p + i];
      for (std::size_t d = 0; d < q[i].size(); ++d)
        q[i][d] = static_cast<double>(p - order) * (q[i][d] - q[i - 1][d]) / width;
    }
  }
  return projected(jet);
}

std::vector<BezierPiece> NurbsPath::pieces() const {
  NurbsPath full = *this;
  const std::size_t p = degree;
  for (std::size_t k = p; k + 1 < full.knots.size();) {
    std::size_t last = k;  // last of the knots equal to knots[k]
    while (last + 1 < full.knots.size() && full.knots[last + 1] == full.knots[k]) ++last;
    if (last + 1 == full.knots.size()) break;
    std::size_t times = last - k + 1;
    if (k > p)
      for (; times < p; ++times, ++last) insert(full, last, full.knots[last]);
    k = last + 1;
  }
  std::vector<BezierPiece> pieces;
  for (std::size_t i = 0; i + p < full.points.size(); i += p)
    pieces.emplace_back(std::vector<HomogeneousPoint>(full.points.begin() + static_cast<std::ptrdiff_t>(i),
                                                      full.points.begin() + static_cast<std::ptrdiff_t>(i + p + 1)));
  return pieces;
}

NurbsPath united(std::span<const BezierPiece> pieces) {
  if (pieces.empty()) throw std::invalid_argument("a path needs pieces");
  NurbsPath path;
  for (const auto& piece : pieces) path.degree = std::max(path.degree, piece.degree());
  path.points.reserve(pieces.size() * path.degree + 1);
  path.knots.assign(path.degree + 1, 0.0);
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    BezierPiece piece = pieces[n].elevated(path.degree);
    if (n > 0) {
      const auto& last = path.points.back();
      const auto& first = piece.points().front();
      const SplinePoint before = projected(last), after = projected(first);
      for (std::size_t d = 0; d < spline_dimension; ++d)
        if (!(std::abs(before[d] - after[d]) <= 1e-9)) throw std::invalid_argument("pieces do not meet");
      if (last[spline_dimension] != first[spline_dimension])
        piece = piece.scaled(last[spline_dimension] / first[spline_dimension]);
      path.knots.insert(path.knots.end(), path.degree, static_cast<double>(n));
    }
    path.points.insert(path.points.end(), piece.points().begin() + (n > 0 ? 1 : 0), piece.points().end());
  }
  path.knots.insert(path.knots.end(), path.degree + 1, static_cast<double>(pieces.size()));
  return path;
}

}  // namespace bahnwerk
