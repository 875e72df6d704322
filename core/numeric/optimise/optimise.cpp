#include "core/numeric/optimise/optimise.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>

namespace bahnwerk {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

bool finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

void check_sizes(const OptimisationProblem& p, std::span<const double> start) {
  const auto fits = [&](const std::vector<double>& values) { return values.empty() || values.size() == p.dimension; };
  if (p.dimension == 0 || start.size() != p.dimension || !fits(p.lower) || !fits(p.upper) || !fits(p.scale))
    throw std::invalid_argument("sizes of an optimisation problem");
}

void check(nlopt_result result) {
  if (result == NLOPT_OUT_OF_MEMORY) throw std::bad_alloc();
  if (result == NLOPT_INVALID_ARGS) throw std::logic_error("NLopt refused its arguments");
}

/// A search by NLopt in the variables z = x/scale. NLopt is C and must not be unwound: an exception of a callback stops
/// it and is passed on afterwards.
class Search {
 public:
  Search(const OptimisationProblem& problem, const OptimisationOptions& options, Progress progress)
      : problem_(problem),
        options_(options),
        progress_(progress),
        by_gradients_(options.method == OptimisationMethod::slsqp),
        nlopt_(nlopt_create(by_gradients_ ? NLOPT_LD_SLSQP : NLOPT_LN_COBYLA, static_cast<unsigned>(problem.dimension)),
               nlopt_destroy) {
    if (!nlopt_) throw std::bad_alloc();
    best_.violation = infinity;
  }

  OptimisationResult run(std::span<const double> start) {
    std::vector<double> z(start.begin(), start.end());
    for (std::size_t j = 0; j < z.size(); ++j) {
      const double low = lower(j) / scale(j), high = upper(j) / scale(j);
      check(nlopt_set_lower_bound(nlopt_.get(), static_cast<int>(j), low));
      check(nlopt_set_upper_bound(nlopt_.get(), static_cast<int>(j), high));
      z[j] = std::clamp(z[j] / scale(j), low, high);
    }
    check(nlopt_set_min_objective(nlopt_.get(), objective, this));
    const std::vector<double> tolerance(problem_.inequality.rows, options_.constraint_tolerance);
    if (const auto m = static_cast<unsigned>(tolerance.size()); m > 0)
      check(nlopt_add_inequality_mconstraint(nlopt_.get(), m, rows, this, tolerance.data()));
    check(nlopt_set_xtol_rel(nlopt_.get(), options_.step_tolerance));
    check(nlopt_set_xtol_abs1(nlopt_.get(), options_.step_tolerance));
    check(nlopt_set_maxeval(nlopt_.get(), static_cast<int>(options_.max_evaluations)));
    double value = 0;
    const nlopt_result result = nlopt_optimize(nlopt_.get(), z.data(), &value);
    if (failure_) std::rethrow_exception(failure_);
    check(result);
    OptimisationResult found{best_.x, nan, nan, evaluations_};
    if (!best_.x.empty()) found.objective = best_.objective, found.violation = best_.violation;
    return found;
  }

 private:
  struct Point {
    std::vector<double> z, x;
    double objective = 0;
    std::vector<double> rows;
    double violation = 0;
    bool defined = false;       // whether all values are finite
    bool has_gradient = false;  // whether the next two are valid and finite
    std::vector<double> gradient, jacobian;
  };

  double scale(std::size_t j) const { return problem_.scale.empty() ? 1 : problem_.scale[j]; }
  double lower(std::size_t j) const { return problem_.lower.empty() ? -infinity : problem_.lower[j]; }
  double upper(std::size_t j) const { return problem_.upper.empty() ? infinity : problem_.upper[j]; }

  static double objective(unsigned n, const double* z, double* gradient, void* data) {
    auto& search = *static_cast<Search*>(data);
    const Point* p = search.at(z, gradient != nullptr);
    const bool known = p != nullptr && p->defined;
    if (gradient != nullptr && known) std::ranges::copy(p->gradient, gradient);
    if (gradient != nullptr && !known) std::fill_n(gradient, n, 0.0);
    if (known) return p->objective;
    // Without gradients a method compares values: undefined is worse than all others.
    return search.by_gradients_ ? HUGE_VAL : search.worst_ + 1;
  }

