#include "core/numeric/optimise/optimise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "core/numeric/optimise/elastic.hpp"
#include "core/numeric/optimise/evaluator.hpp"
#include "core/numeric/optimise/kkt.hpp"
#include "core/numeric/optimise/nlopt_search.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int tightenings = 3, searches = 8;

bool by_gradients(OptimisationMethod method) {
  return method == OptimisationMethod::slsqp || method == OptimisationMethod::mma;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

void check(const OptimisationProblem& p, std::span<const double> start, const OptimisationOptions& options) {
  const auto fits = [](const std::vector<double>& values, std::size_t n) {
    return values.empty() || values.size() == n;
  };
  const auto positive = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double v) { return v > 0 && std::isfinite(v); });
  };
  const auto is_nan = [](double v) { return std::isnan(v); };
  require(start.size() == p.dimension && std::ranges::all_of(start, [](double v) { return std::isfinite(v); }),
          "start");
  require(fits(p.lower, p.dimension) && fits(p.upper, p.dimension), "number of bounds");
  require(std::ranges::none_of(p.lower, is_nan) && std::ranges::none_of(p.upper, is_nan), "bounds that are NaN");
  require(fits(p.scale, p.dimension) && fits(p.inequality.scale, p.inequality.rows) &&
              fits(p.equality.scale, p.equality.rows),
          "number of scales");
  require(
      positive(p.scale) && positive(p.inequality.scale) && positive(p.equality.scale) && positive({p.objective_scale}),
      "scales have to be positive");
  require(
      p.objective && (p.inequality.rows == 0 || p.inequality.evaluate) && (p.equality.rows == 0 || p.equality.evaluate),
      "a callback is missing");
  require(positive({options.step_tolerance, options.kkt_tolerance, options.constraint_tolerance}),
          "tolerances have to be positive");
  if (options.method == OptimisationMethod::mma) require(p.equality.rows == 0, "mma takes no equalities");
  if (options.method == OptimisationMethod::direct_l)
    require(p.equality.rows + p.inequality.rows == 0, "direct_l takes no constraints");
  if (options.method == OptimisationMethod::isres || options.method == OptimisationMethod::direct_l)
    for (const auto* bounds : {&p.lower, &p.upper})
      require(bounds->size() == p.dimension && std::ranges::all_of(*bounds, [](double v) { return std::isfinite(v); }),
              "isres and direct_l need finite bounds");
}

/// The state of a call of minimise().
class Solve {
 public:
  Solve(const OptimisationProblem& problem, const OptimisationOptions& options, Progress progress)
      : options_(options), progress_(progress), evaluator_(problem, options, progress), random_(options.seed) {}

  OptimisationResult run(std::span<const double> start, bool allow_elastic) {
    std::vector<double> z = within(evaluator_.scaled(start));
    if (!find_values(z)) return result(OptimisationStatus::undefined);
    if (!any_free()) return result(feasible() ? OptimisationStatus::converged : OptimisationStatus::infeasible, 0);
    if (!by_gradients(options_.method)) return once(z);

    double step = options_.step_tolerance;
    bool broken = true;
    for (int k = 0; k < searches; ++k) {
      const SearchEnd end = nlopt_search(evaluator_, options_, step, z);
      broken = broken && end == SearchEnd::broken;
      if (confirm(z) || (z != evaluator_.best().z && confirm(evaluator_.best().z))) return confirmed_;
      if (end == SearchEnd::evaluations || evaluator_.left() == 0)
        return result(OptimisationStatus::evaluation_limit, confirmed_.kkt_residual);
      if (!feasible() && allow_elastic) {
        allow_elastic = false;
        OptimisationResult least = min_violation();
        if (least.status == OptimisationStatus::infeasible) return least;
        z = evaluator_.best().z;
        continue;
      }
      z = evaluator_.best().z;
      step = std::max(step * 1e-2, 1e-15);
      if (k >= tightenings) z = near(z, 1e-4 * std::pow(8, k - tightenings));
    }
    return result(broken ? OptimisationStatus::undefined : OptimisationStatus::stalled, confirmed_.kkt_residual);
  }

 private:
  bool feasible() const { return evaluator_.best().violation <= options_.constraint_tolerance; }

  bool any_free() const {
    for (std::size_t j = 0; j < evaluator_.problem().dimension; ++j)
      if (evaluator_.lower(j) < evaluator_.upper(j)) return true;
    return false;
  }

