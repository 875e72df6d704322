#pragma once
/// Golden section search [Kiefer, Proc. Amer. Math. Soc. 4 (1953)] for the largest value of a function of one variable.
/// It needs neither derivatives nor smoothness.

namespace bahnwerk {

/// The result of the search.
template <class Value>
struct GoldenSection {
  double at = 0;  ///< middle of an interval that contains the largest value
  Value value{};  ///< the larger value of its two inner points
};

/// Returns the maximum of `value` over [first, last]; if there are several local ones, one of them. The search ends
/// when the interval is no longer than `exact`; every evaluation reduces it to 0.62 of its length. Values need `<`
/// only.
template <class Function>
auto golden_section(const Function& value, double first, double last, double exact) {
  constexpr double golden = 0.61803398874989484820;
  double a = last - golden * (last - first), b = first + golden * (last - first);
  auto at_a = value(a), at_b = value(b);
  while (last - first > exact) {
    if (at_a < at_b) {
      first = a, a = b, at_a = at_b;
      at_b = value(b = first + golden * (last - first));
    } else {
      last = b, b = a, at_b = at_a;
      at_a = value(a = last - golden * (last - first));
    }
  }
  return GoldenSection<decltype(at_a)>{(first + last) / 2, at_a < at_b ? at_b : at_a};
}

}  // namespace bahnwerk
