#include "core/cam/optimal/program/spline_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/progress.hpp"

namespace bahnwerk::cam {

SplineProgram::SplineProgram(const LawTask& task, const LawBasis& basis, const std::vector<double>& times,
                             const JointReference* reference)
    : task_(task), basis_(basis), reference_(reference), times_(times), breaks_(task.breaks(times)) {
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) lengths_.push_back(breaks_[i + 1] - breaks_[i]);
  peak_border_.resize(task.groups.count());
  for (auto& borders : peak_border_)
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted(static_cast<int>(r))) borders[r] = task.largest_peak && band_.borders() > 0 ? 0 : band_.add_border(1);
  for (int r = 1; r < limited_orders; ++r)
    for (std::size_t s = 0; s < task.given.size() && counted(r); ++s) {
      if (!task.given[s]) continue;
      floors_.push_back({s, r, task.given[s]->peak_at(r, lengths_[s])});
    }
  begin_values_.resize(task.sections()), end_values_.resize(task.sections());
  for (const LawTask::Condition& condition : task.conditions) {
    if (!condition.range.fixed() || condition.order >= static_cast<int>(SectionBasis::states)) continue;
    const auto order = static_cast<std::size_t>(condition.order);
    const std::size_t before = task.section_before(condition.point), behind = task.section_behind(condition.point);
    if (before != LawTask::none)
      end_values_[before][order] = condition.range.min + (order == 0 ? task.travel_at_end(before) : 0);
    if (behind != LawTask::none) begin_values_[behind][order] = condition.range.min;
  }
  time_border_.assign(task.points(), BorderedRow::none);
  if (reference) {
    reference_x_ = variables(reference->coefficients);
    for (std::size_t i = 0; i < task.points(); ++i)
      if (reference->radius[i] > 0) time_border_[i] = band_.add_border(0);
  }
  build_equalities();
}

std::vector<double> SplineProgram::coefficients(const std::vector<double>& x) const {
  std::vector<double> out(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(basis_.size()));
  for (std::size_t s = 0; s < task_.sections(); ++s)
    for (std::size_t i = basis_.first(s); i < basis_.first(s + 1); ++i)
      out[i] *= coefficient_of_variable(lengths_[s], i - basis_.first(s));
  return out;
}

std::vector<double> SplineProgram::variables(const std::vector<double>& coefficients) const {
  std::vector<double> out = coefficients;
  for (std::size_t s = 0; s < task_.sections(); ++s)
    for (std::size_t i = basis_.first(s); i < basis_.first(s + 1); ++i)
      out[i] /= coefficient_of_variable(lengths_[s], i - basis_.first(s));
  return out;
}

