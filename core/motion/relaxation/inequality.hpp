#pragma once
/// An inequality value ≤ 0 of an interior-point method: its slack, its multiplier, and their steps.
namespace bahnwerk {

/// V: a number, or one per side of |x| ≤ limit.
template <class V>
struct Inequality {
  V slack{}, multiplier{};
  V inverse{};   ///< of the slack: all else multiplies by it
  V residual{};  ///< value + slack
  V pending{};   ///< the product of the predictor's steps, then aim(), then the slack's step
  V multiplier_step{};

  V weight() const { return multiplier * inverse; }
  /// What the multiplier becomes for complementarity `target` as long as the value does not change. `part`: how much of
  /// the product of the predictor's steps counts.
  V aim(double target, double part) const { return (target - part * pending + multiplier * residual) * inverse; }
  /// Towards no complementarity at all, where the value changes so.
  void predict(V change) {
    const V step = -(residual + change);
    multiplier_step = -(weight() * step + multiplier);
    pending = step * multiplier_step;
  }
  /// From aim() to both steps.
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
