#include "core/cam/optimal/task/given_sections.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/cam/classical/classical_sections.hpp"
#include "core/cam/classical/half_law.hpp"
#include "core/cam/optimal/task/extrema.hpp"
#include "core/cam/optimal/task/section_basis.hpp"
#include "core/cam/spline/spline_faults.hpp"

namespace bahnwerk::cam {
namespace {

/// Lowest and highest s^(order) of a given section.
Range extremes_of(const GivenSection& section, int order) {
  Range out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < section.bernstein.size(); ++i) {
    std::vector<double> b = section.bernstein[i];
    for (int r = 0; r < order; ++r) {
      differentiate_bernstein(b);
      for (double& value : b) value /= section.breaks[i + 1] - section.breaks[i];
    }
    out.max = std::max(out.max, greatest_value(b).value);
    for (double& value : b) value = -value;
    out.min = std::min(out.min, -greatest_value(b).value);
  }
  return out;
}

/// Returns the law over the parameter 0 … 1, with positions in the task's units.
LawTask::Given over_unit(const LawTask& task, GivenSection law) {
  const double first = law.breaks.front(), length = law.breaks.back() - first;
  for (double& t : law.breaks) t = (t - first) / length;
  law.breaks.back() = 1;
  for (auto& piece : law.bernstein)
    for (double& b : piece) b = (b - task.origin) / task.unit_position;
  LawTask::Given out{std::move(law), {}};
  for (int r = 1; r < limited_orders; ++r) {
    const Range range = extremes_of(out.law, r);
    out.peak[static_cast<std::size_t>(r)] = std::max(range.max, -range.min);
  }
  return out;
}

/// Faults where a given section leaves its limits, which need no row otherwise.
void check_limits(const LawTask& task, const MotionLawProblem& problem, std::size_t section, double length,
                  std::vector<InputFault>& faults) {
  for (int r = 0; r < limited_orders; ++r) {
    const Range& limit = task.limits[section][static_cast<std::size_t>(r)];
    if (limit.free()) continue;
    const double factor = std::pow(length, -r);
    Range law = extremes_of(task.given[section]->law, r);
    law = {factor * law.min, factor * law.max};
    const double slack = 1e-9 * std::max({1.0, std::abs(law.min), std::abs(law.max)});
    const bool low = law.min < limit.min - slack;
    if (!low && law.max <= limit.max + slack) continue;
    const double reached = (low ? law.min : law.max) / task.to_task(r) + (r == 0 ? task.origin : 0);
    faults.push_back({{"points", std::to_string(section), "section", order_name(r)},
                      std::string("the law ") + name_of<ClassicalLaw>(*problem.points[section].law, classical_laws) +
                          " of this section reaches " + std::to_string(reached) +
                          ": widen the limit or take another law"});
  }
}

}  // namespace

bool section_stretches(const MotionLawProblem& problem, std::size_t section) {
  const MotionPoint& point = problem.points[section];
  if (!point.law || *point.law == ClassicalLaw::straight || *point.law == ClassicalLaw::quadratic ||
      *point.law == ClassicalLaw::simple_harmonic || !whole_law(*point.law).empty() ||
      (*point.law == ClassicalLaw::sine_straight_combination && point.fractions.b == 0))
    return false;
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (!point.section[r].free()) return false;
  const int resting = *point.law == ClassicalLaw::polynomial_4567 ? 3 : 2;
  for (const std::size_t p : {section, problem.end_point(section)}) {
    const bool inner = problem.periodic || (p > 0 && p + 1 < problem.points.size());
    if (inner && problem.continuity(p) > resting) return false;
    for (int r = 1; r < static_cast<int>(problem.points[p].values.size()); ++r)
      if (problem.points[p].value(r).fixed() && problem.points[p].value(r).min != 0) return false;
  }
  return true;
}

void add_given_sections(const MotionLawProblem& problem, LawTask& task) {
  std::vector<double> at;
  for (const Range& range : task.at)
    at.push_back(problem.points.front().at.min + (range.min + range.max) / 2 * problem.length / task.cycle);
  for (std::size_t p = 0; p < at.size(); ++p)
    if (problem.points[p].at.fixed()) at[p] = problem.points[p].at.min;
  auto given = classical_sections(problem, section_times(problem, at));
  if (given.empty()) return;
  task.given.resize(task.sections());
  std::vector<InputFault> faults;
  for (std::size_t s = 0; s < task.sections(); ++s) {
    if (!given[s]) continue;
    const double length = (given[s]->breaks.back() - given[s]->breaks.front()) / task.unit_time;
    task.given[s] = over_unit(task, *given[s]);
    check_limits(task, problem, s, length, faults);
    task.limits[s] = {};
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  for (std::size_t p = 0; p < task.points(); ++p) {
    const std::size_t before = task.section_before(p), behind = task.section_behind(p);
    const bool given_before = task.is_given(before), given_behind = task.is_given(behind);
    if (!given_before && !given_behind) continue;
    std::erase_if(task.conditions, [&](const LawTask::Condition& condition) { return condition.point == p; });
    const std::size_t open = given_before ? behind : before, known = given_before ? before : behind;
    if (open == LawTask::none || task.is_given(open)) continue;
    const bool exact =
        section_stretches(problem, known);  // whether the known section stretches with the angles of its ends
    for (int r = 0; r <= task.continuity[p]; ++r) {
      const double more = r == 0 && given_before ? problem.travel_at_end(known) : 0;  // conditions are of the point
      const double value =
          (given[known]->end_value(given_before, r) - (r == 0 ? task.origin + more : 0)) * task.to_task(r);
      const double rounded = r > 0 && exact ? 0 : value;
      task.conditions.push_back({p, r, {rounded, rounded}, known});
    }
  }
}

}  // namespace bahnwerk::cam
