#pragma once
/// The largest of many values with its time; not-a-number exceeds everything and stays.
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/verification.hpp"

namespace bahnwerk::verify {

inline constexpr double limit_tolerance = 1e-9;  ///< relative tolerance of every limit that the document sets

/// The largest value so far, with its time, s.
struct Worst {
  double value = 0;
  double at = 0;
  /// Takes a candidate that is larger or not a number; a value that is not a number remains.
  void raise(double candidate, double when) {
    if (std::isnan(value) || candidate <= value) return;
    value = candidate;
    at = when;
  }
};

/// The value, among many, that is closest to its own limit or exceeds it by most. A value that is not a number counts
/// as an excess, and it remains.
struct Strained {
  double value = 0;
  double limit = 0;
  double at = 0;
  void raise(double candidate, double bound, double when) {
    if (candidate <= enough_ * bound && bound <= std::numeric_limits<double>::max())
      return;                              // the common case needs no division
    if (!std::isfinite(bound)) bound = 0;  // an unbounded law does not widen its own tolerance
    double strain = candidate == 0 ? 0 : candidate / bound;
    if (std::isnan(strain)) strain = std::numeric_limits<double>::infinity();
    if (std::isnan(value) || (strain <= strain_ && !std::isnan(candidate))) return;
    value = candidate, limit = bound, at = when, strain_ = strain, enough_ = strain * below;
  }

 private:
  static constexpr double below = 1 - 8 * std::numeric_limits<double>::epsilon();
  double strain_ = -1, enough_ = -1;
};

inline Check make_check(Checked what, double limit, double value, double at, bool passed) {
  return {std::move(what), limit, value, at, passed};
}

/// Makes a check that passes for value ≤ limit · (1 + 1e-9), and fails for NaN.
inline Check make_check(Checked what, double limit, const Worst& worst) {
  return make_check(std::move(what), limit, worst.value, worst.at, worst.value <= limit * (1 + limit_tolerance));
}

/// Makes a check whose limit differs for each value.
inline Check make_limit_check(Checked what, const Strained& worst) {
  return make_check(std::move(what), worst.limit, {worst.value, worst.at});
}

/// Makes a check with passed = value ≤ limit; false for NaN. For tolerances that follow from rounding.
inline Check make_check(Checked what, const Strained& worst) {
  return make_check(std::move(what), worst.limit, worst.value, worst.at, worst.value <= worst.limit);
}

}  // namespace bahnwerk::verify
