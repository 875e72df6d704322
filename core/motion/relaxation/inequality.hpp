#pragma once
/// An inequality value ≤ 0 of an interior-point method: its slack, its multiplier, and their steps. V is a number, or a
/// vector of one number per side of |x| ≤ limit.
namespace bahnwerk {

/// V is a number, or a vector of one number per side of |x| ≤ limit.
template <class V>
struct Inequality {
  V slack{}, multiplier{};
  V inverse{};   ///< 1/slack, the only form in which it is used
  V residual{};  ///< value + slack
  V pending{};   ///< product of the predictor's steps; then the result of aim(); then the slack's step
  V multiplier_step{};

  V weight() const { return multiplier * inverse; }
  /// Returns the new multiplier for complementarity `target` if the value does not change. `part` is the weight of the
  /// product of the predictor's steps.
  V aim(double target, double part) const { return (target - part * pending + multiplier * residual) * inverse; }
  /// Computes the predictor's steps, towards complementarity 0, for a given change of the value.
  void predict(V change) {
    const V step = -(residual + change);
    multiplier_step = -(weight() * step + multiplier);
    pending = step * multiplier_step;
  }
  /// Completes the steps of slack and multiplier after aim().
  void follow(V change) {
    multiplier_step = pending + weight() * change - multiplier;
    pending = -(residual + change);
  }
  void advance(double primal, double dual) {
    slack = slack + primal * pending;
    multiplier = multiplier + dual * multiplier_step;
    inverse = 1.0 / slack;
  }
};

}  // namespace bahnwerk