  std::vector<double> within(std::vector<double> z) const {
    for (std::size_t j = 0; j < z.size(); ++j) z[j] = std::clamp(z[j], evaluator_.lower(j), evaluator_.upper(j));
    return z;
  }

  std::vector<double> near(std::vector<double> z, double distance) {
    for (double& v : z) v += distance * std::max(1.0, std::abs(v)) * random_.normal();
    return within(std::move(z));
  }

  /// Looks around `z` for a point with finite values.
  bool find_values(std::vector<double>& z) {
    const std::vector<double> start = z;
    for (int k = 0; k < 100; ++k) {
      if (evaluator_.at(z, false).defined) return true;
      if (evaluator_.left() == 0) break;
      z = near(start, std::pow(10, k % 5 - 3));
    }
    return false;
  }

  OptimisationResult once(std::vector<double> z) {
    const SearchEnd end = nlopt_search(evaluator_, options_, options_.step_tolerance, z);
    if (end == SearchEnd::evaluations) return result(OptimisationStatus::evaluation_limit);
    return result(feasible() ? OptimisationStatus::search_ended : OptimisationStatus::infeasible);
  }

  /// Returns whether `z` is feasible, as good as the best point seen, and satisfies the KKT conditions; fills
  /// confirmed_.
  bool confirm(const std::vector<double>& z) {
    confirmed_.kkt_residual = nan;
    const OptimisationPoint& point = evaluator_.at(z, true);
    const double best = evaluator_.best().objective;
    if (!point.has_gradient || point.violation > options_.constraint_tolerance) return false;
    if (point.objective > best + options_.kkt_tolerance * std::max(1.0, std::abs(best))) return false;
    confirmed_ = {OptimisationStatus::converged,
                  point.x,
                  point.objective * evaluator_.problem().objective_scale,
                  point.violation,
                  kkt_residual(evaluator_, point),
                  evaluator_.evaluations()};
    return confirmed_.kkt_residual <= options_.kkt_tolerance;
  }

  /// Infeasible where the largest violation has a confirmed local minimum above the tolerance; the evaluator has seen
  /// the point.
  OptimisationResult min_violation() {
    const OptimisationProblem elastic = elastic_problem(evaluator_.problem());
    OptimisationOptions options = options_;
    options.method = OptimisationMethod::slsqp;
    options.max_evaluations = evaluator_.left();
    std::vector<double> start = evaluator_.best().x;
    start.push_back(evaluator_.best().violation);
    OptimisationResult least = Solve(elastic, options, progress_).run(start, false);
    evaluator_.count(least.evaluations);
    least.x.pop_back();
    evaluator_.at(evaluator_.scaled(least.x), false);
    const bool proven =
        least.status == OptimisationStatus::converged && least.objective > options_.constraint_tolerance;
    return result(proven ? OptimisationStatus::infeasible : OptimisationStatus::stalled, least.kkt_residual);
  }

  OptimisationResult result(OptimisationStatus status, double kkt = nan) const {
    const OptimisationPoint& best = evaluator_.best();
    if (!best.defined) return {.status = status, .x = best.x, .evaluations = evaluator_.evaluations()};
    return {status,         best.x, best.objective * evaluator_.problem().objective_scale,
            best.violation, kkt,    evaluator_.evaluations()};
  }

  const OptimisationOptions& options_;
  Progress progress_;
  OptimisationEvaluator evaluator_;
  Random random_;
  OptimisationResult confirmed_;
};

}  // namespace

OptimisationResult minimise(const OptimisationProblem& problem, std::span<const double> start,
                            const OptimisationOptions& options, Progress progress) {
  check(problem, start, options);
  OptimisationResult contradiction{OptimisationStatus::infeasible, {start.begin(), start.end()}, nan, 0, nan, 0};
  for (std::size_t j = 0; j < problem.dimension && !problem.lower.empty() && !problem.upper.empty(); ++j) {
    const double low = problem.lower[j], high = problem.upper[j];
    contradiction.x[j] = low > high ? std::midpoint(low, high) : std::clamp(start[j], low, high);
    if (low > high)
      contradiction.violation =
          std::max(contradiction.violation, (low - high) / 2 / (problem.scale.empty() ? 1 : problem.scale[j]));
  }
  if (contradiction.violation > 0) return contradiction;
  return Solve(problem, options, progress).run(start, true);
}

}  // namespace bahnwerk
