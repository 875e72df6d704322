#pragma once
/// Linear-quadratic problems over a chain of integrators, by the Riccati recursion: the block elimination of their
/// optimality conditions from the last node to the first one [Rao, Wright, Rawlings, Application of interior-point
/// methods to model predictive control, J. Optim. Theory Appl. 99, 1998].
///
/// The problem: minimise ½ Σ xᵀWx + gᵀx + ½ r u² + c u over the steps x of the states (W diagonal) and u of the inputs
/// with x⁺ = A x + B u (integrator_chain.hpp). Only the first components of the first state may change; optionally the
/// derivatives are 0 at the end after the step, by one more right-hand side for each. The backward recursion has
/// Joseph's form, which adds only positive terms, so that badly scaled rows do not destroy definiteness. O(cells),
/// about 50 ns each per right-hand side.
#include <array>
#include <cstddef>
#include <vector>

#include "core/numeric/linear/integrator_chain.hpp"

namespace bahnwerk {

/// Set `weight` (W) and `cell_weight` (r), call factor(), then set `gradient` (g) and `cell_gradient` (c) and call
/// solve() as often as needed. All weights are positive, but for r = 0, which marks a fixed input.
template <std::size_t order>
class Riccati {
 public:
  using State = ChainState<order>;

  /// `steps` are the durations of the n cells and have to outlive this object; `free` components of the first state may
  /// change; `rests` asks for derivatives of 0 at the end.
  Riccati(const std::vector<double>& steps, std::size_t free, bool rests)
      : weight(steps.size() + 1),
        gradient(steps.size() + 1),
        d_states(steps.size() + 1),
        cell_weight(steps.size()),
        cell_gradient(steps.size()),
        d_controls(steps.size()),
        h_(steps),
        free_(free),
        rests_(rests),
        gain_(steps.size()),
        inverse_(steps.size()) {
    for (auto& d : end_states_) d.resize(steps.size() + 1);
    for (auto& d : end_controls_) d.resize(steps.size());
  }

  void factor() {
    const std::size_t n = h_.size();
    Matrix p{};
    for (std::size_t i = 0; i < order; ++i) p[i][i] = weight[n][i];
    for (std::size_t c = n; c-- > 0;) {
      const double h = h_[c];
      State b = advanced<order>(State{}, h, 1), pb{};  // B, P B
      for (std::size_t i = 0; i < order; ++i)
        for (std::size_t k = 0; k < order; ++k) pb[i] += p[i][k] * b[k];
      State& gain = gain_[c];
      const State pulled = pulled_back<order>(pb, h);  // Aᵀ P B
      if (cell_weight[c] > 0) {
        double g = cell_weight[c];
        for (std::size_t i = 0; i < order; ++i) g += b[i] * pb[i];
        inverse_[c] = 1 / g;
        for (std::size_t i = 0; i < order; ++i) gain[i] = pulled[i] * inverse_[c];
      } else {
        inverse_[c] = 0;
        gain = {};
      }
      Matrix closed{};  // columns of A − B K
      for (std::size_t j = 0; j < order; ++j) {
        State unit{};
        unit[j] = 1;
        closed[j] = advanced<order>(unit, h, -gain[j]);
      }
      Matrix pc{};
      for (std::size_t j = 0; j < order; ++j)
        for (std::size_t i = 0; i < order; ++i)
          for (std::size_t k = 0; k < order; ++k) pc[j][i] += p[i][k] * closed[j][k];
      for (std::size_t i = 0; i < order; ++i)
        for (std::size_t j = i; j < order; ++j) {
          double sum = cell_weight[c] * gain[i] * gain[j];
          for (std::size_t k = 0; k < order; ++k) sum += closed[i][k] * pc[j][k];
          p[i][j] = p[j][i] = sum;
        }
      for (std::size_t i = 0; i < order; ++i) p[i][i] += weight[c][i];
    }
    first_ = p;
    for (std::size_t k = 1; rests_ && k < order; ++k) {
      State unit{};
      unit[k] = 1;
      sweep([&](std::size_t node) { return node == n ? unit : State{}; }, [](std::size_t) { return 0.0; },
            end_states_[k - 1], end_controls_[k - 1]);
    }
  }

