#pragma once
/// The convex problem behind the fastest jerk-limited motion along a path, and its multipliers.
///
/// With b = v², the axes q over the path length s, and c = 1/v, axis k has the acceleration a_k = q″_k b + q′_k b′/2,
/// and its jerk is a_k′/c. Time is ∫ c ds. The limits |a_k′| ≤ J_k c and |a_k| ≤ A_k are linear in (b, c). Only c =
/// 1/√b is not: relaxed to c ≥ 1/√b the problem is convex. Every true motion is feasible in the relaxed problem with
/// its own duration, so no motion is faster than its optimum; where c = 1/√b everywhere, the optimum is the fastest
/// motion.
///
/// core/motion/relaxation/weak_form.hpp has the discretisation.
///
/// The problem is solved by the primal-dual interior-point method with a predictor (driver.hpp). Each T_j is eliminated
/// on its own, which leaves one pentadiagonal system for b.
#include <array>
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/relaxation/inequality.hpp"
#include "core/motion/relaxation/weak_form.hpp"
#include "core/numeric/interior_point/driver.hpp"
#include "core/numeric/lanes.hpp"
#include "core/numeric/linear/symmetric_band.hpp"

namespace bahnwerk {

/// Signed multipliers of the axes. Those of jerk belong to B-splines: index j + 1 to the one whose support is the cells
/// j − 1 … j + 1, j = −1 … n; Σ_k J_k |jerk[j][k]| ≤ 1. Those of acceleration belong to nodes.
template <int N>
struct RelaxationMultipliers {
  using Row = std::array<double, N>;
  std::vector<Row> jerk;          ///< s³/mm
  std::vector<Row> acceleration;  ///< s³/mm²
};

/// The outcome of the interior-point method.
struct RelaxationOutcome {
  int iterations = 0;
  double duration = 0;   ///< s, Σ T_j at the last iterate
  double gap = 0;        ///< complementarity relative to the duration
  double violation = 0;  ///< largest violation of rows, relative to their limits
  bool converged = false;
};

/// The options of the interior-point method.
struct RelaxationOptions {
  double gap = 1e-5, violation = 1e-6;  ///< values at which the solver stops; see RelaxationOutcome
  int iterations = 40;
  std::size_t beyond = 150;  ///< overlap of windows on each side, cells (windows.hpp)
};

/// Solver of relaxations. It reuses its memory from one problem to the next: about 0.7 (N = 2), 1.0 (3), 1.4 (5), 2.2
/// kB (8) per cell. 7 to 17 iterations, 0.1 µs each per cell of three axes as long as it fits the cache.
template <int N>
class RelaxationSolver final : InteriorPointProblem {
 public:
  using Row = std::array<double, N>;
  /// Solves a problem of at least one cell. Passes exceptions of `progress` on.
  RelaxationOutcome solve(const RelaxationProblem<N>& problem, const RelaxationOptions& options,
                          ProgressScope& progress);

  /// Returns b per cell of the last solution, mm²/s².
  std::vector<double> b() const { return {b_.begin() + 2, b_.end() - 2}; }
  /// Returns the multipliers of the last solution.
  RelaxationMultipliers<N> multipliers() const;

 private:
  InteriorPointFigures evaluate(double mu) override;
  double dual_residual() override;
  bool factor() override;
  std::optional<double> predict() override;
  StepLengths step(double mu) override;

  using Sides = Lanes<2>;  ///< values for both sides of |x| ≤ limit
  /// Spline j has the stored cells j … j + 2 as its support; place r of its support is stored as j + 2 − r.
  struct Spline {
    Inequality<double> time;
    std::array<Inequality<Sides>, N> jerk;
    double T = 0, step = 0;                  ///< variable T_j, s, and its step
    double inverse_curvature = 0, rest = 0;  ///< inverse second derivative by T; right-hand side
    std::array<double, 3> coupling{};        ///< coupling of T_j with b of the cells of its support
  };
  using Hat = std::array<Inequality<Sides>, N>;
  /// Change of the complementarity under the predictor's steps.
  struct Promise {
    double change = 0, both = 0;  ///< Σ multiplier · slack step; Σ of both steps
  };

  void take(const RelaxationProblem<N>& problem);
  void start();
  void assemble_hat(std::size_t node, Sides& products, Sides& worst);
  void assemble();
  void solve_factored();
  Promise affine();
  void correct(double target, double part);
  void follow();
  Sides hat_value(std::size_t node, std::size_t k) const;
  Sides hat_change(std::size_t node, std::size_t k, double before, double after) const;

  std::size_t cells_ = 0, rows_ = 0;
  ProgressScope* progress_ = nullptr;
  WeakForm<N> form_;
  std::vector<Spline> splines_;
  std::vector<Hat> hats_;
  std::vector<Inequality<double>> caps_;
  /// Values of the cells, with two unused cells at each end. `step_` is the right-hand side, then the relative change
  /// of b.
  std::vector<double> b_, inverse_cap_, root_, step_;
  Sides reach_{};  ///< largest −change/value of slacks and multipliers in the step
  double product_ =
      0;               ///< weight of the product of the predictor's steps: less of it where less of them could be taken
  StepLengths taken_;  ///< lengths of the last step
  SymmetricBand<2> matrix_;  ///< matrix of the step of b; rows of the unused cells are those of the identity
  Row inverse_jerk_{}, inverse_acceleration_{};
  double duration_ = 0, complementarity_ = 0, violation_ = 0;
};

extern template class RelaxationSolver<2>;
extern template class RelaxationSolver<3>;
extern template class RelaxationSolver<5>;
extern template class RelaxationSolver<8>;

}  // namespace bahnwerk
