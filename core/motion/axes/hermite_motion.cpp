#include "core/motion/axes/hermite_motion.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace bahnwerk {
namespace {

// Along a curve positions are known to 1e-10 of its length: over shorter times their differences would say more about
// that than about the acceleration.
constexpr double position_counts = 2e-4;  // s
constexpr double velocity_counts = 1e-6;  // s

bool still(const MotionState& x, std::size_t k) { return x[1][k] == 0 && x[2][k] == 0; }

Polynomial quintic(double h, double x0, double v0, double a0, double x1, double v1, double a1) {
  if (h < velocity_counts) return {x0, v0, 0.5 * a0, (a1 - a0) / (6 * h)};
  if (h < position_counts) {
    const double rest = (v1 - v0 - h * a0) / (h * h), change = (a1 - a0) / h;
    return {x0, v0, 0.5 * a0, rest - change / 3, (0.5 * change - rest) / (2 * h)};
  }
  const double dx = x1 - x0 - h * (v0 + 0.5 * h * a0), dv = h * (v1 - v0 - h * a0), da = h * h * (a1 - a0);
  const double h3 = h * h * h;
  return {x0,
          v0,
          0.5 * a0,
          (10 * dx - 4 * dv + 0.5 * da) / h3,
          (-15 * dx + 7 * dv - da) / (h3 * h),
          (6 * dx - 3 * dv + 0.5 * da) / (h3 * h * h)};
}

}  // namespace

void join(const SplineMotion::Piece& before, double duration, std::size_t first, MotionState& state) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  for (std::size_t k = 0; k < before.axes.size(); ++k) {
    const auto take = [&](const Polynomial& p, double& value) {
      double terms = 0, power = 1;
      for (const double c : p) terms += std::abs(c) * power, power *= duration;
      if (const double end = evaluate(p, duration); !(std::abs(end - value) <= rounding * terms)) value = end;
    };
    take(before.axes[k], state[0][first + k]);
    take(derivative(before.axes[k]), state[1][first + k]);
  }
}

Polynomial hermite_quintic(double h, const MotionState& left, const MotionState& right, std::size_t k) {
  if (still(left, k) && still(right, k) && left[0][k] == right[0][k]) return {left[0][k]};
  return quintic(h, left[0][k], left[1][k], left[2][k], right[0][k], right[1][k], right[2][k]);
}

SplineMotion hermite_motion(const Motion& motion, std::size_t first, std::size_t last, double longest) {
  std::vector<SplineMotion::Piece> pieces;
  for (std::size_t i = 0; i < motion.pieces(); ++i) {
    const double begin = motion.begin(i), duration = motion.end(i) - begin;
    if (!(duration > 0)) continue;
    const auto parts = static_cast<std::size_t>(std::ceil(std::fmax(1.0, duration / longest)));
    MotionState left = motion.in_piece(i, begin);
    double t = begin;
    for (std::size_t part = 1; part <= parts; ++part) {
      const double end =
          part == parts ? motion.end(i) : begin + duration * static_cast<double>(part) / static_cast<double>(parts);
      const MotionState right = motion.in_piece(i, end);
      if (!(end > t)) continue;
      SplineMotion::Piece piece{end, {}};
      if (!pieces.empty())
        join(pieces.back(), t - (pieces.size() > 1 ? pieces[pieces.size() - 2].end : 0), first, left);
      for (std::size_t k = first; k < last; ++k) piece.axes.push_back(hermite_quintic(end - t, left, right, k));
      pieces.push_back(std::move(piece));
      left = right;
      t = end;
    }
  }
  return SplineMotion(std::move(pieces));
}

}  // namespace bahnwerk
