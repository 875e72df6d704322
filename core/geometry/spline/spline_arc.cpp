#include "core/geometry/spline/spline_arc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/geometry/spline/end_conditions.hpp"
#include "core/geometry/spline/reparametrise.hpp"

namespace bahnwerk {
namespace {

/// Bézier points of w·q, q from 0 to 1 in proportion to the angle on a piece of `alpha`, with k right derivatives at
/// both ends.
std::vector<double> turn_points(double alpha, std::size_t k) {
  const double c = std::cos(alpha / 2);
  const Series weight = Series::from(1, 2 * c - 2, 4 - 4 * c);
  // The angle of a point on this parametrisation of the circle has the derivative 2 sin(α/2)/w(v).
  const Series slope = Series(2 * std::sin(alpha / 2) / alpha) / weight;
  Series q;
  for (std::size_t n = 1; n < spline_orders; ++n) q.c[n] = slope.c[n - 1] / static_cast<double>(n);
  const Series first = weight * q, last = weight * (Series(1) - q);  // the piece is symmetric
  std::array<double, spline_orders> a{}, b{};
  for (std::size_t n = 0; n < spline_orders; ++n) a[n] = first.derivative(n), b[n] = last.derivative(n);
  const std::size_t degree = 2 * k + 1;
  std::vector<double> points(degree + 1);
  for (std::size_t i = 0; i <= k; ++i) {
    points[i] = end_point(a, degree, i);
    points[degree - i] = end_point(b, degree, i);
  }
  return points;
}

}  // namespace

std::vector<BezierPiece> spline_arc(const SplinePoint& from, Vec centre, Vec normal, double sweep,
                                    const SplinePoint& change, std::size_t continuity) {
  const double size = norm(normal);
  if (!(size > 0) || !(std::abs(sweep) > 0) || continuity < 1 || continuity + 1 > spline_orders)
    throw std::invalid_argument("an arc needs a normal, a sweep and a continuity of 1 to 4");
  const Vec n = normal / size, radius = place(from) - centre, axial = dot(radius, n) * n;
  const Vec e1 = radius - axial, e2 = cross(n, e1);
  if (!(norm(e1) > 0)) throw std::invalid_argument("an arc needs a radius");
  const Vec middle = centre + axial;
  const double quarters = std::abs(sweep) / (std::numbers::pi / 2);
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(quarters - 1e-12)));
  const double alpha = sweep / static_cast<double>(count), c = std::cos(alpha / 2);
  const bool plain = change[2] == 0 && change[3] == 0 && change[4] == 0;
  const std::size_t degree = plain ? 2 : 2 * continuity + 1;
  const std::vector<double> turn = plain ? std::vector<double>() : turn_points(std::abs(alpha), continuity);

  std::vector<BezierPiece> pieces;
  pieces.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count);
    const auto on_circle = [&](double angle, double factor) {
      return middle + factor * (std::cos(angle) * e1 + std::sin(angle) * e2);
    };
    const double a = static_cast<double>(i) * alpha, b = static_cast<double>(i + 1) * alpha;
    // Both ends are computed from their own angle, so that neighbours have equal bits. The tangents meet at 1/cos.
    const Vec corners[3] = {i == 0 ? place(from) : on_circle(a, 1), on_circle((a + b) / 2, 1 / c), on_circle(b, 1)};
    std::vector<HomogeneousPoint> points;
    for (std::size_t j = 0; j < 3; ++j)
      points.push_back(homogeneous({corners[j].x, corners[j].y, corners[j].z, from[3], from[4]}, j == 1 ? c : 1.0));
    BezierPiece piece(std::move(points));
    if (!plain) {
      auto full = piece.elevated(degree).points();
      for (std::size_t j = 0; j <= degree; ++j) {
        const double share = part * full[j][spline_dimension] + turn[j] / static_cast<double>(count);
        for (std::size_t d = 0; d < 3; ++d) full[j][d] += share * change[2] * n[d];
        for (std::size_t d = 3; d < spline_dimension; ++d) full[j][d] += share * change[d];
      }
      piece = BezierPiece(std::move(full));
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace bahnwerk
