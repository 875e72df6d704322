#pragma once
/// What the spline tests share: random pieces, joints judged by derivatives by arc length.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/geometry/spline/reparametrise.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::testing {

inline double size(const SplinePoint& a) {
  double sum = 0;
  for (const double c : a) sum += c * c;
  return std::sqrt(sum);
}
inline double distance(const SplinePoint& a, const SplinePoint& b) {
  SplinePoint d{};
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = a[i] - b[i];
  return size(d);
}

inline SplinePoint random_pose(Random& random, double extent = 100) {
  SplinePoint p{};
  for (std::size_t d = 0; d < p.size(); ++d) p[d] = random.uniform(-1, 1) * (d < 3 ? extent : 3.0);
  return p;
}
inline BezierPiece random_piece(Random& random, std::size_t degree) {
  std::vector<HomogeneousPoint> points;
  for (std::size_t i = 0; i <= degree; ++i) points.push_back(homogeneous(random_pose(random), random.uniform(0.3, 3)));
  return BezierPiece(std::move(points));
}

/// Largest size of each derivative by arc length over the pieces: what continuity is relative to.
inline std::array<double, spline_orders> peaks(std::span<const BezierPiece> pieces) {
  std::array<double, spline_orders> peak{};
  for (const auto& piece : pieces)
    for (int i = 0; i <= 64; ++i) {
      const SplineJet jet = by_length(piece.at(i / 64.0));
      for (std::size_t n = 0; n < spline_orders; ++n) peak[n] = std::max(peak[n], size(jet[n]));
    }
  return peak;
}

/// Jump of the derivative of order n by arc length from the end of one piece to the beginning of the next, all five
/// coordinates, relative to `scale`.
inline double jump(const BezierPiece& before, const BezierPiece& after, std::size_t n, double scale) {
  return distance(by_length(before.at(1))[n], by_length(after.at(0))[n]) / scale;
}

}  // namespace bahnwerk::testing
