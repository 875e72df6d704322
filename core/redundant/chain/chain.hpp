#pragma once
/// Discrete-time optimal control problem of one axis: a chain of integrators with box constraints on states and
/// controls. It is the convex problem behind the split of a head's motion into a coarse and a fine motion.
///
/// Order 2 has the state (position, velocity) and the control acceleration; order 3 has the state (position, velocity,
/// acceleration) and the control jerk. The control is constant in each cell, so each cell carries a polynomial. Each
/// end is at rest or free inside its box; the begin may also be a given state. The objective is `energy_weight`·½ Σ
/// h·a² (the acceleration's energy; trapezoidal rule for order 3) plus `penalty` times the sum of the amounts by which
/// states exceed their boxes. Controls never exceed theirs.
///
/// All numbers are dimensionless: lengths are divided by the stroke S, times by √(S/A) with the coarse acceleration A.
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

/// The problem's data: n cells between n + 1 nodes. Ranges of states may be infinite on one or both sides; ranges of
/// controls are finite and not empty. At an end at rest the derivatives are 0 whatever their ranges say.
template <std::size_t order>
struct Chain {
  std::vector<double> steps;                     ///< duration of each cell, positive
  std::vector<std::array<Range, order>> states;  ///< at each node
  std::vector<Range> controls;                   ///< in each cell
  double energy_weight = 1;                      ///< weight of ½ Σ h·a² in the objective
  bool begins_at_rest = true, ends_at_rest = true;
  std::optional<ChainState<order>> begin = {};  ///< the given first state, if any
  std::size_t cells() const { return steps.size(); }
  /// Returns how many components of the first state are free.
  std::size_t free_at_begin() const { return begin ? 0 : begins_at_rest ? 1 : order; }
  /// Tells whether the box of state component k at a node is a constraint (it is none where that component is given).
  bool counts(std::size_t node, std::size_t k) const {
    if (node == 0 && begin) return false;
    return k == 0 || ((node > 0 || !begins_at_rest) && (node < cells() || !ends_at_rest));
  }
};

/// Returns the state at the end of a cell of duration h that begins with state x and has the constant control u.
template <std::size_t order>
ChainState<order> advanced(const ChainState<order>& x, double h, double u) {
  if constexpr (order == 2)
    return {x[0] + h * (x[1] + 0.5 * h * u), x[1] + h * u};
  else
    return {x[0] + h * (x[1] + h * (0.5 * x[2] + h * u / 6)), x[1] + h * (x[2] + 0.5 * h * u), x[2] + h * u};
}
/// Returns the gradient with respect to the state at the begin of a cell from the gradient g with respect to the state
/// at its end (the transpose of `advanced`).
template <std::size_t order>
ChainState<order> pulled_back(const ChainState<order>& g, double h) {
  if constexpr (order == 2)
    return {g[0], g[1] + h * g[0]};
  else
    return {g[0], g[1] + h * g[0], g[2] + h * (g[1] + 0.5 * h * g[0])};
}
/// Returns the gradient with respect to a cell's control from the gradient g with respect to the state at its end.
template <std::size_t order>
double by_control(const ChainState<order>& g, double h) {
  if constexpr (order == 2)
    return h * (g[1] + 0.5 * h * g[0]);
  else
    return h * (g[2] + h * (0.5 * g[1] + h * g[0] / 6));
}

}  // namespace bahnwerk
