#include "api/kinds/motion_law/motion_law_faults.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/cam/spline/spline_faults.hpp"

namespace bahnwerk::api::motion_law {
namespace {

using cam::MotionLawProblem;
using cam::MotionPoint;
using cam::Range;
using Place = std::vector<std::string>;

constexpr std::size_t max_steps = 5'000'000;

std::string number(double value) { return nlohmann::json(value).dump(); }

class Faults {
 public:
  explicit Faults(const MotionLawProblem& problem) : problem_(problem) {}

  std::vector<InputFault> run() {
    for (std::size_t i = 0; i < problem_.points.size(); ++i) ranges(i);
    angles();
    degrees();
    travel();
    objective();
    drive();
    vibration();
    return std::move(faults_);
  }

 private:
  void add(Place place, std::string message) { faults_.push_back({std::move(place), std::move(message)}); }
  Place at(std::size_t point) const { return {"points", std::to_string(point), "at"}; }

  void ranges(std::size_t i) {
    const MotionPoint& p = problem_.points[i];
    if (p.at.empty()) add(at(i), "is an empty range: max " + number(p.at.max) + " is below min " + number(p.at.min));
    for (int r = 0; r < static_cast<int>(p.values.size()); ++r) {
      const Range range = p.values[static_cast<std::size_t>(r)];
      if (range.empty())
        add(cam::value_place(i, r),
            "is an empty range: max " + number(range.max) + " is below min " + number(range.min));
    }
    const bool last = !problem_.periodic && i + 1 == problem_.points.size();
    for (int r = 0; r < cam::limited_orders; ++r) {
      const Range limit = p.section[static_cast<std::size_t>(r)];
      const Place place{"points", std::to_string(i), "section", cam::order_name(r)};
      if (limit.empty())
        add(place, "is an empty range: max " + number(limit.max) + " is below min " + number(limit.min));
      else if (last && !limit.free())
        add(place, "the law ends at this point: no section begins here");
      else if (!limit.free())
        meets_values(i, r, limit, place);
    }
    if (p.weight && (last || !problem_.cycle_duration))
      add({"points", std::to_string(i), "section", "weight"},
          last ? "the law ends at this point: no section begins here"
               : "belongs to J, and the law is made for the shortest cycle: leave it out");
    if (last && p.law) add({"points", std::to_string(i), "law"}, "the law ends at this point: no section begins here");
    if (p.inflection && !p.law)
      add({"points", std::to_string(i), "inflection"}, "belongs to a classical law, which `law` names");
  }

  /// A limit that the values at the section's own ends break.
  void meets_values(std::size_t section, int order, Range limit, const Place& place) {
    for (const bool at_end : {false, true}) {
      const std::size_t end = at_end ? problem_.end_point(section) : section;
      const MotionPoint& p = problem_.points[end];
      // An order above the continuity may differ on the other side.
      if (order > problem_.continuity(end) && !p.value(order).fixed()) continue;
      const Range value = at_end && order == 0 ? problem_.end_position(section) : p.value(order);
      if (value.empty() || (value.min <= limit.max && value.max >= limit.min)) continue;
      add(place, "cannot hold: point " + std::to_string(end) + " asks for a " + cam::order_name(order) +
                     (value.fixed() ? " of " + number(value.min)
                                    : std::string(value.min > limit.max ? " of at least " : " of at most ") +
                                          number(value.min > limit.max ? value.min : value.max)));
    }
  }

  void angles() {
    const double least = 1e-9 * problem_.length;
    double earliest = -HUGE_VAL;
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      const Range now = problem_.points[i].at;
      if (now.empty()) return;
      if (i > 0 && now.max <= earliest)
        add(at(i), "does not come behind the point before, which is at " + number(earliest) + " or later");
      else if (i > 0 && now.max - earliest < least)
        add(at(i), "is closer to the point before than a billionth of the master's length: make one point of both");
      earliest = std::max(earliest, now.min);
    }
    const Range first = problem_.points.front().at, last = problem_.points.back().at;
    if (problem_.periodic) {
      if (last.min > first.max + problem_.length - least)
        add(at(problem_.points.size() - 1), "does not come before the first point of the next cycle, which is at " +
                                                number(first.max + problem_.length) +
                                                ": a periodic law gives that point once");
      return;
    }
    for (const std::size_t end : {std::size_t{0}, problem_.points.size() - 1})
      if (!problem_.points[end].at.fixed())
        add(at(end), "must be a number: a law that is not periodic begins and ends at given places");
    if (first.fixed() && last.fixed() && std::abs(last.min - first.min - problem_.length) > 1e-9 * problem_.length)
      add(at(problem_.points.size() - 1), "must be " + number(first.min + problem_.length) +
                                              ": a law that is not periodic lasts one master length, " +
                                              number(problem_.length));
  }

