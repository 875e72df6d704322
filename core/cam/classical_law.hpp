#pragma once
/// The classical motion laws [VDI 2143] by name, as f(z) with f(0) = 0 and f(1) = 1 over the section z = 0 … 1.
#include "core/base/named.hpp"

namespace bahnwerk::cam {

enum class ClassicalLaw {
  polynomial_345,                   ///< 10 z³ − 15 z⁴ + 6 z⁵
  polynomial_4567,                  ///< 35 z⁴ − 84 z⁵ + 70 z⁶ − 20 z⁷
  modified_sine,                    ///< the acceleration consists of three sine arcs, joined at z = 1/8 and 7/8
  modified_trapezoid,               ///< the acceleration is a trapezoid whose slopes are quarters of sines
  inclined_sine,                    ///< z − sin(2πz)/(2π), the cycloidal law
  simple_harmonic,                  ///< (1 − cos πz)/2; the acceleration jumps at both ends
  quadratic,                        ///< 2 z² up to the middle; the acceleration jumps
  straight,                         ///< z; constant velocity
  gutman_1,                         ///< n = 1 odd harmonic (core/cam/classical/half_law.hpp), equal to inclined_sine
  gutman_2,                         ///< n = 2 odd harmonics
  gutman_3,                         ///< n = 3 odd harmonics
  double_harmonic_from_dwell,       ///< (1 − cos πz)/2 − (1 − cos 2πz)/8: from a dwell to a reversal
  double_harmonic_to_dwell,         ///< the same backwards, from a reversal to a dwell
  harmonic_combination_from_dwell,  ///< half a sine of acceleration, then a quarter of one down to the reversal
  harmonic_combination_to_dwell,    ///< the same backwards
  polynomial_3456_from_dwell,       ///< 8 z³ − 12 z⁴ + 6 z⁵ − z⁶: from a dwell to a reversal
  polynomial_3456_to_dwell,         ///< the same backwards
  sine_straight_combination,        ///< the acceleration of SineStraight, SCCA
};
/// Fractions of a section of law `sine_straight_combination` [Norton, SCCA]: the acceleration is a quarter of a sine
/// over b/2, constant over c/2, a quarter of a cosine down to 0 over d/2, and 0 up to the middle; the other half is its
/// mirror image. b + c + d ≤ 1, the rest is straight.
struct SineStraight {
  double b = 0.25, c = 0.5, d = 0.25;
};
/// Returns whether the acceleration of a law jumps inside its section.
constexpr bool acceleration_jumps(ClassicalLaw law, const SineStraight& fractions) {
  return law == ClassicalLaw::quadratic || (law == ClassicalLaw::sine_straight_combination && fractions.d == 0);
}
inline constexpr Named<ClassicalLaw> classical_laws[] = {
    {ClassicalLaw::polynomial_345, "polynomial_345"},
    {ClassicalLaw::polynomial_4567, "polynomial_4567"},
    {ClassicalLaw::modified_sine, "modified_sine"},
    {ClassicalLaw::modified_trapezoid, "modified_trapezoid"},
    {ClassicalLaw::inclined_sine, "inclined_sine"},
    {ClassicalLaw::simple_harmonic, "simple_harmonic"},
    {ClassicalLaw::quadratic, "quadratic"},
    {ClassicalLaw::straight, "straight"},
    {ClassicalLaw::gutman_1, "gutman_1"},
    {ClassicalLaw::gutman_2, "gutman_2"},
    {ClassicalLaw::gutman_3, "gutman_3"},
    {ClassicalLaw::double_harmonic_from_dwell, "double_harmonic_from_dwell"},
    {ClassicalLaw::double_harmonic_to_dwell, "double_harmonic_to_dwell"},
    {ClassicalLaw::harmonic_combination_from_dwell, "harmonic_combination_from_dwell"},
    {ClassicalLaw::harmonic_combination_to_dwell, "harmonic_combination_to_dwell"},
    {ClassicalLaw::polynomial_3456_from_dwell, "polynomial_3456_from_dwell"},
    {ClassicalLaw::polynomial_3456_to_dwell, "polynomial_3456_to_dwell"},
    {ClassicalLaw::sine_straight_combination, "sine_straight_combination"},
};

}  // namespace bahnwerk::cam
