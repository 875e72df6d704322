#pragma once
/// What five even samples of a smooth function over a cell tell about its peak.
#include <algorithm>
#include <array>
#include <cmath>

namespace bahnwerk {

/// Largest |f| of five even samples; from `worth` on also what lies between them: the quartic through them gives four
/// more samples, parabolas the peaks between these nine.
struct EvenSamples {
  double most = 0;     ///< of the five
  double between = 0;  ///< of all, with the peaks of the parabolas; = most below `worth`
  double third = 0;    ///< largest third difference of the nine: a cubic may pass a parabola through its neighbours by
                       ///< 0.065 of it; 0 below `worth`

  EvenSamples(const std::array<double, 5>& f, double worth) {
    for (const double x : f) most = std::max(most, std::abs(x));
    between = most;
    if (most < worth) return;
    const std::array<double, 9> g{f[0], (35 * f[0] + 140 * f[1] - 70 * f[2] + 28 * f[3] - 5 * f[4]) / 128,
                                  f[1], (-5 * f[0] + 60 * f[1] + 90 * f[2] - 20 * f[3] + 3 * f[4]) / 128,
                                  f[2], (3 * f[0] - 20 * f[1] + 90 * f[2] + 60 * f[3] - 5 * f[4]) / 128,
                                  f[3], (-5 * f[0] + 28 * f[1] - 70 * f[2] + 140 * f[3] + 35 * f[4]) / 128,
                                  f[4]};
    for (std::size_t i = 1; i < 8; ++i) {
      const double slope = 0.5 * (g[i + 1] - g[i - 1]), bend = g[i + 1] - 2 * g[i] + g[i - 1];
      between = std::max(between, std::abs(g[i]));
      if (std::abs(slope) < std::abs(bend)) between = std::max(between, std::abs(g[i] - 0.5 * slope * slope / bend));
      if (i > 1) third = std::max(third, std::abs(g[i + 1] - g[i - 2] - 3 * (g[i] - g[i - 1])));
    }
  }
  /// The peak, with a reserve for what parabolas miss.
  double peak() const { return between + 0.15 * (between - most); }
};

}  // namespace bahnwerk
