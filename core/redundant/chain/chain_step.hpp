#pragma once
/// Newton systems of the interior-point method for chains (chain_solver.hpp): a Riccati recursion, completed by the
/// condition of rest at the end as one more right-hand side per derivative.
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/chain/chain.hpp"
#include "core/redundant/chain/riccati.hpp"

namespace bahnwerk {

/// Minimises ½ Σ xᵀWx + gᵀx + ½ r u² + c u over steps x of the states and u of the controls (riccati.hpp), subject to
/// derivatives that are 0 at the end after the step where the chain ends at rest. Set the members `weight` (W) and
/// `cell_weight` (r), call factorise(), then set `gradient` (g) and `cell_gradient` (c) and call solve() as often as
/// needed. O(cells).
template <std::size_t order>
class ChainStep {
 public:
  using State = ChainState<order>;

  /// `chain` must outlive this object.
  explicit ChainStep(const Chain<order>& chain)
      : weight(chain.states.size()),
        gradient(chain.states.size()),
        cell_weight(chain.cells()),
        cell_gradient(chain.cells()),
        d_states(chain.states.size()),
        d_controls(chain.cells()),
        chain_(chain),
        n_(chain.cells()),
        riccati_(chain.steps, chain.free_at_begin()) {
    for (auto& d : end_states_) d.resize(chain.states.size());
    for (auto& d : end_controls_) d.resize(n_);
  }

  /// Factorises, and computes the response to a multiplier of the condition of rest at the end.
  void factorise() {
    riccati_.factorise(weight, cell_weight);
    if (!chain_.ends_at_rest) return;
    unit_.resize(n_ + 1), none_.resize(n_);
    for (std::size_t k = 1; k < order; ++k) {
      unit_[n_] = {};
      unit_[n_][k] = 1;
      riccati_.solve(unit_, none_, end_states_[k - 1], end_controls_[k - 1]);
    }
  }

  /// Computes d_states and d_controls; from the state `end` at the end they bring its derivatives to 0 there.
  void solve(const State& end) {
    riccati_.solve(gradient, cell_gradient, d_states, d_controls);
    if (!chain_.ends_at_rest) return;
    std::array<double, order - 1> nu{};
    const auto at = [&](std::size_t column, std::size_t k) { return end_states_[column][n_][k]; };
    const double r1 = -(end[1] + d_states[n_][1]);
    if constexpr (order == 2) {
      if (at(0, 1) != 0) nu[0] = r1 / at(0, 1);  // 0: every control is fixed
    } else {
      const double r2 = -(end[2] + d_states[n_][2]);
      const double det = at(0, 1) * at(1, 2) - at(1, 1) * at(0, 2);
      if (det != 0) nu = {(r1 * at(1, 2) - r2 * at(1, 1)) / det, (at(0, 1) * r2 - at(0, 2) * r1) / det};
    }
    for (std::size_t j = 0; j + 1 < order; ++j) {
      const double f = nu[j];
      for (std::size_t i = 0; i <= n_; ++i)
        for (std::size_t k = 0; k < order; ++k) d_states[i][k] += f * end_states_[j][i][k];
      for (std::size_t c = 0; c < n_; ++c) d_controls[c] += f * end_controls_[j][c];
      at_end_[j + 1] = f;
    }
  }

  /// Returns the multipliers of the condition of rest at the end, of the last solution.
  const State& at_end() const { return at_end_; }

  std::vector<State> weight, gradient;
  std::vector<double> cell_weight, cell_gradient;
  std::vector<State> d_states;
  std::vector<double> d_controls;

 private:
  const Chain<order>& chain_;
  std::size_t n_;
  Riccati<order> riccati_;
  std::vector<State> unit_;   // 0 but for the last
  std::vector<double> none_;  // 0
  std::array<std::vector<State>, order - 1> end_states_;
  std::array<std::vector<double>, order - 1> end_controls_;
  State at_end_{};
};

}  // namespace bahnwerk
