#pragma once
/// Positions and labels of ticks on the axes of charts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace bahnwerk::drawing {

/// Returns the smallest number of the form 1, 2 or 5 times a power of ten that is at least `least` > 0.
inline double nice(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

/// Calls at(value) for every multiple of `by` within [low, high], for a thousand of them at most: beyond 2⁵³ steps from
/// 0 a multiple and the next one are the same number.
template <class At>
void for_each_tick(double low, double high, double by, At&& at) {
  const double first = std::ceil(low / by - 1e-9);
  for (int i = 0; i < 1000 && first + i <= high / by + 1e-9; ++i) at((first + i) * by);
}

/// Returns the text beside a tick. Seven digits, or as many as let ticks that are `step` apart differ.
inline std::string tick_label(double value, double step = 0) {
  char text[40];
  int digits = 7;
  if (step > 0) {
    const double steps = std::abs(value) / step;
    if (steps > 1e6) digits = std::min(16, 1 + static_cast<int>(std::ceil(std::log10(steps))));
  }
  std::snprintf(text, sizeof text, "%.*g", digits, std::abs(value) < 1e-12 ? 0 : value);
  return text;
}

}  // namespace bahnwerk::drawing
