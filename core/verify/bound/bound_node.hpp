#pragma once
/// Nodes of the lower bound's grid, and the cells between them, with the quantities that the bound uses.
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
  double s = 0, u = 0;                                       ///< place: mm from the segment's beginning; parameter
  double cap = 0;             ///< largest b = v² that limits at the node alone allow, mm²/s²; may be infinite
  double rounding_error = 0;  ///< effect of rounding on a component of q'
  std::uint32_t segment = 0;
  std::uint32_t id = unknown;  ///< number that the grid has assigned
  static constexpr std::uint32_t unknown = ~std::uint32_t{0};

  /// Return bounds of q'_k² that include rounding: conditions are always used in their weaker form.
  double least(std::size_t k) const { return sq(std::max(0.0, std::abs(tangent[k]) - rounding_error)); }
  double most(std::size_t k) const { return sq(std::abs(tangent[k]) + rounding_error); }
};

/// The cell between node i and node i + 1. Across a joint both nodes are at one place, with the tangents of either
/// side; they are also at one place, up to the rounding of s, where a root of q'_k coincides with the end of a segment.
template <int N>
struct BoundCell {
  enum class Kind : unsigned char { straight, curved, joint };
  std::array<double, N> energy{};        ///< upper bound of 2 A_k ∫|q'_k| ds, by which q'_k² b can change
  std::array<double, N> displacement{};  ///< lower bound of |Δq_k|
  std::array<double, N> velocity{};      ///< largest speed of axis k by its own limit, the feed and the other axes'
  double length = 0;                     ///< mm
  double slip = 0;                       ///< bound of the change of b across a joint, mm²/s²
  double valley =
      std::numeric_limits<double>::infinity();  ///< estimated minimum of the caps inside, mm²/s²; infinite: none
  Kind kind = Kind::joint;
  std::uint8_t turning = 0;  ///< bit k: whether axis k may reverse
  bool divisible = false;    ///< whether the cell is curved and long enough for halving to be useful
};

/// Returns the Euclidean norm.
template <std::size_t N>
double length_of(const std::array<double, N>& v) {
  double square = 0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}
/// Returns a vector of axes that are the coordinates of the tool.
template <std::size_t N>
Vec direction(const std::array<double, N>& v) {
  return {v[0], v[1], N == 3 ? v[2] : 0};
}
/// Returns the rounding error of differences of path lengths up to s, mm: shorter cells are useless.
inline double rounding_of(double s) { return 64 * epsilon * (1 + s); }

}  // namespace bahnwerk::verify
