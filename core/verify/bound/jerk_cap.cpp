#include "core/verify/bound/jerk_cap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double give = 1 + 1e-9, v_margin = 1 + 1e-5, rounding = 1e-12;
constexpr double rounding_factor = 16;  // rounding error of q″ in units of that of q′ per length of the piece
constexpr double most_change = 0.75;    // largest relative change of b with a useful result
constexpr double close_enough = 1 + 4e-4, wide = 2;  // ratios of two b
constexpr int most_steps = 14;

double sq(double x) { return x * x; }

template <int N>
class Piece {
 public:
  /// Leaves out pairs of axes that cannot limit any b up to `most`.
  Piece(const JerkCapPiece<N>& piece, double most) : p_(piece) {
    const double cube = most * std::sqrt(most);  // v³
    for (std::size_t k = 0; k < p_.axes; ++k)
      for (std::size_t m = 0; m < k; ++m) {
        const double x = (p_.tangent[0][m] + p_.tangent[1][m]) / 2, y = -(p_.tangent[0][k] + p_.tangent[1][k]) / 2;
        const double limit = (weighted(x, p_.jerk[k]) + weighted(y, p_.jerk[m])) * p_.length * give;
        if (!(limit < infinite)) continue;
        const double size = std::abs(x) + std::abs(y);
        std::array<double, 2> q2{};
        double unsure = rounding_factor * size * p_.rounding_error / p_.length;
        for (std::size_t e = 0; e < 2; ++e) {
          const double one = x * p_.q2[e][k], other = y * p_.q2[e][m];
          q2[e] = one + other, unsure += rounding * (std::abs(one) + std::abs(other));
        }
        const double change = std::abs(q2[1] - q2[0]) - unsure;
        if (!(limit < change * cube)) continue;
        Pair& pair = pairs_[count_++];
        pair = {change, std::min(std::abs(q2[0]), std::abs(q2[1])) + unsure, limit, {}};
        for (std::size_t e = 0; e < 2; ++e)
          pair.along[e] =
              std::abs(x * p_.tangent[e][k] + y * p_.tangent[e][m]) + size * (2 * p_.rounding_error + rounding);
      }
  }

  bool may_limit() const { return count_ > 0; }

  /// The cap if nothing worked against it: no less is impossible.
  double least_cap() const {
    double cube = infinite;
    for (std::size_t i = 0; i < count_; ++i) cube = std::min(cube, pairs_[i].limit / pairs_[i].change);
    return std::cbrt(cube * cube);
  }

  /// Returns the relative excess of the jerk that b needs over the limit, for the worst pair of axes, at least −1. b is
  /// possible if it is at most 0.
  double excess(double b) {
    accelerations(b);
    change_ = change(b);
    if (!(change_ < most_change * b)) return -1;
    const double least = b - change_, root = std::sqrt(least);
    const std::array<double, 2> along{this->along(0, b), this->along(1, b)};
    double most = -1;
    for (std::size_t i = 0; i < count_; ++i) {
      const Pair& q = pairs_[i];
      const double asked = q.change * least - q.least * change_,
                   given = q.limit / root + q.along[0] * along[0] + q.along[1] * along[1];
      most = std::max(most, (asked - given) / given);
    }
    return most;
  }
  double change() const { return change_; }

 private:
  struct Pair {
    double change = 0, least = 0;   ///< change of P between the ends; the smaller |P|
    double limit = 0;               ///< mm times the sum of jerks
    std::array<double, 2> along{};  ///< coefficients of v̇ at both ends
  };

  static double weighted(double p, double limit) { return p == 0 ? 0 : std::abs(p) * limit; }

  void accelerations(double b) {
    const double v = std::sqrt(b) * v_margin;
    for (std::size_t k = 0; k < p_.axes; ++k) {
      most_[k] = p_.acceleration[k];
      if (!(p_.least[k] > 0 && p_.jerk[k] < infinite)) continue;
      const double u = p_.most[k] * v;
      most_[k] = std::min(most_[k], give * std::max(most_braking(u, p_.jerk[k], p_.ahead[k]),
                                                    most_braking(u, p_.jerk[k], p_.behind[k])));
    }
  }

  double change(double b) const {
    double most = b, sum = 0;
    for (std::size_t k = 0; k < p_.axes; ++k) {
      sum += p_.most[k] * most_[k];
      if (!(p_.least[k] > 0)) continue;
      const double least = sq(p_.least[k] / p_.most[k]) * b - 2 * most_[k] * p_.displacement[k] / sq(p_.most[k]);
      most = std::min(most, b - least);
    }
    return (p_.unit ? std::min(most, 2 * p_.length * sum) : most) * give;
  }

  /// Largest |v̇| at an end.
  double along(std::size_t e, double b) const {
    double most = infinite, sum = 0;
    for (std::size_t k = 0; k < p_.axes; ++k) {
      const double t = std::abs(p_.tangent[e][k]);
      sum += (t + p_.rounding_error) * most_[k];
      if (t > 2 * p_.rounding_error)
        most = std::min(most, (most_[k] + std::abs(p_.q2[e][k]) * b) / (t - p_.rounding_error));
    }
    return (p_.unit ? std::min(most, sum) : most) * give;
  }

  const JerkCapPiece<N>& p_;
  std::array<Pair, static_cast<std::size_t>(N*(N - 1) / 2)> pairs_;
  std::size_t count_ = 0;
  std::array<double, N> most_{};  ///< accelerations
  double change_ = 0;
};

}  // namespace

template <int N>
bool jerk_may_limit(const JerkCapPiece<N>& piece, double most) {
  return Piece<N>(piece, most).may_limit();
}

template <int N>
JerkCap jerk_cap(const JerkCapPiece<N>& piece, double most) {
  Piece<N> p(piece, most);
  if (!p.may_limit()) return {most, 0};
  double low = p.least_cap(), high = most;
  double above = p.excess(most), change = p.change(), below = -1;
  if (!(above > 0)) return {most, change};
  // The search between a possible and an impossible b takes the middle of a wide range, and of every third; else where
  // a straight line is 0. `high` counts, and need not be the least.
  for (int i = 0; i < most_steps && high > close_enough * low; ++i) {
    const double straight = low + (high - low) * std::clamp(-below / (above - below), 0.05, 0.95);
    const double b = high > wide * low || i % 3 == 2 ? std::sqrt(low) * std::sqrt(high) : straight;
    if (const double excess = p.excess(b); excess > 0)
      high = b, above = excess, change = p.change();
    else
      low = b, below = excess;
  }
  return {high * give, change};
}

template bool jerk_may_limit<2>(const JerkCapPiece<2>&, double);
template JerkCap jerk_cap<2>(const JerkCapPiece<2>&, double);
template bool jerk_may_limit<3>(const JerkCapPiece<3>&, double);
template JerkCap jerk_cap<3>(const JerkCapPiece<3>&, double);
template bool jerk_may_limit<5>(const JerkCapPiece<5>&, double);
template bool jerk_may_limit<8>(const JerkCapPiece<8>&, double);
template JerkCap jerk_cap<5>(const JerkCapPiece<5>&, double);
template JerkCap jerk_cap<8>(const JerkCapPiece<8>&, double);

}  // namespace bahnwerk::verify
