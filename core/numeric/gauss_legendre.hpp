#pragma once
/// Gauss's rule on [−1, 1]: ∫ f ≈ Σ weight · f(place), exact for polynomials up to degree 2 n − 1 [Abramowitz, Stegun,
/// Handbook of Mathematical Functions, 25.4.29]. The places are the roots of the Legendre polynomial of degree n, from
/// Boost.Math, in extended precision: places and weights are correctly rounded.
#include <array>
#include <cstddef>
#include <span>

namespace bahnwerk {

/// A place of the rule and its weight.
struct GaussPoint {
  double place = 0, weight = 0;
};

/// Writes the rule of rule.size() points, in ascending order. O(n²), a few µs.
void gauss_legendre(std::span<GaussPoint> rule);

/// Returns the rule of n points; it is computed once.
template <std::size_t n>
const std::array<GaussPoint, n>& gauss_legendre() {
  static const std::array<GaussPoint, n> rule = [] {
    std::array<GaussPoint, n> made;
    gauss_legendre(made);
    return made;
  }();
  return rule;
}

}  // namespace bahnwerk
