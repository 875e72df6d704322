#include "core/cam/optimal/straight_sections.hpp"

#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/named.hpp"

namespace bahnwerk::cam {
namespace {

/// Why section `i` cannot be a limit of velocity; empty: it can.
std::string obstacle(const MotionLawProblem& problem, std::size_t i) {
  const MotionPoint &from = problem.points[i], &to = problem.points[problem.end_point(i)];
  if (*from.law != ClassicalLaw::straight)
    return std::string("method optimal keeps no ") + name_of<ClassicalLaw>(*from.law, classical_laws) +
           ": leave law out, and the section gets what makes J least, or take method active_set, which keeps the law";
  const Range a = from.value(0), b = to.value(0);
  if (!a.fixed() || !b.fixed())
    return "a straight section leads from one number to another: give the position of both of its points as a number, "
           "or take method active_set";
  if (a.min == b.min) return "";
  if (!from.at.fixed() || !to.at.fixed())
    return "the velocity of this straight section depends on angles in ranges: give both as numbers, or take method "
           "active_set";
  if (!problem.cycle_duration)
    return "the velocity of this straight section depends on the cycle's duration, which drive leaves open: give "
           "master.cycle_duration, or leave law out";
  return "";
}

}  // namespace

MotionLawProblem with_straight_sections(const MotionLawProblem& problem) {
  MotionLawProblem out = problem;
  std::vector<InputFault> faults;
  for (std::size_t i = 0; i < problem.sections(); ++i) {
    MotionPoint& point = out.points[i];
    if (!point.law) continue;
    if (std::string why = obstacle(problem, i); !why.empty()) {
      faults.push_back({{"points", std::to_string(i), "law"}, std::move(why)});
      continue;
    }
    const std::size_t end = problem.end_point(i);
    const double rise = problem.points[end].value(0).min - point.value(0).min;
    const double angle = problem.points[end].at.min - point.at.min + (end <= i ? problem.length : 0);
    const double velocity = rise == 0 ? 0 : rise / (angle * problem.seconds_per_unit());
    const Range limit = point.section[1];
    const double slack = 1e-9 * std::abs(velocity);
    if (velocity < limit.min - slack || velocity > limit.max + slack)
      faults.push_back({{"points", std::to_string(i), "section", "velocity"},
                        "leaves out the velocity of the straight section, rise by duration: widen the limit"});
    point.section[1] = {velocity, velocity};
    point.law.reset();
    point.inflection.reset();
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return out;
}

}  // namespace bahnwerk::cam
