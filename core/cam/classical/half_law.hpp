#pragma once
/// The first half of a symmetric normalised motion law [VDI 2143]: f(0) = 0, f(1/2) = 1/2, f(1 − z) = 1 − f(z).
///
/// Gutman's laws are f = z − Σ c_k/(2πk) sin 2πkz over the first n odd harmonics, c_k ∝ (1 − k/(2n + 2))/k², Σ c_k = 1:
/// Fejér means of the Fourier series of the quadratic law. n = 1 is the inclined sine; n = 2 is the law that bears his
/// name, z − 15/(32π) sin 2πz − 1/(96π) sin 6πz.
#include <optional>
#include <vector>

#include "core/cam/classical_law.hpp"

namespace bahnwerk::cam {

/// A piece of f over [begin, end] ⊂ [0, 1/2] in Bernstein form; sines by their Taylor polynomials, to 1e-15.
struct HalfLawPiece {
  double begin = 0, end = 0;
  std::vector<double> bernstein;
};
/// Returns pieces that cover [0, 1/2]. Throws std::logic_error for `straight`, which has no halves.
std::vector<HalfLawPiece> half_law(ClassicalLaw law, const SineStraight& fractions = {});
/// Returns f'(1/2), the velocity coefficient C_v: the largest velocity of a law from rest to rest of unit stroke and
/// time.
double middle_velocity(const std::vector<HalfLawPiece>& half);

/// Returns the pieces of a law that has no symmetric halves, over z = 0 … 1, at rest at both ends; empty for the
/// others. These laws lead from a dwell to a reversal or back.
///
/// The harmonic combination [VDI 2143] has a = A sin(πz/λ) up to z = λ, then −B sin(π(z − λ)/(2(1 − λ))): its greatest
/// velocity, 1/(λ/2 + 2(1 − λ)/π), is at λ. `inflection` is λ; none: 2 − √2, where the jerk is continuous. In
/// the form to a dwell it is 1 − λ. The other laws have no inflection of choice.
std::vector<HalfLawPiece> whole_law(ClassicalLaw law, std::optional<double> inflection = std::nullopt);
/// Returns whether a section's `inflection` means something for the law.
bool has_inflection(ClassicalLaw law);

}  // namespace bahnwerk::cam
