#pragma once
/// The fastest change of speed by a given height, with acceleration (and jerk, if snap is limited) zero at both ends.
///
/// The acceleration is symmetric: it rises to a peak a, holds it and falls. The rise is itself such a change, of the
/// acceleration by a under jerk and snap limits, and lasts [Herrmann 3.3.1, re-derived]
///     θ(a) = a/J + J/S   if a ≥ J²/S (the jerk limit is reached),   2 √(a/S) otherwise;   J/S = 0 without snap limit.
/// Without a hold the height is a θ(a) and the time T = 2 θ(a); from d = A θ(A) on the acceleration limit is reached:
///     T(d) = d/A + θ(A)                 d ≥ A θ(A)
///     T(d) = J/S + √((J/S)² + 4 d/J)    d ≥ 2 J³/S²
///     T(d) = 4 ∛(d/(2 S))               otherwise.
/// By symmetry the distance covered is T times the mean of both speeds. Among all motions under these limits this is
/// the fastest one: it is the rest-to-rest problem of the acceleration, solved by the double-S.
#include <algorithm>
#include <cmath>

#include "core/machine/machine.hpp"

namespace bahnwerk {

/// Durations (s) of the phases: jerk rises (ramp), holds, falls; acceleration holds; then the mirror image.
struct SpeedChange {
  double ramp = 0, jerk_hold = 0, hold = 0;
  double acceleration = 0;  ///< peak acceleration, mm/s²
  double jerk = 0;          ///< peak jerk, mm/s³; infinite without limits of jerk and snap
};

/// The law of changes within limits on acceleration (mm/s²), jerk (mm/s³) and snap (mm/s⁴), which are positive and at
/// least one of which is finite. Every function costs a few operations and at most one root.
class SpeedChangeLaw {
 public:
  SpeedChangeLaw(double acceleration, double jerk, double snap)
      : A_(acceleration),
        J_(jerk),
        S_(snap),
        jerk_ramp_(snap < unlimited ? jerk / snap : 0),
        jerk_reached_(snap < unlimited ? jerk * jerk_ramp_ : 0),
        rise_(acceleration < unlimited ? rise(acceleration) : unlimited),
        full_(acceleration < unlimited ? acceleration * rise_ : unlimited),
        knee_(2 * jerk_reached_ * jerk_ramp_) {}

  /// Returns T(d), s: increasing, and concave except at full_height() if snap is limited.
  double duration(double height) const {
    if (height >= full_) return height / A_ + rise_;
    if (height >= knee_) return jerk_ramp_ + std::sqrt(jerk_ramp_ * jerk_ramp_ + 4 * height / J_);
    return 4 * std::cbrt(height / (2 * S_));
  }
  /// Returns dT/dd, for height > 0.
  double slope(double height) const {
    if (height >= full_) return 1 / A_;
    if (height >= knee_) return 2 / J_ / std::sqrt(jerk_ramp_ * jerk_ramp_ + 4 * height / J_);
    return 4 * std::cbrt(height / (2 * S_)) / (3 * height);
  }
  /// Returns d(T), the inverse of duration(), which needs no roots.
  double height(double duration) const {
    if (duration >= 2 * rise_) return A_ * (duration - rise_);
    const double half = duration / 2;
    return half >= 2 * jerk_ramp_ ? J_ * (half - jerk_ramp_) * half : S_ * half * half * half / 4;
  }
  /// Returns dd/dT.
  double height_slope(double duration) const {
    if (duration >= 2 * rise_) return A_;
    const double half = duration / 2;
    return half >= 2 * jerk_ramp_ ? J_ * (2 * half - jerk_ramp_) / 2 : 3 * S_ * half * half / 8;
  }
  /// Returns an upper bound on T for changes with d T(d) ≤ product; larger limits are left out, so it is within a small
  /// factor.
  double duration_below(double product) const {
    const double jerk_only = std::cbrt(product * product / 4 * J_), quarter = product / 4;
    const double snap_only = std::sqrt(quarter * std::sqrt(quarter * 2 * S_));
    return duration(std::min({std::sqrt(product * A_), jerk_only, snap_only}));
  }
  /// Returns A θ(A), the height from which on the acceleration limit is reached; infinite without one.
  double full_height() const { return full_; }
  /// Returns whether neither jerk nor snap is limited, so that the acceleration jumps.
  bool jumps() const { return rise_ == 0; }
  /// Returns the phases of a change by `height`.
  SpeedChange shape(double height) const;

 private:
  double rise(double a) const { return a >= jerk_reached_ ? a / J_ + jerk_ramp_ : 2 * std::sqrt(a / S_); }

  double A_, J_, S_;
  double jerk_ramp_;     // J/S
  double jerk_reached_;  // J²/S: the acceleration from which on the jerk limit is reached
  double rise_;          // θ(A)
  double full_;          // A θ(A)
  double knee_;          // 2 J³/S²: the height from which on the jerk limit is reached
};

}  // namespace bahnwerk
