#pragma once
/// The classical motion laws [VDI 2143] by name, as f(z) with f(0) = 0 and f(1) = 1 over the section z = 0 … 1.
#include "core/base/named.hpp"

namespace bahnwerk::cam {

enum class ClassicalLaw {
  polynomial_345,              ///< 10 z³ − 15 z⁴ + 6 z⁵
  polynomial_4567,             ///< 35 z⁴ − 84 z⁵ + 70 z⁶ − 20 z⁷
  modified_sine,               ///< the acceleration consists of three sine arcs, joined at z = 1/8 and 7/8
  modified_trapezoid,          ///< the acceleration is a trapezoid whose slopes are quarters of sines
  inclined_sine,               ///< z − sin(2πz)/(2π), the cycloidal law
  simple_harmonic,             ///< (1 − cos πz)/2; the acceleration jumps at both ends
  quadratic,                   ///< 2 z² up to the middle; the acceleration jumps
  straight,                    ///< z; constant velocity
  gutman_1,                    ///< n = 1 odd harmonic (core/cam/classical/half_law.hpp), equal to inclined_sine
  gutman_2,                    ///< n = 2 odd harmonics
  gutman_3,                    ///< n = 3 odd harmonics
  double_harmonic_from_dwell,  ///< (1 − cos πz)/2 − (1 − cos 2πz)/8: from a dwell to a reversal
  double_harmonic_to_dwell,    ///< the same backwards, from a reversal to a dwell
};
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
};

}  // namespace bahnwerk::cam
