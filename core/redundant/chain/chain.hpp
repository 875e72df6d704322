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

#include "core/numeric/linear/integrator_chain.hpp"

namespace bahnwerk {

struct Range {
  double lowest = 0, highest = 0;
  double middle() const { return 0.5 * (lowest + highest); }
  double width() const { return highest - lowest; }
};

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

}  // namespace bahnwerk
