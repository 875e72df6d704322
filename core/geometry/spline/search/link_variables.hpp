#pragma once
/// What searches for links vary, instead of β.
///
/// The derivatives γ_j of f⁻¹ at both ends, by arc length in units of the chord: beside lines control points are linear
/// in them, and
/// they do not depend on how long the neighbours are. (By β, sizes differ by 1e3, see the source's optimum.)
/// |γ_j| ≤ 5, 20, 100, 500, and γ₁ ≥ 0.2: without that (4.60) has no minimum. It weighs the height of κ, not how fast κ
/// rises, and tends to the largest circle between the neighbours, with κ rising in a vanishing part of the link
/// (γ₁ → 0) though it is G^k in name.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/link.hpp"

namespace bahnwerk {

/// 2k variables: γ₁ … γ_k before, then after. O(1) each call.
class LinkVariables {
 public:
  /// Ends must not stand still, nor be at the same place.
  LinkVariables(std::size_t continuity, const LinkEnds& ends);

  std::size_t size() const { return 2 * continuity_; }
  double chord() const { return chord_; }
  /// The ends by arc length in units of the chord; with scaled() they give the link that own() gives with the ends.
  const LinkEnds& ends() const { return scaled_; }

  static double lower(std::size_t order) { return order == 1 ? 0.2 : -upper(order); }
  static double upper(std::size_t order) { return std::array{0.0, 5.0, 20.0, 100.0, 500.0}[order]; }
  static double scale(std::size_t order) { return std::array{1.0, 1.0, 2.0, 6.0, 24.0}[order]; }  ///< order!
  std::size_t order(std::size_t variable) const { return variable % continuity_ + 1; }

  /// γ of a shape whose β are by the ends' own parameters, within the bounds; of none: γ₁ = 1, the rest 0.
  std::vector<double> of(const LinkShape& own) const;
  std::vector<double> straight() const;
  /// β by the parameters of ends(), and by the ends' own. Without weights.
  LinkShape scaled(std::span<const double> gamma) const;
  LinkShape own(std::span<const double> gamma) const;
  /// Gradient by the β of scaled() → by γ.
  void pull_back(std::span<const double> gamma, std::span<const double> by_beta, std::span<double> by_gamma) const;

 private:
  std::size_t continuity_;
  double chord_;
  std::array<Series, 2> to_length_;  ///< scaled arc length over the end's own parameter
  LinkEnds scaled_;
};

}  // namespace bahnwerk
