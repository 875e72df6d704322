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
  /// Of any number of cells. A window fits the processor's cache: 2 to 4 µs per cell of two axes, however many there
  /// are.
  RelaxationMultipliers<N> solve(const RelaxationProblem<N>& problem, const RelaxationOptions& options,
                                 ProgressScope& pulse);

 private:
  RelaxationProblem<N> part_;
  RelaxationSolver<N> solver_;
};

extern template class RelaxationWindows<2>;
extern template class RelaxationWindows<3>;
extern template class RelaxationWindows<5>;
extern template class RelaxationWindows<8>;

}  // namespace bahnwerk
