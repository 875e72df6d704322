#pragma once
/// The values of an OptimisationProblem in scaled variables z = x/scale. Each point is evaluated once, and the best one
/// stored.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/numeric/optimise/optimise.hpp"

namespace bahnwerk {

/// Values of objective and constraints at a point, scaled.
struct OptimisationPoint {
  std::vector<double> z, x;  ///< x = scale · z within the bounds
  double objective = 0;
  std::vector<double> rows;   ///< inequalities, then equalities
  double violation = 0;       ///< largest violation of a row
  bool defined = false;       ///< whether all values are finite
  bool has_gradient = false;  ///< whether the next two are valid and finite
  std::vector<double> gradient, jacobian;
};

/// Evaluates a problem in scaled variables.
class OptimisationEvaluator {
 public:
  OptimisationEvaluator(const OptimisationProblem& problem, const OptimisationOptions& options, Progress progress);

  const OptimisationProblem& problem() const { return problem_; }
  std::vector<double> scaled(std::span<const double> x) const;
  double lower(std::size_t j) const { return lower_[j]; }  ///< scaled lower bound of variable j
  double upper(std::size_t j) const { return upper_[j]; }

  /// The result is valid until the next call. Callbacks run only where `z` or the gradients are new.
  const OptimisationPoint& at(std::span<const double> z, bool gradients);
  /// Returns the feasible point with the least objective, else the one with the least violation; without gradients.
  const OptimisationPoint& best() const { return best_; }
  /// Return finite values for points where the problem is undefined, worse than all others, for methods without
  /// gradients, which compare them.
  double worse_objective() const { return worst_ + (worst_ - min_) + 1; }
  double worse_row() const { return worst_violation_ + 1; }

  void report();
  std::size_t evaluations() const { return evaluations_; }
  /// Adds the evaluations of another problem that was solved on behalf of this one.
  void count(std::size_t evaluations) { evaluations_ += evaluations; }
  std::size_t left() const { return options_.max_evaluations - std::min(evaluations_, options_.max_evaluations); }

 private:
  void values(std::span<const double> z, bool gradients);
  void remember();

  const OptimisationProblem& problem_;
  const OptimisationOptions& options_;
  Progress progress_;
  std::vector<double> scale_, row_scale_, lower_, upper_;
  OptimisationPoint point_, best_;
  double worst_ = 0, min_ = 0, worst_violation_ = 0;
  std::size_t evaluations_ = 0;
};

}  // namespace bahnwerk
