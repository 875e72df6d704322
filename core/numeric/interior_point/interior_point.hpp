#pragma once
/// A primal–dual interior-point method for linear and convex quadratic programs with free variables:
///
///   minimise ½ xᵀQx + cᵀx so that E x = e, G x + s = g, s ≥ 0;
///   dual: maximise −½ xᵀQx − gᵀz − eᵀy so that Qx + c + Gᵀz + Eᵀy = 0, z ≥ 0.
///
/// Mehrotra's predictor–corrector method (driver.hpp) with vectors; an `InteriorPointSystem`, one class per structure,
/// assembles, factors and solves the system of a step. Cost: one factorisation and two solutions, with a step of
/// refinement each where that is requested, per iteration, 10 to 40 iterations.
#include <cstddef>
#include <vector>

#include "core/numeric/interior_point/driver.hpp"

namespace bahnwerk {

/// The program and the linear algebra of its steps.
class InteriorPointSystem {
 public:
  virtual ~InteriorPointSystem() = default;
  virtual const std::vector<double>& cost() const = 0;             ///< c; its size is the number of variables
  virtual const std::vector<double>& equality_side() const = 0;    ///< e
  virtual const std::vector<double>& inequality_side() const = 0;  ///< g
  /// Computes gx = G x, ex = E x; both already have their sizes.
  virtual void multiply(const std::vector<double>& x, std::vector<double>& gx, std::vector<double>& ex) const = 0;
  /// Computes out += Gᵀz + Eᵀy.
  virtual void add_transposed(const std::vector<double>& z, const std::vector<double>& y,
                              std::vector<double>& out) const = 0;
  /// Computes out += Q x. A linear program has Q = 0.
  virtual void add_quadratic(const std::vector<double>& /*x*/, std::vector<double>& /*out*/) const {}
  /// Assembles and factors K = [Q + GᵀWG Eᵀ; E 0] with W = diag(weights) > 0. Returns false if it is singular.
  virtual bool factor(const std::vector<double>& weights) = 0;
  /// Computes (x, y) := K⁻¹ (x, y) with the last factors.
  virtual void solve(std::vector<double>& x, std::vector<double>& y) const = 0;
};

/// An iterate; s and z are positive.
struct InteriorPoint {
  std::vector<double> x, y, s, z;
};

/// The options of the method. The gap is relative to 1 + |½ xᵀQx + cᵀx|; residuals are absolute.
struct InteriorPointOptions : InteriorPointRule {
  /// Whether slacks and multipliers take equal step lengths. A quadratic objective needs this: it couples the residuals
  /// of both.
  bool common_step = false;
  /// Whether solutions are refined (solve_refined). A positive definite K without equalities does not need it.
  bool refined = true;
};

/// Iterates from `point`, whose sizes and signs have to be right, to the optimum. Without convergence `point` is the
/// last iterate.
InteriorPointResult solve_interior_point(InteriorPointSystem& system, InteriorPoint& point,
                                         const InteriorPointOptions& options);

/// Computes (x, y) := K⁻¹ (x, y) for K with these weights, without the regularisation of its factors: the factors'
/// solution and, where rounding has lost too much (weights range over twenty powers of ten), a few steps of GMRES that
/// they precondition [Saad, A flexible inner-outer preconditioned GMRES algorithm, SIAM J. Sci. Comput. 14, 1993]. The
/// error has low rank, so 12 steps suffice.
void solve_refined(const InteriorPointSystem& system, const std::vector<double>& weights, std::vector<double>& x,
                   std::vector<double>& y);

/// A lower bound of a linear program, for any multipliers, by weak duality. Over all feasible x, cᵀx is at least value
/// − Σ |residual_k| magnitude_k where |x_k| ≤ magnitude_k: the dual infeasibility is subtracted with its largest
/// possible effect.
struct DualValue {
  double value = 0;              ///< −gᵀz − eᵀy
  std::vector<double> residual;  ///< c + Gᵀz + Eᵀy
};
/// Returns the value of the dual; negative z count as 0.
DualValue dual_value(const InteriorPointSystem& system, const std::vector<double>& y, const std::vector<double>& z);

}  // namespace bahnwerk
