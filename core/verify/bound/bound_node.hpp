#pragma once
/// What the lower bound knows of places on the path, and of the ways between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::verify {

/// Axes through kinematics have any units: they are scaled by powers of two so that |q'_k| is about 1 at most, and
/// their limits likewise. Cartesian axes stay as they are.
template <int N>
struct BoundNode {
  std::array<double, N> position{}, tangent{}, curvature{};  ///< q, q', q'' by path length; q'' is 0 at cusps
  double s = 0, u = 0;                                       ///< mm from the segment's begin, and its parameter
  double cap = 0;   ///< largest b = v² allowed at this place itself, mm²/s², may be infinite
  double blur = 0;  ///< how far rounding may have moved a component of q'
  std::uint32_t segment = 0;
  std::uint32_t id = unknown;  ///< given by the grid that keeps it
  static constexpr std::uint32_t unknown = ~std::uint32_t{0};

  /// Bounds of q'_k² under that rounding: conditions are always used in their weaker reading.
  double least(std::size_t k) const { return square(std::max(0.0, std::abs(tangent[k]) - blur)); }
  double most(std::size_t k) const { return square(std::abs(tangent[k]) + blur); }

 private:
  static double square(double x) { return x * x; }
};

/// Between node i and node i + 1. Across a joint both nodes are the same place with the tangents of either side; so
/// they are where a root of h'_k falls onto the end of a segment, up to the rounding of s.
template <int N>
struct BoundCell {
  enum class Kind : unsigned char { straight, curved, joint };
  std::array<double, N> energy{};    ///< 2 A_k ∫|q'_k| ds from above: what |q'_k² b| may change by
  std::array<double, N> way{};       ///< |Δq_k| from below
  std::array<double, N> velocity{};  ///< what axis k may run at, by its own limit, the feed and the other axes'
  double length = 0;                 ///< mm
  double slip = 0;                   ///< across a joint: what b may change by, mm²/s²
  double valley = std::numeric_limits<double>::infinity();  ///< b that may be too much inside, if not at the ends
  Kind kind = Kind::joint;
  std::uint8_t turning = 0;  ///< bit k: axis k may turn round, or nothing is known of that
  bool divisible = false;    ///< curved, and long enough for its coordinates to tell more when halved
};

template <std::size_t N>
double length_of(const std::array<double, N>& v) {
  double square = 0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}
/// Of the tool, where the axes are its coordinates.
template <std::size_t N>
Vec direction(const std::array<double, N>& v) {
  return {v[0], v[1], N == 3 ? v[2] : 0};
}
/// Of a difference of path lengths up to s: shorter cells say nothing.
inline double rounding_of(double s) { return 64 * std::numeric_limits<double>::epsilon() * (1 + s); }

}  // namespace bahnwerk::verify
