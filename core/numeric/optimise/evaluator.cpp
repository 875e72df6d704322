#include "core/numeric/optimise/evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

bool finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

std::vector<double> or_else(const std::vector<double>& given, std::size_t n, double value) {
  return given.empty() ? std::vector<double>(n, value) : given;
}

}  // namespace

OptimisationEvaluator::OptimisationEvaluator(const OptimisationProblem& problem, const OptimisationOptions& options,
                                             Progress progress)
    : problem_(problem),
      options_(options),
      progress_(progress),
      scale_(or_else(problem.scale, problem.dimension, 1)),
      row_scale_(or_else(problem.inequality.scale, problem.inequality.rows, 1)),
      lower_(or_else(problem.lower, problem.dimension, -infinity)),
      upper_(or_else(problem.upper, problem.dimension, infinity)) {
  const std::vector<double> equality_scale = or_else(problem.equality.scale, problem.equality.rows, 1);
  row_scale_.insert(row_scale_.end(), equality_scale.begin(), equality_scale.end());
  lower_ = scaled(lower_);
  upper_ = scaled(upper_);
  point_.x.resize(problem.dimension);
  point_.rows.resize(row_scale_.size());
  best_.violation = infinity;
}

std::vector<double> OptimisationEvaluator::scaled(std::span<const double> x) const {
  std::vector<double> z(x.begin(), x.end());
  for (std::size_t j = 0; j < z.size(); ++j) z[j] /= scale_[j];
  return z;
}

const OptimisationPoint& OptimisationEvaluator::at(std::span<const double> z, bool gradients) {
  const bool known = evaluations_ > 0 && std::ranges::equal(z, point_.z);
  if (!known || (gradients && point_.defined && !point_.has_gradient)) values(z, gradients);
  return point_;
}

void OptimisationEvaluator::report() {
  progress_.report("optimise", 1 - static_cast<double>(left()) /
                                       static_cast<double>(std::max<std::size_t>(options_.max_evaluations, 1)));
}

void OptimisationEvaluator::values(std::span<const double> z, bool gradients) {
  report();
  const std::size_t n = problem_.dimension, inequalities = problem_.inequality.rows, rows = row_scale_.size();
  point_.defined = false;  // a callback may throw
  point_.has_gradient = false;
  point_.z.assign(z.begin(), z.end());
  for (std::size_t j = 0; j < n; ++j) {
    point_.x[j] = z[j] * scale_[j];
    if (!problem_.lower.empty()) point_.x[j] = std::max(point_.x[j], problem_.lower[j]);
    if (!problem_.upper.empty()) point_.x[j] = std::min(point_.x[j], problem_.upper[j]);
  }
  point_.gradient.assign(gradients ? n : 0, nan);
  point_.jacobian.assign(gradients ? n * rows : 0, nan);
  std::ranges::fill(point_.rows, nan);
  ++evaluations_;
  point_.objective = problem_.objective(point_.x, point_.gradient) / problem_.objective_scale;
  const std::span<double> c(point_.rows), jacobian(point_.jacobian);
  const std::size_t split = gradients ? n * inequalities : 0;
  if (inequalities > 0) problem_.inequality.evaluate(point_.x, c.first(inequalities), jacobian.first(split));
  if (rows > inequalities) problem_.equality.evaluate(point_.x, c.subspan(inequalities), jacobian.subspan(split));

  point_.violation = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    c[i] /= row_scale_[i];
    point_.violation = std::max(point_.violation, i < inequalities ? c[i] : std::abs(c[i]));
    for (std::size_t j = 0; gradients && j < n; ++j) jacobian[i * n + j] *= scale_[j] / row_scale_[i];
  }
  for (std::size_t j = 0; gradients && j < n; ++j) point_.gradient[j] *= scale_[j] / problem_.objective_scale;
  point_.defined = std::isfinite(point_.objective) && finite(c);
  point_.has_gradient = point_.defined && gradients && finite(point_.gradient) && finite(point_.jacobian);
  if (point_.defined) remember();
}

void OptimisationEvaluator::remember() {
  const bool first = !best_.defined;
  worst_ = first ? point_.objective : std::max(worst_, point_.objective);
  min_ = first ? point_.objective : std::min(min_, point_.objective);
  worst_violation_ = std::max(worst_violation_, point_.violation);
  const double tolerance = options_.constraint_tolerance;
  const bool feasible = point_.violation <= tolerance, was = best_.violation <= tolerance;
  if (first || (feasible && was ? point_.objective < best_.objective : point_.violation < best_.violation && !was)) {
    best_.z = point_.z;
    best_.x = point_.x;
    best_.objective = point_.objective;
    best_.violation = point_.violation;
    best_.defined = true;
  }
}

}  // namespace bahnwerk
