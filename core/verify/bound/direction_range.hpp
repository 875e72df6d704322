#pragma once
/// An enclosure of the derivative q'_k of an axis by path length between two nodes of the bound.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bahnwerk::verify {

/// The interval [low, high].
struct Interval {
  double low = 0, high = 0;
};

/// Encloses a function with the values g0, g1 and slopes d0, d1 at both ends of an interval of length l, whose second
/// derivative does not exceed `q2` in magnitude. Its slope lies between (d0 + d1 ∓ q2 l)/2, because from either end it
/// changes by at most q2 times the distance. The function therefore lies between the lines of least and of greatest
/// slope through either end.
/// Where the slope has one sign, these are the values at the ends.
inline Interval between(double g0, double g1, double d0, double d1, double l, double q2) {
  const double least = (d0 + d1 - q2 * l) / 2, most = (d0 + d1 + q2 * l) / 2;
  if (least >= 0 || most <= 0) return {std::min(g0, g1), std::max(g0, g1)};
  const auto place = [l](double x) { return std::clamp(x, 0.0, l); };
  const double x = place((g1 - g0 - most * l) / (least - most)), y = place((g1 - g0 - least * l) / (most - least));
  return {std::min({g0, g1, g0 + least * x}), std::max({g0, g1, g0 + most * y})};
}

/// Ranges of q'_k of every axis between two nodes. ∫|q'_k| ds is at most |Δq_k| plus twice the integral of the part
/// with the wrong sign.
template <int N>
struct DirectionRange {
  std::array<double, N> low{}, high{};
  /// Returns the largest magnitude with which q'_k may have the wrong sign; 0: q_k is monotone.
  double wrong(std::size_t k) const { return std::max(0.0, std::min(high[k], -low[k])); }
  double least(std::size_t k) const { return std::max({0.0, low[k], -high[k]}); }  ///< smallest |q'_k|
  double most(std::size_t k) const { return std::max({0.0, high[k], -low[k]}); }   ///< largest |q'_k|
};

}  // namespace bahnwerk::verify
