#pragma once
/// The largest of many values with the moment it occurred; not-a-number wins over everything and stays.
#include <cmath>
#include <string>

#include "core/plan.hpp"

namespace bahnwerk::verify {

inline constexpr double limit_tolerance = 1e-9;  ///< relative, of every limit check

struct Worst {
  double value = 0;
  double at = 0;
  void raise(double candidate, double when) {
    if (std::isnan(value) || candidate <= value) return;
    value = candidate;
    at = when;
  }
};

/// passed = value ≤ limit · (1 + 1e-9); false for NaN.
inline Check make_check(std::string name, std::string unit, double limit, const Worst& worst) {
  return {std::move(name), std::move(unit), limit, worst.value, worst.at, worst.value <= limit * (1 + limit_tolerance)};
}

}  // namespace bahnwerk::verify