SplineResult SplineProgram::solve(const SplineOptions& options, Progress progress,
                                  const std::vector<LawSample>* samples) {
  SplineResult result;
  result.breaks = breaks_;
  initial_samples();
  initial_ = samples_.size();
  if (samples)
    for (const LawSample& sample : *samples) samples_.push_back({sample});
  if (!find_start()) return result;
  // Units from the first law's own peaks, the objective's from its J.
  evaluate(result, false);
  set_units(result);
  set_peaks(result, 1.2);
  start_ = point_.x;
  add_rows();
  center(1);
  const double first_objective = std::max(result.objective, 1e-300);
  double gap = 1, distance = 1, last_distance = std::numeric_limits<double>::infinity();
  int stalled = 0, failed = 0, polishing = 0;
  SplineResult best;
  for (;; ++result.rounds) {
    InteriorPointOptions interior;
    interior.gap = std::max(options.gap * 0.05, std::min(1e-3, 0.02 * distance));
    interior.primal_residual = std::min(1e-9, (polishing > 0 ? 0.02 : 0.2) * options.violation);
    interior.tick = [&] { progress.report("optimal law", 0); };
    interior.max_iterations = 30;
    InteriorPointResult inner = solve_interior_point(band_, point_, interior);
    result.iterations += inner.iterations;
    // The method begins in the middle again, with the same points; where there is no law yet, farther inside, too.
    for (const double above : {1.0, 10.0}) {
      if (inner.converged || (above > 1 && best.feasible)) break;
      center(above);
      interior.max_iterations = 60;
      inner = solve_interior_point(band_, point_, interior);
      result.iterations += inner.iterations;
    }
    settle_equalities();
    evaluate(result, false);
    const double lower = settle_multipliers(result);
    if (std::isfinite(lower) && (result.rounds == 0 || lower > result.lower)) result.lower = lower;
    // A law that keeps the limits is kept until a better one is found.
    const bool finite = std::all_of(point_.x.begin(), point_.x.end(), [](double x) { return std::isfinite(x); });
    if (!finite) {  // another set of samples may give a finite law
      if (++failed > 2) break;
      exchange();
      add_rows();
      center(1);
      continue;
    }
    const bool holds = result.violation <= options.violation;
    if (!best.feasible ||
        (holds && (best.violation > options.violation || (polishing == 0 && result.objective < best.objective))) ||
        (!holds && best.violation > options.violation && result.violation < best.violation) ||
        (polishing > 0 && holds && result.limit_violation < best.limit_violation &&
         result.objective - std::max(result.lower, 0.0) <= options.gap * result.objective)) {
      best.feasible = true;
      best.objective = result.objective;
      best.violation = result.violation;
      best.limit_violation = result.limit_violation;
      best.coefficients = point_.x;
    }
    gap = (best.objective - std::max(result.lower, 0.0)) / std::max(best.objective, 1e-3 * first_objective);
    // Limits of sections of many pieces are looked at in parts of what a piece moves: two more rounds for them.
    if (gap <= options.gap && best.violation <= options.violation &&
        (best.limit_violation <= 0.05 * options.violation || ++polishing > 2))
      break;
    if ((!inner.converged && ++failed > 2) || result.rounds + 1 >= options.max_rounds) break;
    // Distance of this law, which may leave limits by little, from the optimum: the next program has to be worth it.
    const double own = (result.objective - std::max(result.lower, 0.0)) / std::max(result.objective, 1e-300);
    distance = std::min(std::max(gap, best.violation), std::max({own, result.violation, 1e-10}));
    if (distance < 0.5 * last_distance) {
      last_distance = distance;
      stalled = 0;
    } else if (++stalled >= 5) {
      break;
    }
    exchange();
    add_rows();
    set_peaks(result, 1 + 0.1 * distance);
    set_point(10 * distance / static_cast<double>(point_.s.size()));
  }
  if (!best.feasible) return result;
  point_.x = best.coefficients;
  for (int pass = 0; pass < 6 && best.violation <= 1e-6; ++pass) {
    settle_points();
    evaluate(result, false);
    if (result.violation <= options.violation) break;
    exchange();  // a law that leaves a limit beside its samples gets samples there
    add_rows();
  }
  evaluate(result, true);
  if (!(result.violation <= std::max(best.violation, options.violation))) {
    point_.x = best.coefficients;
    evaluate(result, true);
  }
  // A bound above a law's own J is Farkas' certificate that no law keeps all ranges and limits.
  result.feasible = best.feasible && result.violation <= 1e-6 && result.lower <= result.objective * (1 + 1e-6);
  result.lower = std::max(result.lower, 0.0);
  result.converged =
      result.feasible &&
      result.objective - result.lower <= 1.5 * options.gap * std::max(result.objective, 1e-3 * first_objective) &&
      result.violation <= options.violation;
  result.coefficients = coefficients(point_.x);
  for (std::size_t i = initial_; i < samples_.size(); ++i)
    if (samples_[i].slack < 0.05) result.samples.push_back(samples_[i].sample);
  return result;
}

}  // namespace bahnwerk::cam
