#include "core/verify/law/channel_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/numeric/peak.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
constexpr double lebesgue = 2.6;  // largest Lebesgue constant of interpolation in up to 13 Chebyshev points

double square(double x) { return x * x; }

constexpr double farthest = 1024;  // half widths of the largest reach that is used

}  // namespace

ChannelBounds bounds_over_parameter(double fastest, double a, double half, const CurveDisc& disc, int points,
                                    bool even) {
  const double error = half > 0 ? interpolation_error(points, disc.radius / half) : unknown;
  if (!(error < unknown)) return {unknown, unknown, unknown};
  const double h1 = disc.first, h2 = disc.second, h3 = disc.third, A = std::abs(a);
  const double b = fastest + 2 * A * disc.speed * disc.radius, jerk = h3 * b + 3 * h2 * A;
  ChannelBounds bounds{error * h1 * h1 * b, error * (h2 * b + h1 * A), error * b * jerk * jerk};
  if (!even) {
    // Both the part of the integral and the whole that it is scaled with may lack as much.
    const double off = lebesgue * 2 * A * 2 * (2 * half * error * disc.speed);
    bounds[0] += off * h1 * h1;
    bounds[1] += off * h2;
    bounds[2] += off * jerk * (jerk + 2 * b * h3);
  }
  return bounds;
}

ChannelBounds bounds_from_rest(double a, double half, const CurveDisc& disc, std::size_t vanishing) {
  const ChebyshevRule& rule = open_rule();
  const double reach = half > 0 ? disc.radius / half - 1 : 0;  // about the interval's middle
  const double error = interpolation_error(rule.points, reach);
  if (!(error < unknown)) return {unknown, unknown, unknown};
  const double h1 = disc.first, h2 = disc.second, h3 = disc.third, A = std::abs(a);
  const double b = 2 * A * disc.speed * disc.radius, jerk = h3 * b + 3 * h2 * A;
  ChannelBounds bounds{error * h1 * h1 * b, error * (h2 * b + h1 * A), error * b * jerk * jerk};
  // s at the points is integrated (see above). At the first of them the derivatives are larger by the factor of their
  // poles.
  const double off = lebesgue * 2 * A * 2 * (2 * half * error * disc.speed);
  const double nearer = disc.radius / (2 * half * rule.node[0]), m = static_cast<double>(vanishing);
  const double g2 = h2 * std::pow(nearer, m), g3 = h3 * std::pow(nearer, 2 * m + 1), g = g3 * b + 3 * g2 * A;
  bounds[0] += off * h1 * h1;
  bounds[1] += off * g2;
  bounds[2] += off * g * (g + 2 * b * g3);
  if (vanishing > 1) bounds[2] = unknown;
  return bounds;
}

LawPiece moved(const LawPiece& piece, double tau) {
  const LawState x = piece.at(tau);
  LawPiece p = piece;
  p.s = x.s, p.v = x.v, p.a = x.a, p.j = x.j;
  return p;
}

namespace {

/// Returns bounds of functions whose magnitudes are `sizes(S, V, A, J)` for a law with at most this length, speed,
/// acceleration and jerk.
template <std::size_t n, class Sizes>
std::array<double, n> best_over_time(const LawPiece& piece, double half, const CurveDisc& disc, int points,
                                     Sizes&& sizes) {
  std::array<double, n> bounds;
  bounds.fill(unknown);
  if (!(half > 0) || !(disc.radius > 0)) return bounds;
  const double way = disc.radius / disc.pace;
  const double v = std::abs(piece.v), a = std::abs(piece.a), j = std::abs(piece.j), q = std::abs(piece.snap);
  const auto moves = [&](double r) { return r * (v + r * (a / 2 + r * (j / 6 + r * q / 24))); };
  // The further out, the quicker the error falls and the larger law and curve may be: from the disc's border on, for as
  // long as any bound gets better. Up to there S, which is convex, is at most four times as large where no part of it
  // reaches the border alone.
  double reach = std::min(2 * way / (v + std::sqrt(v * v + 2 * a * way)), farthest * half);
  if (moves(reach) > 2 * way) reach = std::min({reach, std::cbrt(6 * way / j), std::sqrt(std::sqrt(24 * way / q))});
  if (const double S = moves(reach); S > way) reach *= way / S;
  reach *= (1 - 1e-12) / half;
  for (; reach > 1; reach *= 0.5) {
    const double error = interpolation_error(points, reach), r = reach * half, S = moves(r);
    const double V = v + r * (a + r * (j / 2 + r * q / 6)), A = a + r * (j + r * q / 2), J = j + r * q;
    const std::array<double, n> here = sizes(S, V, A, J);
    bool better = false;
    for (std::size_t c = 0; c < n; ++c)
      if (error * here[c] < bounds[c]) bounds[c] = error * here[c], better = true;
    if (!better) break;
  }
  return bounds;
}

}  // namespace

ChannelBounds bounds_over_time(const LawPiece& piece, double half, const CurveDisc& disc, int points) {
  const double h1 = disc.first, h2 = disc.second, h3 = disc.third;
  return best_over_time<3>(piece, half, disc, points, [&](double, double V, double A, double J) {
    return ChannelBounds{square(h1 * V), h2 * V * V + h1 * A, square(h3 * V * V * V + 3 * h2 * V * A + h1 * J)};
  });
}

StateBounds state_bounds_over_time(const LawPiece& piece, double half, const CurveDisc& disc, int points) {
  const double h1 = disc.first, h2 = disc.second, h3 = disc.third;
  return best_over_time<4>(piece, half, disc, points, [&](double S, double V, double A, double J) {
    return StateBounds{h1 * S, h1 * V, h2 * V * V + h1 * A, h3 * V * V * V + 3 * h2 * V * A + h1 * J};
  });
}

}  // namespace bahnwerk::verify