  /// Computes d_states and d_controls; from the state `end` at the end they bring its derivatives to 0 there.
  void solve(const State& end) {
    sweep([&](std::size_t node) { return gradient[node]; }, [&](std::size_t cell) { return cell_gradient[cell]; },
          d_states, d_controls);
    if (!rests_) return;
    const std::size_t n = h_.size();
    std::array<double, order - 1> nu{};
    const auto at = [&](std::size_t column, std::size_t k) { return end_states_[column][n][k]; };
    const double r1 = -(end[1] + d_states[n][1]);
    if constexpr (order == 2) {
      if (at(0, 1) != 0) nu[0] = r1 / at(0, 1);  // 0: every input is fixed
    } else {
      const double r2 = -(end[2] + d_states[n][2]);
      const double det = at(0, 1) * at(1, 2) - at(1, 1) * at(0, 2);
      if (det != 0) nu = {(r1 * at(1, 2) - r2 * at(1, 1)) / det, (at(0, 1) * r2 - at(0, 2) * r1) / det};
    }
    for (std::size_t j = 0; j + 1 < order; ++j) {
      const double f = nu[j];
      for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t k = 0; k < order; ++k) d_states[i][k] += f * end_states_[j][i][k];
      for (std::size_t c = 0; c < n; ++c) d_controls[c] += f * end_controls_[j][c];
      at_end_[j + 1] = f;
    }
  }

  /// Returns the multipliers of the condition of rest at the end, of the last solution.
  const State& at_end() const { return at_end_; }

  std::vector<State> weight, gradient, d_states;               ///< per node
  std::vector<double> cell_weight, cell_gradient, d_controls;  ///< per cell

 private:
  using Matrix = std::array<State, order>;

  /// Computes the steps without the condition of rest for the right-hand sides node(i) and cell(c).
  template <class Node, class Cell>
  void sweep(Node&& node, Cell&& cell, std::vector<State>& states, std::vector<double>& controls) const {
    const std::size_t n = h_.size();
    State q = node(n);
    for (std::size_t c = n; c-- > 0;) {
      const double pull = by_control<order>(q, h_[c]) + cell(c);  // Bᵀq + c
      controls[c] = -pull * inverse_[c];
      q = pulled_back<order>(q, h_[c]);
      const double force = inverse_[c] > 0 ? pull : 0;
      const State here = node(c);
      for (std::size_t i = 0; i < order; ++i) q[i] += here[i] - gain_[c][i] * force;
    }
    State x = states[0] = begin(q);
    for (std::size_t c = 0; c < n; ++c) {
      double u = controls[c];
      for (std::size_t i = 0; i < order; ++i) u -= gain_[c][i] * x[i];
      controls[c] = u;
      x = advanced<order>(x, h_[c], u);
      states[c + 1] = x;
    }
  }

  /// Minimises ½ xᵀPx + qᵀx over the free components of the first state, by Gaussian elimination of a positive definite
  /// matrix.
  State begin(const State& q) const {
    Matrix p = first_;
    State x{};
    for (std::size_t i = 0; i < free_; ++i) x[i] = -q[i];
    for (std::size_t i = 0; i < free_; ++i)
      for (std::size_t j = i + 1; j < free_; ++j) {
        const double f = p[j][i] / p[i][i];
        for (std::size_t k = i; k < free_; ++k) p[j][k] -= f * p[i][k];
        x[j] -= f * x[i];
      }
    for (std::size_t i = free_; i-- > 0;) {
      for (std::size_t k = i + 1; k < free_; ++k) x[i] -= p[i][k] * x[k];
      x[i] /= p[i][i];
    }
    return x;
  }

  const std::vector<double>& h_;
  std::size_t free_;
  bool rests_;
  std::vector<State> gain_;
  std::vector<double> inverse_;  // 1/(r + BᵀPB) per cell; 0 where the input is fixed
  Matrix first_{};
  std::array<std::vector<State>, order - 1> end_states_;  // responses to the multipliers at the end
  std::array<std::vector<double>, order - 1> end_controls_;
  State at_end_{};
};

}  // namespace bahnwerk
