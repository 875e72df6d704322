#include "core/drawing/spline_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/gauss_legendre.hpp"

namespace bahnwerk {
namespace {

constexpr int deepest = 14;

struct Sampler {
  const BezierPiece& piece;
  double tolerance, angle_tolerance;
  std::vector<SplinePoint>& points;

  SplinePoint at(double v) const { return piece.at(v)[0]; }
  /// Tells whether `p` is farther than the tolerance from the straight line from a to b. Angles are compared at its
  /// foot on the line or, if a equals b, at the share of the parameter.
  bool off(const SplinePoint& p, const SplinePoint& a, const SplinePoint& b, double share) const {
    const Vec way = place(b) - place(a), from = place(p) - place(a);
    const double length = norm(way), beside = length > 0 ? norm(cross(way, from)) / length : norm(from);
    if (!(beside <= tolerance)) return true;
    if (length > 1e-9) share = dot(way, from) / (length * length);
    for (std::size_t d = 3; d < spline_dimension; ++d)
      if (!(std::abs(p[d] - a[d] - share * (b[d] - a[d])) <= angle_tolerance)) return true;
    return false;
  }
  void between(double v0, const SplinePoint& a, double v1, const SplinePoint& b, int depth) const {
    const double v = (v0 + v1) / 2;
    const SplinePoint middle = at(v);
    const bool curved =
        off(middle, a, b, 0.5) || off(at((v0 + v) / 2), a, b, 0.25) || off(at((v + v1) / 2), a, b, 0.75);
    if (curved && depth < deepest) {
      between(v0, a, v, middle, depth + 1);
      between(v, middle, v1, b, depth + 1);
      return;
    }
    points.push_back(b);
  }
};

}  // namespace

std::vector<SplinePoint> spline_points(std::span<const BezierPiece> pieces, double tolerance, double angle_tolerance) {
  std::vector<SplinePoint> points;
  for (const BezierPiece& piece : pieces) {
    const SplinePoint from = piece.at(0)[0], to = piece.at(1)[0];
    const bool joined = !points.empty() && std::equal(from.begin(), from.end(), points.back().begin(),
                                                      [](double a, double b) { return std::abs(a - b) <= 1e-9; });
    if (!joined) points.push_back(from);
    Sampler{piece, tolerance, angle_tolerance, points}.between(0, from, 1, to, 0);
  }
  return points;
}

std::vector<CurvaturePoint> curvature_points(std::span<const BezierPiece> pieces, std::size_t intervals) {
  const std::size_t n = std::max<std::size_t>(1, intervals);
  std::vector<CurvaturePoint> points;
  points.reserve(pieces.size() * (n + 1));
  double length = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (std::size_t i = 0; i <= n; ++i) {
      const double width = 1 / static_cast<double>(n), v = static_cast<double>(i) * width;
      if (i > 0)
        for (const GaussPoint& g : gauss_legendre<5>())
          length += g.weight / 2 * width * norm(place(pieces[k].at(v - width / 2 + g.place * width / 2)[1]));
      const SplineJet jet = pieces[k].at(v);
      const Vec first = place(jet[1]);
      const double speed = norm(first);
      points.push_back({length, speed > 0 ? norm(cross(first, place(jet[2]))) / (speed * speed * speed) : 0.0, k});
    }
  return points;
}

}  // namespace bahnwerk
