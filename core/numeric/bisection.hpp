#pragma once
/// Bisection: the place at which a condition ceases to hold, by its truth alone. Functions with values whose change of
/// sign is sought converge sooner with SignChange (core/numeric/sign_change.hpp).

namespace bahnwerk {

/// An interval at whose lower end the condition holds and at whose upper end it does not; the ends given by the caller
/// are not evaluated.
struct Bisection {
  double low = 0, high = 0;
};

/// Halves [low, high] until it is no longer than `width`, at most `steps` times; with width 0 until no number lies
/// between. `holds` is evaluated once per step, never at the ends.
template <class Condition>
Bisection bisect(double low, double high, double width, int steps, const Condition& holds) {
  for (int i = 0; i < steps && high - low > width; ++i) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return {low, high};
}

}  // namespace bahnwerk
