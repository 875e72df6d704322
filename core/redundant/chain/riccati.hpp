#pragma once
/// Riccati recursion for the Newton systems of a chain (chain.hpp): it minimises ½ Σ xᵀWx + gᵀx + ½ r u² + c u over the
/// steps x of the states (W diagonal) and u of the controls, subject to x⁺ = A x + B u. One factorisation serves
/// several right-hand sides.
///
/// The backward recursion has Joseph's form, which adds only positive terms, so that badly scaled rows do not destroy
/// definiteness. O(cells), about 50 ns each.
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/chain/chain.hpp"

namespace bahnwerk {

template <std::size_t order>
class Riccati {
 public:
  using State = ChainState<order>;
  using Matrix = std::array<State, order>;

  /// `steps` are the durations of the cells and must outlive this object. Only the first `free` components of the first
  /// state may change.
  Riccati(const std::vector<double>& steps, std::size_t free)
      : h_(steps), free_(free), gain_(steps.size()), inverse_(steps.size()) {}

  /// Factorises for the diagonals `node` of W (n + 1 nodes) and the weights `cell` = r (n cells). All are positive, but
  /// for r = 0, which marks a fixed control.
  void factorise(const std::vector<State>& node, const std::vector<double>& cell) {
    const std::size_t n = h_.size();
    Matrix p{};
    for (std::size_t i = 0; i < order; ++i) p[i][i] = node[n][i];
    for (std::size_t c = n; c-- > 0;) {
      const double h = h_[c];
      State b = advanced<order>(State{}, h, 1), pb{};  // B, P B
      for (std::size_t i = 0; i < order; ++i)
        for (std::size_t k = 0; k < order; ++k) pb[i] += p[i][k] * b[k];
      State& gain = gain_[c];
      const State pulled = pulled_back<order>(pb, h);  // Aᵀ P B
      if (cell[c] > 0) {
        double g = cell[c];
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
          double sum = cell[c] * gain[i] * gain[j];
          for (std::size_t k = 0; k < order; ++k) sum += closed[i][k] * pc[j][k];
          p[i][j] = p[j][i] = sum;
        }
      for (std::size_t i = 0; i < order; ++i) p[i][i] += node[c][i];
    }
    first_ = p;
  }

  /// Computes the steps for the right-hand side g = `node` (n + 1 nodes), c = `cell` (n cells). `states` receives n + 1
  /// and `controls` n steps.
  void solve(const std::vector<State>& node, const std::vector<double>& cell, std::vector<State>& states,
             std::vector<double>& controls) const {
    const std::size_t n = h_.size();
    State q = node[n];
    for (std::size_t c = n; c-- > 0;) {
      const double pull = by_control<order>(q, h_[c]) + cell[c];  // Bᵀq + c = G k0
      controls[c] = -pull * inverse_[c];
      q = pulled_back<order>(q, h_[c]);
      const double force = inverse_[c] > 0 ? pull : 0;  // q − Kᵀ G k0
      for (std::size_t i = 0; i < order; ++i) q[i] += node[c][i] - gain_[c][i] * force;
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

 private:
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
  std::size_t free_;  // number of free components of the first state
  std::vector<State> gain_;
  std::vector<double> inverse_;  // 1/(r + BᵀPB) per cell; 0 where the control is fixed
  Matrix first_{};
};

}  // namespace bahnwerk
