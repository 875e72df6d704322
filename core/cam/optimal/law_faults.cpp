#include "core/cam/optimal/law_faults.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "core/base/errors.hpp"
#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {
namespace {

constexpr const char* order_names[limited_orders] = {"position", "velocity", "acceleration", "jerk"};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::vector<std::string> place_of(const LawTask::Condition& condition) {
  if (condition.given != LawTask::none) return {"points", std::to_string(condition.given), "law"};
  std::vector<std::string> place{"points", std::to_string(condition.point)};
  if (condition.order < limited_orders) {
    place.emplace_back(order_names[condition.order]);
  } else {
    place.emplace_back("derivatives");
    place.push_back(std::to_string(condition.order));
  }
  return place;
}

}  // namespace

void check_contradictions(const MotionLawProblem& problem, const MotionLawProblem& given) {
  std::vector<InputFault> faults;
  for (std::size_t section = 0; section < problem.sections(); ++section)
    for (int r = 0; r < limited_orders; ++r) {
      const Range limit = problem.points[section].section[static_cast<std::size_t>(r)];
      const std::vector<std::string> place{"points", std::to_string(section), "section", order_names[r]};
      if (limit.empty()) {
        faults.push_back({place, "min is above max: nothing can keep this limit"});
        continue;
      }
      for (const std::size_t point : {section, problem.periodic ? problem.end_point(section) : section + 1}) {
        const bool at_end = point != section || problem.sections() == 1;
        const Range asked = at_end && r == 0 ? problem.end_position(section) : problem.points[point].value(r);
        const bool straight = given.points[section].law == ClassicalLaw::straight && r == 1 && limit.fixed();
        if (straight && (asked.min > limit.max || asked.max < limit.min))
          faults.push_back({{"points", std::to_string(section), "law"},
                            "the straight section has a velocity of " + number(limit.min) + ", and point " +
                                std::to_string(point) + " asks for " +
                                (asked.fixed() ? number(asked.min) : number(asked.min) + " … " + number(asked.max)) +
                                ": change one of them or take another law"});
        else if (asked.min > limit.max || asked.max < limit.min)
          faults.push_back(
              {place, "leaves out what point " + std::to_string(point) + " asks for, " +
                          (asked.fixed() ? number(asked.min) : number(asked.min) + " … " + number(asked.max)) +
                          ": widen the limit or change the point"});
      }
    }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

void check_lengths(const MotionLawProblem& problem, const LawTask& task, int degree) {
  std::vector<InputFault> faults;
  for (std::size_t s = 0; s < task.sections(); ++s) {
    if (is_expressible(task, s, degree)) continue;
    const std::size_t end = problem.end_point(s);
    const int order = kept_order(task, s);
    const double length = problem.length / task.cycle;  // of the mean section, master's unit
    const double least = length * std::pow(published_rounding(task, degree, 1, order) /
                                               (1e-4 * task.size[static_cast<std::size_t>(order)]),
                                           1.0 / order);
    faults.push_back({{"points", std::to_string(end), "at"},
                      "is so close to point " + std::to_string(s) + " that rounding of positions hides the " +
                          order_names[order] + " between them: for degree " + std::to_string(degree) + " put " +
                          number(least) + " " + problem.master_unit +
                          " between them, or make one point of both and give its velocity"});
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

void explain_infeasible(const LawTask& task, const LawBasis& basis, const std::vector<double>& times, Progress progress,
                        bool all_degrees) {
  const LawConflict conflict = SplineProgram(task, basis, times).find_conflict(progress);
  const bool higher = basis.degree() < max_degree && !all_degrees, more = basis.pieces() < 16 && !all_degrees;
  const std::string advice = std::string(more ? "take more pieces, " : "") +
                             (higher ? more ? "a higher degree, " : "take a higher degree, " : "");
  const std::string degree = all_degrees
                                 ? "any degree that was tried"
                                 : "degree " + std::to_string(basis.degree()) +
                                       (basis.pieces() == 1 ? std::string(" with one piece")
                                                            : " with " + std::to_string(basis.pieces()) + " pieces") +
                                       " per section";
  std::vector<InputFault> faults;
  if (!conflict.values && conflict.violation < 1e-6)
    throw InvalidInput({InputFault{{"degree"},
                                   "the method did not converge for " + degree +
                                       ", although values, ranges and limits do not contradict each other: take " +
                                       (basis.pieces() > 1 ? "fewer pieces or " : "") + "another degree"}});
  std::vector<std::size_t> named;  // numbers of the given sections
  for (const std::size_t c : conflict.conditions) {
    if (const std::size_t given = task.conditions[c].given; given != LawTask::none) {
      if (std::find(named.begin(), named.end(), given) != named.end()) continue;
      named.push_back(given);
      faults.push_back({place_of(task.conditions[c]), "the state in which this classical law ends at point " +
                                                          std::to_string(task.conditions[c].point) +
                                                          " contradicts the conditions named here for " + degree +
                                                          ": " + advice + (advice.empty() ? "take " : "or ") +
                                                          "less continuity at that point"});
      continue;
    }
    faults.push_back({place_of(task.conditions[c]),
                      conflict.values
                          ? "contradicts the other values named here for " + degree + ": " + advice +
                                (advice.empty() ? "take " : "") + "less continuity, or a range"
                          : "this range cannot be reached together with the other conditions named here for " + degree +
                                ": " + advice + (advice.empty() ? "" : "or ") + "widen it"});
  }
  for (const auto& [section, order] : conflict.limits) {
    if (order == effort_order) {
      faults.push_back({{"drive", "effort"},
                        "no law of " + degree + " keeps this limit in section " + std::to_string(section) +
                            " together with the other conditions named here: " + advice +
                            (advice.empty() ? "" : "or ") + "give the motion more time"});
      continue;
    }
    faults.push_back({{"points", std::to_string(section), "section", order_names[order]},
                      "no law of " + degree +
                          " keeps this limit all over the section together with the other conditions named here: " +
                          advice + (advice.empty() ? "" : "or ") + "widen it"});
  }
  std::sort(faults.begin(), faults.end(), [](const InputFault& a, const InputFault& b) { return a.place < b.place; });
  if (faults.empty())
    faults.push_back({{"degree"},
                      conflict.values
                          ? "values and continuity contradict each other for " + degree
                          : "no law was found for " + degree +
                                ", and none of the values, ranges and limits could be shown to prevent it: take "
                                "another degree, or move points apart"});
  throw InvalidInput(std::move(faults));
}

}  // namespace bahnwerk::cam
