#pragma once
/// Peak of a smooth function over a cell, estimated from five equidistant samples.
#include <array>
#include <cstddef>

#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// Largest |f| of five equidistant samples. From `worth` on, values between them count, too: the quartic through them
/// gives four more samples, parabolas the peaks between these nine. L is a number, or a vector of one number per axis.
template <class L>
struct EvenSamples {
  L most;     ///< largest of the five samples
  L between;  ///< largest of all nine samples and of the peaks of parabolas through them; `most` if no `most` reaches
              ///< `worth`
  L third;  ///< largest third difference of the nine samples: a cubic exceeds the parabola through its neighbours by at
            ///< most 0.065 of it; 0 if no `most` reaches `worth`

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
      const L slope = 0.5 * (g[i + 1] - g[i - 1]), second_difference = g[i + 1] - 2.0 * g[i] + g[i - 1];
      between = larger(between, magnitude(g[i]));
      // A second difference of 0 means no peak; the result of that division is not used.
      between = larger(between, where_less(magnitude(slope), magnitude(second_difference),
                                           magnitude(g[i] - 0.5 * slope * slope / second_difference)));
      if (i > 1) third = larger(third, magnitude(g[i + 1] - g[i - 2] - 3.0 * (g[i] - g[i - 1])));
    }
  }
  /// Returns the peak with a reserve for the error of the parabolas.
  L peak() const { return between + 0.15 * (between - most); }
};

}  // namespace bahnwerk
