#include "core/cam/spline/spline_faults.hpp"

#include <algorithm>
#include <set>

namespace bahnwerk::cam {
namespace {

std::string point_name(std::size_t point) { return "point " + std::to_string(point); }

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i == 8) return text + " and others";
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  }
  return text;
}

}  // namespace

std::string order_name(int order) {
  static constexpr const char* names[] = {"position", "velocity", "acceleration", "jerk"};
  return order < 4 ? names[order] : "derivative of order " + std::to_string(order);
}

std::vector<std::string> value_place(std::size_t point, int order) {
  if (order < 4) return {"points", std::to_string(point), order_name(order)};
  return {"points", std::to_string(point), "derivatives", std::to_string(order)};
}

InvalidInput degree_faults(const MotionLawProblem& problem, const SplineTask& task, int least_maximum) {
  std::vector<InputFault> faults;
  if (least_maximum > max_degree && least_maximum < 1000000) {
    // The section that no sharing relieves: its own least number of conditions is the largest.
    const auto shares = point_shares(task);
    int most = -1;
    std::size_t worst = 0;
    for (std::size_t s = 0; s < task.sections(); ++s) {
      if (task.is_given(s)) continue;
      const std::size_t end = problem.end_point(s);
      const int least = shares[s].total - shares[s].before_max + shares[end].before_min;
      if (least > most) most = least, worst = s;
    }
    const std::size_t end = problem.end_point(worst);
    const std::string why = "the values and continuity of " + point_name(worst) + " and " + point_name(end) +
                            " ask for a polynomial of degree " + std::to_string(least_maximum) +
                            " between them; degrees end at " + std::to_string(max_degree) +
                            ": give fewer derivatives or less continuity, or a point between them";
    faults.push_back({{"points", std::to_string(worst)}, why});
    faults.push_back({{"points", std::to_string(end)}, why});
  } else {
    for (std::size_t s = 0; s < task.sections(); ++s)
      if (!task.is_given(s)) {
        faults.push_back({{"points", std::to_string(s)},
                          "a section of the law is left without a condition: give more values, or more continuity"});
        break;
      }
  }
  return InvalidInput(std::move(faults));
}

InvalidInput singular_faults(const MotionLawProblem& problem, const SingularSystem& why) {
  std::set<std::size_t> joints;
  std::vector<std::string> open;
  for (const auto& row : why.dependent)
    if (row.continuity) joints.insert(row.point);
  for (const auto& row : why.undetermined) open.push_back(order_name(row.order) + " at " + point_name(row.point));
  const std::string free = open.empty() ? "the law" : "the " + list_of(open);
  std::vector<InputFault> faults;
  for (const auto& row : why.dependent) {
    if (row.continuity) continue;
    faults.push_back({value_place(row.point, row.order),
                      order_name(row.order) + " at " + point_name(row.point) +
                          " follows from the other conditions or contradicts them, while " + free +
                          " is not determined by any: leave out this value, or give one of those instead"});
  }
  for (const std::size_t joint : joints)
    faults.push_back({{"points", std::to_string(joint), "continuity"},
                      "continuity at " + point_name(joint) +
                          " follows from the other conditions or contradicts them, while " + free +
                          " is not determined by any: as many conditions as coefficients do not determine this law. "
                          "Change the continuity of one point by one, or use method \"optimal\", which chooses what is "
                          "free"});
  if (faults.empty()) faults.push_back({{"points"}, "the conditions do not determine the law: " + free + " is free"});
  if (faults.size() > 40) faults.resize(40);
  (void)problem;
  return InvalidInput(std::move(faults));
}

}  // namespace bahnwerk::cam
