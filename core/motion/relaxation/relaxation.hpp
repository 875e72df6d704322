#pragma once
/// The convex problem behind the fastest jerk-limited motion along a path, and its multipliers.
///
/// With b = v², the axes q over the path length s, and c = 1/v, axis k has the acceleration a_k = q″_k b + q′_k b′/2,
/// and its jerk is a_k′/c. Time is ∫ c ds. The limits |a_k′| ≤ J_k c and |a_k| ≤ A_k are linear in (b, c). Only c =
/// 1/√b is not: relaxed to c ≥ 1/√b everything is convex. Every true motion is feasible in the relaxed problem with its
/// own duration, so that no motion is faster than its optimum; where c = 1/√b everywhere, the optimum is the fastest
/// motion.
///
/// core/motion/relaxation/weak_form.hpp has the discretisation.
///
/// Solved by a primal-dual interior-point method with predictor and corrector [Mehrotra, SIAM J. Optim. 2 (1992)]. Each
/// T_j is eliminated on its own; what is left is one system of five diagonals for b.
#include <array>
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/relaxation/weak_form.hpp"

namespace bahnwerk {

/// Of axis k: of jerk per B-spline, index j + 1 for the one whose support is the cells j − 1 … j + 1, j = −1 … n, and
/// Σ_k J_k |jerk[j][k]| ≤ 1; of acceleration per node. Signed.
template <int N>
struct RelaxationMultipliers {
  using Row = std::array<double, N>;
  std::vector<Row> jerk;          ///< s³/mm
  std::vector<Row> acceleration;  ///< s³/mm²
};

struct RelaxationOutcome {
  int iterations = 0;
  double duration = 0;   ///< s, Σ T_j at the last iterate
  double gap = 0;        ///< complementarity over duration
  double violation = 0;  ///< of the rows, relative to their limits
  bool converged = false;
};

struct RelaxationOptions {
  double gap = 1e-5, violation = 1e-6;
  int iterations = 40;
  std::size_t beyond = 150;  ///< cells that windows reach beyond where they count (windows.hpp)
};

/// Keeps its memory from one problem to the next: about 0.4 (N = 2), 0.5 (3), 1.2 kB (8) per cell. 8 to 16 iterations,
/// 0.2 µs each per cell of two axes as long as it fits the cache (tests/bench/bench_jerk.cpp).
template <int N>
class RelaxationSolver {
 public:
  using Row = std::array<double, N>;
  /// Of at least one cell. Throws what progress throws.
  RelaxationOutcome solve(const RelaxationProblem<N>& problem, const RelaxationOptions& options, ProgressScope& pulse);

  /// Of the last solution: b per cell, mm²/s².
  const std::vector<double>& b() const { return b_; }
  RelaxationMultipliers<N> multipliers() const;

 private:
  /// An inequality `value` ≤ 0 with slack, multiplier, and their steps.
  struct Inequality {
    double value = 0, slack = 0, multiplier = 0, slack_step = 0, multiplier_step = 0;
    double residual() const { return value + slack; }
    double weight() const { return multiplier / slack; }
  };
  struct Spline {
    Inequality time;
    std::array<Inequality, N> plus, minus;
    double T = 0, step = 0;                        ///< and its step
    double gradient = 0, curvature = 0, rest = 0;  ///< of T; right-hand side
    std::array<double, 3> coupling{};              ///< with b of its cells
  };
  struct Hat {
    std::array<Inequality, N> plus, minus;
  };

  void take(const RelaxationProblem<N>& problem);
  void start();
  void evaluate();
  void assemble();
  void factor();
  void direction(double target, bool correct);
  void advance(double primal, double dual);
  /// The cells of spline j (as stored) by their place in its support: f(place, cell).
  template <class F>
  void support(std::size_t j, F&& f) const {
    for (std::size_t r = 0; r < 3; ++r)
      if (j >= r && j - r < cells_) f(r, j - r);
  }

  std::size_t cells_ = 0, rows_ = 0;
  ProgressScope* pulse_ = nullptr;
  WeakForm<N> form_;
  std::vector<Spline> splines_;
  std::vector<Hat> hats_;
  std::vector<Inequality> caps_;
  std::vector<double> b_, inverse_cap_, root_, step_, gradient_;
  std::vector<std::array<double, 3>> matrix_;  ///< the diagonal and two above it; factored: D, L₁, L₂
  Row inverse_jerk_{}, inverse_acceleration_{};
  double duration_ = 0, complementarity_ = 0, violation_ = 0, dual_ = 0;
  /// What the last direction allows: how far slacks and multipliers stay positive, and Σ slack · multiplier step, Σ
  /// multiplier · slack step, Σ of both steps.
  struct Reach {
    double primal = 1, dual = 1, dual_change = 0, primal_change = 0, both = 0;
  } reach_;
};

extern template class RelaxationSolver<2>;
extern template class RelaxationSolver<3>;
extern template class RelaxationSolver<5>;
extern template class RelaxationSolver<8>;

}  // namespace bahnwerk
