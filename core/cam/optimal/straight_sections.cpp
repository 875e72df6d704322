#include "core/cam/optimal/straight_sections.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/named.hpp"
#include "core/cam/classical/classical_sections.hpp"
#include "core/cam/optimal/task/given_sections.hpp"

namespace bahnwerk::cam {
namespace {

using Faults = std::vector<InputFault>;

bool is_straight(const MotionLawProblem& problem, std::size_t section) {
  return problem.points[section].law == ClassicalLaw::straight;
}
bool is_classical(const MotionLawProblem& problem, std::size_t section) {
  return problem.points[section].law && !is_straight(problem, section);
}

/// Returns why straight section `i` cannot be a limit of velocity; empty: it can.
std::string obstacle(const MotionLawProblem& problem, std::size_t i) {
  const MotionPoint &from = problem.points[i], &to = problem.points[problem.end_point(i)];
  const Range a = from.value(0), b = problem.end_position(i);
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

/// The ends of a classical section have fixed angles unless it rests there: what it ends with depends on them.
void check_angles(const MotionLawProblem& problem, std::size_t section, Faults& faults) {
  if (section_stretches(problem, section)) return;
  for (const std::size_t p : {section, problem.end_point(section)})
    if (!problem.points[p].at.fixed())
      faults.push_back(
          {{"points", std::to_string(p), "at"},
           "section " + std::to_string(section) + " follows " +
               name_of<ClassicalLaw>(*problem.points[section].law, classical_laws) +
               ", whose velocity, acceleration or jerk here, or whose limits, depend on this angle: give it "
               "as a number, or take method active_set"});
}

/// Checks that something is free between still points.
void check_still_points(const MotionLawProblem& problem, Faults& faults) {
  std::vector<std::size_t> still;
  for (std::size_t p = 0; p < problem.points.size(); ++p)
    if (problem.points[p].still) still.push_back(p);
  for (std::size_t k = 0; k < still.size(); ++k) {
    if (k + 1 == still.size() && !problem.periodic) break;
    const std::size_t from = still[k], to = still[(k + 1) % still.size()];
    bool free = false;
    std::size_t section = from;
    do {
      free = free || !problem.points[section].law;
      section = problem.end_point(section);
    } while (section != to);
    if (!free)
      faults.push_back({{"points", std::to_string(to), "still"},
                        "every section since the still point before, point " + std::to_string(from) +
                            ", has a classical law: leave one of these laws out, and the section is planned such that "
                            "the mode rests here"});
  }
}

/// Gives the ends of classical sections the velocity of the straight section beside them.
void join_velocities(const MotionLawProblem& given, std::size_t straight, double velocity, MotionLawProblem& out,
                     Faults& faults) {
  const std::size_t n = given.sections(), begin = straight, end = given.end_point(straight);
  const auto join = [&](std::size_t point, std::size_t neighbour) {
    if (!is_classical(given, neighbour) || given.points[point].value(1).fixed()) return;
    const Range asked = given.points[point].value(1);
    if (velocity < asked.min || velocity > asked.max) {
      faults.push_back(
          {{"points", std::to_string(point), "velocity"},
           "the straight section here has " + std::to_string(velocity) + ": leave this out or take another law"});
      return;
    }
    auto& values = out.points[point].values;
    if (values.size() < 2) values.resize(2);
    values[1] = {velocity, velocity};
  };
  if (begin > 0 || given.periodic) join(begin, (begin + n - 1) % n);
  if (straight + 1 < n || given.periodic) join(end, (straight + 1) % n);
}

}  // namespace

void check_classical_sections(const MotionLawProblem& problem) {
  Faults faults;
  std::vector<std::size_t> classical;
  for (std::size_t i = 0; i < problem.sections(); ++i)
    if (is_classical(problem, i)) classical.push_back(i);
  if (classical.empty()) return;
  const MotionLawProblem joined = with_straight_sections(problem);
  for (const std::size_t section : classical) check_angles(joined, section, faults);
  check_still_points(problem, faults);
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  MotionLawProblem timed = problem;
  if (!timed.cycle_duration) timed.cycle_duration = 1;
  LawTask order;  // holds the order of the points alone
  order.periodic = problem.periodic;
  order.cycle = problem.length;
  for (const MotionPoint& point : problem.points) order.at.push_back(point.at);
  tighten(order, order.at);
  const std::vector<double> at = order.middle();
  classical_sections(timed, section_times(timed, at));
}

MotionLawProblem with_straight_sections(const MotionLawProblem& problem) {
  MotionLawProblem out = problem;
  std::vector<InputFault> faults;
  for (std::size_t i = 0; i < problem.sections(); ++i) {
    MotionPoint& point = out.points[i];
    if (!is_straight(problem, i)) continue;
    if (std::string why = obstacle(problem, i); !why.empty()) {
      faults.push_back({{"points", std::to_string(i), "law"}, std::move(why)});
      continue;
    }
    const std::size_t end = problem.end_point(i);
    const double rise = problem.end_position(i).min - point.value(0).min;
    const double angle = problem.points[end].at.min - point.at.min + (end <= i ? problem.length : 0);
    const double velocity = rise == 0 ? 0 : rise / (angle * problem.seconds_per_unit());
    const Range limit = point.section[1];
    const double slack = 1e-9 * std::abs(velocity);
    if (velocity < limit.min - slack || velocity > limit.max + slack)
      faults.push_back({{"points", std::to_string(i), "section", "velocity"},
                        "leaves out the velocity of the straight section, rise by duration: widen the limit"});
    point.section[1] = {velocity, velocity};
    join_velocities(problem, i, velocity, out, faults);
    point.law.reset();
    point.inflection.reset();
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return out;
}

}  // namespace bahnwerk::cam
