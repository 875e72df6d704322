#pragma once
/// Places on the path, and cells between them, with what the lower bound uses of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/geometry/curve/vec.hpp"
#include "core/verify/rounding.hpp"

namespace bahnwerk::verify {

inline double sq(double x) { return x * x; }

/// Axes through kinematics have any units: they and their limits are scaled by powers of two so that |q'_k| is at most
/// about 1. Cartesian axes are unchanged.
template <int N>
struct BoundNode {
  std::array<double, N> position{}, tangent{}, curvature{};  ///< q, q', q'' by path length; q'' is 0 at cusps
  double s = 0, u = 0;                                       ///< mm from the segment's beginning, and its parameter
  double cap = 0;             ///< largest b = v² allowed at this place itself, mm²/s², may be infinite
  double rounding_error = 0;  ///< effect of rounding on a component of q'
  std::uint32_t segment = 0;
  std::uint32_t id = unknown;  ///< given by the grid that owns the node
  static constexpr std::uint32_t unknown = ~std::uint32_t{0};

  /// Bounds of q'_k² under that rounding: conditions are always used in their weaker form.
  double least(std::size_t k) const { return sq(std::max(0.0, std::abs(tangent[k]) - rounding_error)); }
  double most(std::size_t k) const { return sq(std::abs(tangent[k]) + rounding_error); }
};

/// The cell between node i and node i + 1. Across a joint both nodes are one place with the tangents of either side; so
/// they are where a root of h'_k coincides with the end of a segment, up to the rounding of s.
template <int N>
struct BoundCell {
  enum class Kind : unsigned char { straight, curved, joint };
  std::array<double, N> energy{};        ///< 2 A_k ∫|q'_k| ds from above: bounds the change of |q'_k² b|
  std::array<double, N> displacement{};  ///< |Δq_k| from below
  std::array<double, N> velocity{};      ///< largest speed of axis k by its own limit, the feed and the other axes'
  double length = 0;                     ///< mm
  double slip = 0;                       ///< across a joint: bound of the change of b, mm²/s²
  double valley = std::numeric_limits<double>::infinity();  ///< a b that may be too large inside, if not at the ends
  Kind kind = Kind::joint;
  std::uint8_t turning = 0;  ///< bit k: axis k may turn round, or this is unknown
  bool divisible = false;    ///< curved, and long enough for halving to give better coordinates
};

template <std::size_t N>
double length_of(const std::array<double, N>& v) {
  double square = 0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}
/// The norm of a vector of the tool, where the axes are its coordinates.
template <std::size_t N>
Vec direction(const std::array<double, N>& v) {
  return {v[0], v[1], N == 3 ? v[2] : 0};
}
/// Rounding of a difference of path lengths up to s: shorter cells are useless.
inline double rounding_of(double s) { return 64 * epsilon * (1 + s); }

}  // namespace bahnwerk::verify
