#pragma once
/// An axis as a chain of integrators whose states and control are boxed: the convex problem behind the split of a
/// head's motion into a coarse and a fine one.
///
/// Order 2: state (position, velocity), control acceleration; order 3: state (position, velocity, acceleration),
/// control jerk. The control is constant in each cell, so the motion is a polynomial there and limits of what is
/// constant or linear in a cell hold between nodes because they hold at them. It begins and ends at rest,
/// or anywhere inside the boxes, or begins with a given state. What is minimised is ½ Σ h·a², the energy of the
/// acceleration (order 3: by the trapezoidal rule), plus `penalty` times the sum of what states exceed their boxes by;
/// controls never exceed theirs.
///
/// Numbers without units: lengths by a stroke S, times by √(S/A).
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace bahnwerk {

struct Range {
  double lowest = 0, highest = 0;
  double middle() const { return 0.5 * (lowest + highest); }
  double width() const { return highest - lowest; }
};

template <std::size_t order>
using ChainState = std::array<double, order>;

/// n cells between n + 1 nodes. Ranges of states may be infinite on one or both sides; ranges of controls are finite
/// and not empty. At the ends at rest derivatives are 0 whatever their ranges say.
template <std::size_t order>
struct Chain {
  std::vector<double> steps;                     ///< duration of each cell, positive
  std::vector<std::array<Range, order>> states;  ///< at each node
  std::vector<Range> controls;                   ///< in each cell
  double energy_weight = 1;                      ///< of ½ Σ h·a²
  bool begins_at_rest = true, ends_at_rest = true;
  std::optional<ChainState<order>> begin = {};  ///< the state it begins with, where that is given
  std::size_t cells() const { return steps.size(); }
  /// Tells how many numbers of the first state are free.
  std::size_t free_at_begin() const { return begin ? 0 : begins_at_rest ? 1 : order; }
  /// Tells whether the range of number k of the state at a node counts.
  bool counts(std::size_t node, std::size_t k) const {
    if (node == 0 && begin) return false;
    return k == 0 || ((node > 0 || !begins_at_rest) && (node < cells() || !ends_at_rest));
  }
};

/// Returns the state that a cell of duration h leads to.
template <std::size_t order>
ChainState<order> advanced(const ChainState<order>& x, double h, double u) {
  if constexpr (order == 2)
    return {x[0] + h * (x[1] + 0.5 * h * u), x[1] + h * u};
  else
    return {x[0] + h * (x[1] + h * (0.5 * x[2] + h * u / 6)), x[1] + h * (x[2] + 0.5 * h * u), x[2] + h * u};
}
/// Returns the gradient by the state at the begin of a cell, given that by the state at its end: `advanced` transposed.
template <std::size_t order>
ChainState<order> pulled_back(const ChainState<order>& g, double h) {
  if constexpr (order == 2)
    return {g[0], g[1] + h * g[0]};
  else
    return {g[0], g[1] + h * g[0], g[2] + h * (g[1] + 0.5 * h * g[0])};
}
/// Returns the gradient by a cell's control, given that by the state at its end.
template <std::size_t order>
double by_control(const ChainState<order>& g, double h) {
  if constexpr (order == 2)
    return h * (g[1] + 0.5 * h * g[0]);
  else
    return h * (g[2] + h * (0.5 * g[1] + h * g[0] / 6));
}

}  // namespace bahnwerk
