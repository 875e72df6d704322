#pragma once
/// A primal–dual interior-point method for problems whose constraints are functions:
///
///   minimise f(x) so that g(x) > 0.
///
/// Every iterate keeps all constraints strictly, so that a run may end at any iteration. A step is Newton's for
/// f − μ Σ w_i ln g_i, w_i = 1 unless given, with the multipliers λ_i of the slacks g_i in place of μ w_i/g_i in its
/// matrix; its length keeps slacks and multipliers positive, and a line search on that function shortens it [Nocedal &
/// Wright, Numerical Optimization, 19.3]. μ stays while the iterate is far from the minimum that belongs to it, and
/// then falls with Σ λ_i g_i (Fiacco & McCormick). Multipliers stay within a factor of 1000 of μ w_i/g_i [Wächter &
/// Biegler 2006, (16)]. f need not be convex: the result is a local minimum. A `FeasibleProblem` assembles and solves
/// the system of a step, with a structure of core/numeric/linear.
#include <cstddef>
#include <functional>
#include <vector>

namespace bahnwerk {

/// Where a step begins, and what is added to its system.
struct BarrierPoint {
  const std::vector<double>&slack, &multiplier;  ///< g and λ
  double mu = 0;                                 ///< weight of −Σ w ln g
  double damping = 0;                            ///< addition to the diagonal, relative to it
  /// Addition to the diagonal of those unknowns that scale others, in units of their part of f: they move less.
  double stiffness = 0;
};

/// A problem at its iterate, which it keeps itself.
class FeasibleProblem {
 public:
  virtual ~FeasibleProblem() = default;
  virtual double objective() const = 0;                 ///< f at the iterate
  virtual double scale() const { return objective(); }  ///< positive number to which gaps are relative
  /// Computes the slacks at the iterate; returns whether all are positive, otherwise `slack` is incomplete.
  virtual bool slacks(std::vector<double>& slack) const = 0;
  /// Computes Newton's step; returns false where its matrix is not positive definite. More damping makes it so.
  virtual bool step(const BarrierPoint& at) = 0;
  /// Computes the changes of the slacks along the step to first order; returns that of f.
  virtual double changes(std::vector<double>& change) const = 0;
  /// Returns the largest length of the step for which the first order says something, at most 1.
  virtual double longest() const { return 1; }
  /// Returns the number of curves from the iterate in the direction of the step that the line search tries at a length.
  virtual std::size_t curves() const { return 1; }
  /// Goes along a curve, less than curves(), as far as `length` says; returns whether the slacks are positive there.
  virtual bool go(double length, std::size_t curve, std::vector<double>& slack, double& objective) = 0;
  /// The point that go() went to last becomes the iterate.
  virtual void accept() = 0;
};

struct FeasibleOptions {
  double gap = 1e-3;    ///< the search ends where Σ λ g ≤ gap · scale, near enough to the minimum for μ
  int iterations = 60;  ///< largest number of iterations
  double start_mu = 0;  ///< first μ relative to scale / Σ w; 0: 0.3
  /// μ falls once a step gains less than this part of μ Σ w. Little of it keeps iterates away from the boundary, where
  /// steps are short, and costs further steps where f is far from convex.
  double centred = 1;
  std::vector<double> weights = {};            ///< w; none: 1
  std::vector<double> start_multipliers = {};  ///< first λ; none: μ w / g
  std::function<void()> tick = {};             ///< callback of every iteration; may throw
  /// Receives multipliers and gap after every iteration; returns whether they prove enough, which ends the search in
  /// place of the rule above. A certificate for any multipliers is the problem's own affair.
  std::function<bool(const std::vector<double>&, double)> certified = {};
};

struct FeasibleResult {
  int iterations = 0;  ///< 0: the first iterate does not keep all constraints, and stays
  double gap = 0;      ///< Σ λ g / scale
};

/// Moves the problem's iterate towards a minimum.
FeasibleResult solve_feasible(FeasibleProblem& problem, const FeasibleOptions& options);

}  // namespace bahnwerk
