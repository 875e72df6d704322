#include "core/numeric/optimise/nlopt_search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

nlopt_algorithm algorithm(OptimisationMethod method) {
  switch (method) {
    case OptimisationMethod::slsqp:
      return NLOPT_LD_SLSQP;
    case OptimisationMethod::mma:
      return NLOPT_LD_MMA;
    case OptimisationMethod::cobyla:
      return NLOPT_LN_COBYLA;
    case OptimisationMethod::isres:
      return NLOPT_GN_ISRES;
    case OptimisationMethod::direct_l:
      return NLOPT_GN_DIRECT_L;
  }
  throw std::invalid_argument("method of optimisation");
}

/// The data of NLopt's callbacks.
struct Bridge {
  OptimisationEvaluator& evaluator;
  nlopt_opt nlopt;
  bool by_gradients;
  std::exception_ptr failure = nullptr;
  bool broken = false;

  /// Null: the search is to end.
  const OptimisationPoint* point(const double* z, bool gradients) {
    if (failure || broken) return nullptr;
    try {
      const std::span<const double> at(z, evaluator.problem().dimension);
      broken = !std::ranges::all_of(at, [](double v) { return std::isfinite(v); });
      if (!broken) {
        const OptimisationPoint& found = evaluator.at(at, gradients);
        broken = gradients && found.defined && !found.has_gradient;
        if (!broken) return &found;
      }
    } catch (...) {
      failure = std::current_exception();
    }
    nlopt_force_stop(nlopt);
    return nullptr;
  }
};

double objective(unsigned n, const double* z, double* gradient, void* data) {
  auto& bridge = *static_cast<Bridge*>(data);
  const OptimisationPoint* p = bridge.point(z, gradient != nullptr);
  const bool known = p && p->defined;
  if (gradient && known) std::ranges::copy(p->gradient, gradient);
  if (gradient && !known) std::fill_n(gradient, n, 0.0);
  if (known) return p->objective;
  return p && !bridge.by_gradients ? bridge.evaluator.worse_objective() : HUGE_VAL;
}

template <bool equality>
void rows(unsigned m, double* values, unsigned n, const double* z, double* gradient, void* data) {
  auto& bridge = *static_cast<Bridge*>(data);
  const std::size_t first = equality ? bridge.evaluator.problem().inequality.rows : 0;
  const OptimisationPoint* p = bridge.point(z, gradient != nullptr);
  if (p && p->defined) {
    std::copy_n(p->rows.begin() + static_cast<std::ptrdiff_t>(first), m, values);
    if (gradient) std::copy_n(p->jacobian.begin() + static_cast<std::ptrdiff_t>(first * n), m * n, gradient);
  } else {
    std::fill_n(values, m, p && !bridge.by_gradients ? bridge.evaluator.worse_row() : HUGE_VAL);
    if (gradient) std::fill_n(gradient, m * n, 0.0);
  }
}

void check(nlopt_result result) {
  if (result == NLOPT_OUT_OF_MEMORY) throw std::bad_alloc();
  if (result == NLOPT_INVALID_ARGS) throw std::logic_error("NLopt refused its arguments");
}

}  // namespace

SearchEnd nlopt_search(OptimisationEvaluator& evaluator, const OptimisationOptions& options, double step_tolerance,
                       std::vector<double>& z) {
  const OptimisationProblem& problem = evaluator.problem();
  const auto n = static_cast<unsigned>(problem.dimension);
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> nlopt(nlopt_create(algorithm(options.method), n),
                                                                     nlopt_destroy);
  if (!nlopt) throw std::bad_alloc();
  Bridge bridge{evaluator, nlopt.get(),
                options.method == OptimisationMethod::slsqp || options.method == OptimisationMethod::mma};
  check(nlopt_set_min_objective(nlopt.get(), objective, &bridge));
  for (unsigned j = 0; j < n; ++j) {
    check(nlopt_set_lower_bound(nlopt.get(), static_cast<int>(j), evaluator.lower(j)));
    check(nlopt_set_upper_bound(nlopt.get(), static_cast<int>(j), evaluator.upper(j)));
  }
  const std::vector<double> tolerance(std::max(problem.inequality.rows, problem.equality.rows),
                                      options.constraint_tolerance);
  if (const auto m = static_cast<unsigned>(problem.inequality.rows))
    check(nlopt_add_inequality_mconstraint(nlopt.get(), m, rows<false>, &bridge, tolerance.data()));
  if (const auto m = static_cast<unsigned>(problem.equality.rows))
    check(nlopt_add_equality_mconstraint(nlopt.get(), m, rows<true>, &bridge, tolerance.data()));
  check(nlopt_set_xtol_rel(nlopt.get(), step_tolerance));
  check(nlopt_set_xtol_abs1(nlopt.get(), step_tolerance));
  check(nlopt_set_maxeval(nlopt.get(), static_cast<int>(std::clamp<std::size_t>(evaluator.left(), 1, 1 << 30))));
  // Each step of mma's dual costs about 2 ns · variables · rows without a call of Progress: about 5 ms at most.
  const double dual_step = static_cast<double>(std::max<std::size_t>(problem.dimension * problem.inequality.rows, 1));
  check(nlopt_set_param(nlopt.get(), "dual_maxeval", std::clamp(std::floor(2.5e6 / dual_step), 50.0, 10000.0)));
  // NLopt's generator is one per thread (thread-local in Debian's build; the tests solve in several threads at once).
  nlopt_srand(static_cast<unsigned long>(Random(options.seed).next() >> 32));

  double value = 0;
  const nlopt_result result = nlopt_optimize(nlopt.get(), z.data(), &value);
  if (bridge.failure) std::rethrow_exception(bridge.failure);
  if (bridge.broken) return SearchEnd::broken;
  check(result);
  return result == NLOPT_MAXEVAL_REACHED ? SearchEnd::evaluations : SearchEnd::itself;
}

}  // namespace bahnwerk
