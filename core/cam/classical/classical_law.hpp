#pragma once
/// The classical motion laws [VDI 2143] by name.
#include "core/base/named.hpp"

namespace bahnwerk::cam {

enum class ClassicalLaw {
  polynomial_345,
  polynomial_4567,
  modified_sine,
  modified_trapezoid,
  inclined_sine,
  simple_harmonic,
  quadratic,
  straight,
  gutman_1,
  gutman_2,
  gutman_3,
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
};

}  // namespace bahnwerk::cam
