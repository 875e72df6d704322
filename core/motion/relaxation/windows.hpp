#pragma once
/// Multipliers of long relaxations (relaxation.hpp), window by window: distant cells hardly influence them.
///
/// Each window is solved with free ends and extends beyond the cells in which it counts; where two windows overlap
/// their multipliers are blended. A convex combination of two sets of feasible multipliers is feasible, with Σ_k J_k
/// |λ_jk| ≤ 1.
#include <cstddef>

#include "core/motion/relaxation/relaxation.hpp"
#include "core/numeric/windows.hpp"

namespace bahnwerk {

/// A solver for problems of any length, with N axes: about 1 µs per cell of three axes.
template <int N>
class RelaxationWindows {
 public:
  /// Number of cells in which a window counts. With two or three axes a window fits the processor's cache; with more
  /// axes it would have to be so short that the overlap costs more than that saves.
  static constexpr std::size_t window = N > 3 ? 2400 : 1200;
  static constexpr std::size_t fading = 100;  ///< cells in which two windows are blended
  /// Returns the lengths of windows, in cells; each begins `options.beyond` cells before those in which it counts.
  static WindowLengths lengths(const RelaxationOptions& options) {
    return {window, options.beyond, window + options.beyond};
  }

  /// Solves the next window of the available cells `part`, which are a part of a longer problem. The window counts from
  /// cell `begin` on (0, or at least fading/2), where it continues the previous one. The multipliers of its last
  /// fading/2 cells are not final unless it is the last window.
  const RelaxationMultipliers<N>& next(const RelaxationProblem<N>& part, std::size_t begin,
                                       const RelaxationOptions& options, ProgressScope& progress);
  /// Removes the first cells of the last part.
  void drop(std::size_t cells);

 private:
  RelaxationSolver<N> solver_;
  RelaxationMultipliers<N> now_;
};

extern template class RelaxationWindows<2>;
extern template class RelaxationWindows<3>;
extern template class RelaxationWindows<5>;
extern template class RelaxationWindows<8>;

}  // namespace bahnwerk
