#include "core/plan/motion_law/planned_law.hpp"

#include <algorithm>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/active_set/angle_search.hpp"
#include "core/cam/optimal/optimal_law.hpp"

namespace bahnwerk {

double mean_velocity_bound(const cam::MotionLawProblem& problem) {
  const double weight = cam::effective_weights(problem)[1], scale = problem.seconds_per_unit();
  const cam::PeakGroups groups = problem.peak_groups();
  std::vector<double> most(groups.count());
  for (std::size_t s = 0; s < problem.sections(); ++s) {
    const std::size_t e = problem.end_point(s);
    const cam::Range from = problem.points[s].value(0), to = problem.end_position(s);
    const double way = std::max({from.min - to.max, to.min - from.max, 0.0});
    const double angle = problem.points[e].at.max - problem.points[s].at.min + (e <= s ? problem.length : 0);
    double& mean = most[groups.of_section[s]];
    mean = std::max(mean, way / (angle * scale));
  }
  double sum = 0;
  for (std::size_t g = 0; g < most.size(); ++g) sum += groups.weight[g] * most[g];
  return weight * sum;
}

namespace {

constexpr const char* mean_basis = "the mean velocity between two points is reached";

/// Bounds a law of `active_set` by what method `optimal` proves of its problem: with fixed angles it has a bound over
/// all laws. A classical law is one of these laws if its acceleration does not jump inside the section.
void bound_by_optimum(const cam::MotionLawProblem& problem, PlannedLaw& out, Progress progress) {
  constexpr std::size_t most_sections = 100;
  if (problem.sections() > most_sections) return;
  cam::MotionLawProblem same = problem;
  same.degree = std::clamp(static_cast<int>(out.solution.law.max_degree()), 5, problem.sections() > 10 ? 9 : 21);
  for (cam::MotionPoint& point : same.points) {
    if (!point.law || *point.law == cam::ClassicalLaw::straight) continue;
    if (acceleration_jumps(*point.law, point.fractions)) return;
    point.law.reset();
    point.inflection.reset();
    same.degree = 9;
  }
  same.method = cam::LawMethod::optimal;
  same.pieces = 1;
  same.objective.zero_crossing_penalty = 0;
  try {
    const cam::OptimalLaw optimal = cam::plan_optimal_law(same, progress);
    if (!optimal.solution.bound || !(optimal.solution.bound->objective > out.lower)) return;
    out.lower = std::min(optimal.solution.bound->objective, out.solution.value.objective);
    out.basis = optimal.solution.bound->basis;
  } catch (const InvalidInput&) {
  }
}

const char* text(cam::NoLaw why) {
  switch (why) {
    case cam::NoLaw::ranges:
      return "no order of turning violated ranges into values ends with a law that keeps all of them: widen a "
             "range, or use method \"optimal\"";
    case cam::NoLaw::angles:
      return "no choice of angles in their ranges has a law";
  }
  return "";
}

/// The law of `active_set`, where there is one.
std::optional<cam::LawSolution> compared_law(const cam::MotionLawProblem& problem, Progress progress) {
  if (!problem.cycle_duration || problem.has_free_angles()) return std::nullopt;
  try {
    if (auto law = cam::plan_active_set(problem, progress)) return *std::move(law);
  } catch (const InvalidInput&) {
  }
  return std::nullopt;
}

}  // namespace

PlannedLaw plan_law(const cam::MotionLawProblem& problem, Progress progress) {
  PlannedLaw out;
  if (problem.method == cam::LawMethod::optimal) {
    const Progress comparing = progress.part(0, 0.1).named("comparison");
    const Progress optimising = progress.part(0.1, 1).named("law");
    out.source = compared_law(problem, comparing);
    // active_set knows no vibration.
    const bool candidate = out.source && problem.vibration.empty();
    cam::OptimalLaw found = cam::plan_optimal_law(problem, optimising, candidate ? &*out.source : nullptr);
    out.solution = std::move(found.solution);
    if (out.solution.bound) out.lower = out.solution.bound->objective, out.basis = out.solution.bound->basis;
    cam::MotionLawProblem timed = problem;
    timed.cycle_duration = out.solution.cycle_duration;
    if (const double mean = mean_velocity_bound(timed); mean > out.lower) {
      out.lower = std::min(mean, out.solution.value.objective);
      out.basis = mean_basis;
    }
    return out;
  }
  const Progress solving = progress.part(0, 0.5).named("active_set");
  const Progress bounding = progress.part(0.5, 1).named("bound");
  auto law = cam::plan_active_set(problem, solving);
  if (!law) throw Infeasible(text(law.reason()));
  out.solution = *std::move(law);
  out.lower = mean_velocity_bound(problem);
  out.basis = mean_basis;
  bound_by_optimum(problem, out, bounding);
  return out;
}

}  // namespace bahnwerk
