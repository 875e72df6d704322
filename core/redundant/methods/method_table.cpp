#include "core/redundant/methods/method_table.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/base/errors.hpp"
#include "core/redundant/coarse/coarse_alone.hpp"
#include "core/redundant/coarse/coarse_task.hpp"
#include "core/redundant/iterative/iterative.hpp"
#include "core/redundant/joint/joint.hpp"
#include "core/redundant/joint/joint_method.hpp"
#include "core/redundant/known/filter_plan.hpp"
#include "core/redundant/known/follow_up.hpp"
#include "core/redundant/known/geometric.hpp"
#include "core/redundant/known/lag_compensation.hpp"
#include "core/redundant/known/reparametrise.hpp"
#include "core/redundant/reversed_task.hpp"

namespace bahnwerk {
namespace {

constexpr double worth_giving_way = 1e-6;  // share of the duration
constexpr double symmetric = 5e-4;         // share of the bound by which durations forwards and backwards may differ
constexpr double quicker = 1e-9;           // least gain, relative to a duration; less is rounding

bool is_lone_straight_move(const RedundancyTask& task) {
  return task.path->size() == 1 && task.path->linear(0) && task.dwells.empty();
}

/// A lone straight move has a closed form. Fits of splines to it find next to it what is now quicker, now slower with
/// more stroke or acceleration: the closed form counts where it is quicker.
RedundancyResult quicker_than_lone_move(RedundancyResult found, const RedundancyTask& task,
                                        const RedundancyOptions& options, Progress& progress, double at) {
  if (!is_lone_straight_move(task)) return found;
  RedundancyOptions fastest = options;
  fastest.smoothness = 0, fastest.stretch = 1, fastest.compare = false;
  try {
    RedundancyResult other = plan_joint_method(task, fastest, progress, at, at);
    if (found.head->duration() <= other.head->duration() * (1 + worth_giving_way)) return found;
    char note[160];
    std::snprintf(note, sizeof note,
                  "the method's own motion takes %.6g s, the move's closed form %.6g s: the joint planner planned it",
                  found.head->duration(), other.head->duration());
    other.gave_way = std::move(found.gave_way);
    other.gave_way.push_back({planner_name(options.method), GivingWay::slower, found.head->duration(),
                              planner_name(RedundancyMethod::joint), other.head->duration()});
    other.notes = std::move(found.notes);
    other.notes.emplace_back(note);
    other.passes.insert(other.passes.begin(), found.passes.begin(), found.passes.end());
    return other;
  } catch (const Infeasible&) {
    return found;
  }
}

constexpr RedundancyRow rows[] = {
    //  method                              planner  limits_jerk
    {RedundancyMethod::joint, plan_joint_method, true},
    {RedundancyMethod::iterative, plan_iterative, true},
    {RedundancyMethod::geometric, plan_geometric, false},
    {RedundancyMethod::filter, plan_filter, false},
    {RedundancyMethod::follow_up, plan_follow_up, false},
    {RedundancyMethod::lag_compensation, plan_lag_compensation, false},
};

bool every_axis_is_split(const CoarseFineMachine& machine) {
  return std::all_of(machine.axes.begin(), machine.axes.end(), [](const CoarseFineAxis& a) { return a.stroke > 0; });
}

/// Where so, `iterative` takes the place of `joint`, which leaves open where fine axes stand at rest.
bool centred(const CoarseFineMachine& machine) {
  return std::any_of(machine.axes.begin(), machine.axes.end(), [](const CoarseFineAxis& a) { return a.centred; });
}

/// In the direction of time.
RedundancyResult planned_forwards(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                  double from, double to) {
  if (options.method != RedundancyMethod::joint && !every_axis_is_split(task.machine)) {
    RedundancyResult result = plan_joint_method(task, options, progress, from, to);
    result.gave_way.insert(result.gave_way.begin(), {planner_name(options.method), GivingWay::unsuited, 0,
                                                     planner_name(RedundancyMethod::joint), result.head->duration()});
    result.notes.insert(result.notes.begin(),
                        "not every axis of the contour has a fine one, which the method asks for; the joint planner "
                        "planned the contour");
    return result;
  }
  if (options.method == RedundancyMethod::joint && centred(task.machine)) {
    RedundancyOptions other = options;
    other.method = RedundancyMethod::iterative;
    RedundancyResult result = planned_forwards(task, other, progress, from, to);
    result.gave_way.insert(result.gave_way.begin(), {planner_name(options.method), GivingWay::unsuited, 0,
                                                     planner_name(other.method), result.head->duration()});
    result.notes.emplace_back(
        "the joint planner leaves open where fine axes stand at rest: the iterative method planned the contour");
    return result;
  }
  return redundancy_row(options.method).plan(task, options, progress, from, to);
}

/// What a lag filters is not the same backwards, and what is timed anew begins with the pieces of the plan as it was
/// made; along its curve the geometric split is the quickest in both directions.
bool has_a_direction(const RedundancyOptions& options) {
  return !options.coarse_alone && !options.reparametrise && options.method != RedundancyMethod::lag_compensation &&
         options.method != RedundancyMethod::geometric;
}

/// Whether the bound leaves more than `symmetric` open.
bool may_be_quicker(const RedundancyResult& found, const RedundancyTask& task, const RedundancyOptions& options) {
  double slowed = 1;
  if (options.method == RedundancyMethod::joint)
    slowed = options.stretch >= 1 ? options.stretch : stretch_of(options.smoothness);
  return task.bound > 0 && found.head->duration() > task.bound * slowed * (1 + symmetric);
}

/// What is planned for it in either direction, the quicker one.
RedundancyResult planned(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress, double from,
                         double to) {
  if (!has_a_direction(options)) return planned_forwards(task, options, progress, from, to);
  std::optional<RedundancyResult> found;
  std::exception_ptr why_not;
  try {
    found = planned_forwards(task, options, progress, from, to);
  } catch (const Infeasible&) {
    why_not = std::current_exception();
  }
  if (found && !may_be_quicker(*found, task, options)) return *std::move(found);
  try {
    if (const std::optional<RedundancyTask> back = reversed(task)) {
      RedundancyResult other = reversed(planned_forwards(*back, options, progress, to, to), task);
      if (!found || other.head->duration() < found->head->duration() * (1 - quicker)) {
        other.notes.emplace_back(backwards_note);
        return other;
      }
    }
  } catch (const Infeasible&) {
    // As it was, then.
  }
  if (!found) std::rethrow_exception(why_not);
  return *std::move(found);
}

}  // namespace

const RedundancyRow& redundancy_row(RedundancyMethod method) {
  for (const RedundancyRow& row : rows)
    if (row.method == method) return row;
  throw std::logic_error("a redundancy method without a row");
}

bool gantry_takes_over(const RedundancyTask& task, RedundancyMethod method) {
  return method != RedundancyMethod::joint && method != RedundancyMethod::iterative && is_lone_straight_move(task) &&
         within_coarse_range(*task.path, task.machine);
}

RedundancyResult plan_redundant(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                double from, double to) {
  const bool split = options.method == RedundancyMethod::joint || every_axis_is_split(task.machine);
  const bool again = split && options.reparametrise && !task.machine.limits_jerk();
  const double once = again ? from + 0.7 * (to - from) : to;
  RedundancyResult result = planned(task, options, progress, from, once);
  if (!split) return result;
  if (again) result = reparametrised(std::move(result), task, progress, once, to);
  const bool ends_count = centred(task.machine);
  const bool iterates =
      options.method == RedundancyMethod::iterative || (options.method == RedundancyMethod::joint && ends_count);
  if (iterates && !ends_count) result = quicker_than_lone_move(std::move(result), task, options, progress, to);
  if ((options.method == RedundancyMethod::joint && !ends_count) || task.machine.limits_jerk()) return result;
  return quicker_than_coarse_alone(std::move(result), task, options, progress, to);
}

}  // namespace bahnwerk
