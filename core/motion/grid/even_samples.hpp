#pragma once
/// What five even samples of a smooth function over a cell tell about its peak.
#include <array>
#include <cstddef>

#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// Largest |f| of five even samples; from `worth` on also what lies between them: the quartic through them gives four
/// more samples, parabolas the peaks between these nine. L: a number, or one per axis.
template <class L>
struct EvenSamples {
  L most;     ///< of the five
  L between;  ///< of all, with the peaks of the parabolas; = most if no `most` reaches `worth`
  L third;    ///< largest third difference of the nine: a cubic may pass a parabola through its neighbours by
              ///< 0.065 of it; 0 if no `most` reaches `worth`

  EvenSamples(const std::array<L, 5>& f, double worth) {
    most = magnitude(f[0]);
    for (std::size_t i = 1; i < 5; ++i) most = larger(most, magnitude(f[i]));
    between = most;
    third = 0.0 * most;
    if (largest(most) < worth) return;
    constexpr double part = 1.0 / 128;
    const std::array<L, 9> g{f[0], (35.0 * f[0] + 140.0 * f[1] - 70.0 * f[2] + 28.0 * f[3] - 5.0 * f[4]) * part,
                             f[1], (-5.0 * f[0] + 60.0 * f[1] + 90.0 * f[2] - 20.0 * f[3] + 3.0 * f[4]) * part,
                             f[2], (3.0 * f[0] - 20.0 * f[1] + 90.0 * f[2] + 60.0 * f[3] - 5.0 * f[4]) * part,
                             f[3], (-5.0 * f[0] + 28.0 * f[1] - 70.0 * f[2] + 140.0 * f[3] + 35.0 * f[4]) * part,
                             f[4]};
    for (std::size_t i = 1; i < 8; ++i) {
      const L slope = 0.5 * (g[i + 1] - g[i - 1]), bend = g[i + 1] - 2.0 * g[i] + g[i - 1];
      between = larger(between, magnitude(g[i]));
      // (no peak where bend is 0: that division's outcome is not used)
      between =
          larger(between, where_less(magnitude(slope), magnitude(bend), magnitude(g[i] - 0.5 * slope * slope / bend)));
      if (i > 1) third = larger(third, magnitude(g[i + 1] - g[i - 2] - 3.0 * (g[i] - g[i - 1])));
    }
  }
  /// The peak, with a reserve for what parabolas miss.
  L peak() const { return between + 0.15 * (between - most); }
};

}  // namespace bahnwerk
