#pragma once
/// The variables of a search for links, in place of β.
///
/// The variables are the derivatives γ_j of f⁻¹ at both ends, by arc length in units of the chord: beside lines control
/// points are linear in them, and they do not depend on the neighbours' lengths. (The β differ in size by 1e3, see the
/// source's optimum.) |γ_j| ≤ 5, 20, 100, 500, and γ₁ ≥ 0.2: without that limit (4.60) has no minimum. It weighs the
/// height of κ, not its rate of change, and tends to the largest circle between the neighbours, with κ rising in a
/// vanishing part of the link (γ₁ → 0) although it is formally G^k.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/link.hpp"

namespace bahnwerk {

/// The 2k variables are γ₁ … γ_k before, then after. Every call is O(1).
class LinkVariables {
 public:
  /// The derivatives at the ends must not vanish, and the ends must be at different places.
  LinkVariables(std::size_t continuity, const LinkEnds& ends);

  std::size_t size() const { return 2 * continuity_; }
  double chord() const { return chord_; }
  /// Returns the ends by arc length in units of the chord; with scaled() they give the link that own() gives with the
  /// original ends.
  const LinkEnds& ends() const { return scaled_; }

  static double lower(std::size_t order) { return order == 1 ? 0.2 : -upper(order); }
  static double upper(std::size_t order) { return std::array{0.0, 5.0, 20.0, 100.0, 500.0}[order]; }
  static double scale(std::size_t order) {
    return std::array{1.0, 1.0, 2.0, 6.0, 24.0}[order];
  }  ///< returns the factorial of the order
  std::size_t order(std::size_t variable) const { return variable % continuity_ + 1; }

  /// Returns the γ of a shape whose β are by the ends' own parameters, within the bounds; without a shape γ₁ = 1 and
  /// the rest 0.
  std::vector<double> of(const LinkShape& own) const;
  /// Returns γ₁ = 1 and 0 for the rest.
  std::vector<double> straight() const;
  /// Returns β by the parameters of ends(), or by the ends' own, without weights.
  LinkShape scaled(std::span<const double> gamma) const;
  LinkShape own(std::span<const double> gamma) const;
  /// Converts a gradient by the β of scaled() to one by γ.
  void pull_back(std::span<const double> gamma, std::span<const double> by_beta, std::span<double> by_gamma) const;

 private:
  std::size_t continuity_;
  double chord_;
  std::array<Series, 2> to_length_;  ///< scaled arc length over the end's own parameter
  LinkEnds scaled_;
};

}  // namespace bahnwerk