  static void rows(unsigned m, double* values, unsigned n, const double* z, double* gradient, void* data) {
    const Point* p = static_cast<Search*>(data)->at(z, gradient != nullptr);
    const bool known = p != nullptr && p->defined;
    if (known)
      std::ranges::copy(p->rows, values);
    else
      std::fill_n(values, m, HUGE_VAL);
    if (gradient == nullptr) return;
    if (known)
      std::ranges::copy(p->jacobian, gradient);
    else
      std::fill_n(gradient, m * n, 0.0);
  }

  /// Returns the values at z; null: the search is to end. Callbacks run only where z or the gradients are new.
  const Point* at(const double* z, bool gradients) {
    if (failure_ || stopped_) return nullptr;
    try {
      const std::span<const double> point(z, problem_.dimension);
      stopped_ = !finite(point);
      const bool known = evaluations_ > 0 && std::ranges::equal(point, point_.z);
      if (!stopped_ && (!known || (gradients && point_.defined && !point_.has_gradient))) evaluate(point, gradients);
      stopped_ = stopped_ || (gradients && point_.defined && !point_.has_gradient);
      if (!stopped_) return &point_;
    } catch (...) {
      failure_ = std::current_exception();
    }
    nlopt_force_stop(nlopt_.get());
    return nullptr;
  }

  void evaluate(std::span<const double> z, bool gradients) {
    progress_.report("optimise",
                     std::min(1.0, static_cast<double>(evaluations_) /
                                       static_cast<double>(std::max<std::size_t>(options_.max_evaluations, 1))));
    const std::size_t n = problem_.dimension, m = problem_.inequality.rows;
    point_.defined = point_.has_gradient = false;  // a callback may throw
    point_.z.assign(z.begin(), z.end());
    point_.x.resize(n);
    for (std::size_t j = 0; j < n; ++j) point_.x[j] = std::clamp(z[j] * scale(j), lower(j), upper(j));
    point_.gradient.assign(gradients ? n : 0, nan);
    point_.jacobian.assign(gradients ? n * m : 0, nan);
    point_.rows.assign(m, nan);
    ++evaluations_;
    point_.objective = problem_.objective(point_.x, point_.gradient) / problem_.objective_scale;
    if (m > 0) problem_.inequality.evaluate(point_.x, point_.rows, point_.jacobian);
    point_.violation = 0;
    for (const double c : point_.rows) point_.violation = std::max(point_.violation, c);
    for (std::size_t j = 0; gradients && j < n; ++j) {
      point_.gradient[j] *= scale(j) / problem_.objective_scale;
      for (std::size_t i = 0; i < m; ++i) point_.jacobian[i * n + j] *= scale(j);
    }
    point_.defined = std::isfinite(point_.objective) && finite(point_.rows);
    point_.has_gradient = point_.defined && gradients && finite(point_.gradient) && finite(point_.jacobian);
    if (point_.defined) remember();
  }

  void remember() {
    const double f = point_.objective * problem_.objective_scale, tolerance = options_.constraint_tolerance;
    const bool feasible = point_.violation <= tolerance, was = best_.violation <= tolerance;
    worst_ = best_.x.empty() ? point_.objective : std::max(worst_, point_.objective);
    if (best_.x.empty() || (feasible && was ? f < best_.objective : point_.violation < best_.violation && !was))
      best_ = {point_.x, f, point_.violation, 0};
  }

  const OptimisationProblem& problem_;
  const OptimisationOptions& options_;
  Progress progress_;
  bool by_gradients_;
  std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> nlopt_;
  Point point_;
  OptimisationResult best_;
  double worst_ = 0;  // scaled
  std::size_t evaluations_ = 0;
  std::exception_ptr failure_;
  bool stopped_ = false;
};

}  // namespace

OptimisationResult minimise(const OptimisationProblem& problem, std::span<const double> start,
                            const OptimisationOptions& options, Progress progress) {
  check_sizes(problem, start);
  return Search(problem, options, progress).run(start);
}

}  // namespace bahnwerk