  /// Numbers alone ask for so many coefficients, whatever the method.
  void degrees() {
    const auto numbers = [&](std::size_t point) {
      const auto& values = problem_.points[point].values;
      return static_cast<int>(std::count_if(values.begin(), values.end(), [](Range r) { return r.fixed(); }));
    };
    for (std::size_t s = 0; s < problem_.sections(); ++s) {
      const std::size_t e = problem_.end_point(s);
      const int degree = numbers(s) + numbers(e) - 1;
      if (degree <= cam::max_degree) continue;
      const std::string why = "the numbers at points " + std::to_string(s) + " and " + std::to_string(e) +
                              " ask for a polynomial of degree " + std::to_string(degree) + "; degrees end at " +
                              std::to_string(cam::max_degree) + ": give fewer derivatives or a point between them";
      add({"points", std::to_string(s)}, why);
      add({"points", std::to_string(e)}, why);
    }
  }

  void travel() {
    if (problem_.travel != 0 && !problem_.periodic)
      add({"travel"}, "belongs to a periodic law: one that is not ends where its last point says");
  }

  void objective() {
    const auto& weight = problem_.objective.weight;
    if (weight[1] == 0 && weight[2] == 0 && weight[3] == 0)
      add({"objective"}, "has no weight above 0: nothing makes one law better than another");
    if (problem_.objective.then_order > 0 && problem_.method == cam::LawMethod::active_set)
      add({"objective", "then"}, "needs method \"optimal\"");
    if (problem_.objective.then_order > 0 && problem_.drive)
      add({"objective", "then"}, "belongs to J, and with `drive` the law is made for the shortest cycle: leave it out");
    if (problem_.objective.normalised && problem_.points_stroke() == 0)
      add({"objective", "normalised"}, "needs a stroke: the positions of the points force none");
  }

  void drive() {
    if (!problem_.cycle_duration && !problem_.drive)
      add({"master", "cycle_duration"}, "must be a number, or `drive` must say what the shortest cycle is limited by");
    if (problem_.drive && problem_.method == cam::LawMethod::active_set) add({"drive"}, "needs method \"optimal\"");
  }

  void vibration() {
    std::size_t still = 0, first = 0;
    for (std::size_t i = 0; i < problem_.points.size(); ++i)
      if (problem_.points[i].still && still++ == 0) first = i;
    if (still > 0 && problem_.vibration.empty())
      add({"points", std::to_string(first), "still"}, "needs `vibration`, the modes that are to be still");
    if (!problem_.vibration.empty() && still < (problem_.periodic ? 1u : 2u))
      add({"vibration"}, "needs points that are `still`: the mode rests at one and again at the next");
    if (!problem_.vibration.empty() && problem_.method == cam::LawMethod::active_set)
      add({"vibration"}, "needs method \"optimal\"");
  }

  const MotionLawProblem& problem_;
  std::vector<InputFault> faults_;
};

}  // namespace

std::vector<InputFault> problem_faults(const MotionLawProblem& problem) { return Faults(problem).run(); }

std::vector<InputFault> sampling_faults(const MotionLawProblem& problem, const LawSampling& sampling) {
  std::vector<InputFault> faults;
  if (!sampling.cycle_time) return faults;
  if (sampling.samples) {
    faults.push_back({{"samples"}, "says the same as cycle_time: give one of them"});
  } else if (!problem.cycle_duration) {
    faults.push_back({{"cycle_time"}, "cannot divide a cycle whose duration is not known yet: give samples instead"});
  } else {
    const double steps = *problem.cycle_duration / *sampling.cycle_time;
    if (steps > static_cast<double>(max_steps))
      faults.push_back({{"cycle_time"}, "makes a table of more than " + std::to_string(max_steps) + " steps"});
    else if (table_steps(sampling, *problem.cycle_duration) == 0)
      faults.push_back({{"cycle_time"},
                        "must divide the cycle of " + number(*problem.cycle_duration) +
                            " s: " + number(*problem.cycle_duration / std::max(1.0, std::round(steps))) +
                            " s does, or give samples"});
  }
  return faults;
}

}  // namespace bahnwerk::api::motion_law
