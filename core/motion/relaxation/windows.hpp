#pragma once
/// Multipliers of long relaxations (relaxation.hpp), window by window: what is far away has no say in them.
///
/// Each window is solved on its own with free ends, some way beyond where it counts; where two overlap their
/// multipliers fade over into each other. Any mean of two sets of multipliers is one, with Σ_k J_k |λ_jk| ≤ 1 again.
#include <cstddef>

#include "core/motion/relaxation/relaxation.hpp"

namespace bahnwerk {

template <int N>
class RelaxationWindows {
 public:
  /// Cells in which it counts. With two or three axes a window fits the processor's cache; with more it would have to
  /// be so short that what it reaches beyond would cost more than that saves.
  static constexpr std::size_t window = N > 3 ? 2400 : 1200;
  static constexpr std::size_t fading = 100;  ///< cells in which two windows fade over

  /// Of any number of cells at once: about 1 µs per cell of three axes, however many there are.
  RelaxationMultipliers<N> solve(const RelaxationProblem<N>& problem, const RelaxationOptions& options,
                                 ProgressScope& pulse);

  /// Of the cells at hand, a part of a longer problem: the window counts from cell `begin` on, 0 or at least fading/2,
  /// where it goes on with the one before. Those of the last fading/2 cells in which it counts are not final unless it
  /// is the last one.
  const RelaxationMultipliers<N>& next(const RelaxationProblem<N>& part, std::size_t begin,
                                       const RelaxationOptions& options, ProgressScope& pulse);
  /// The first cells of the last part are not at hand any more.
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
