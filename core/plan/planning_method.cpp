#include "core/plan/planning_method.hpp"

#include <stdexcept>
#include <utility>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/feed/critical_points.hpp"
#include "core/motion/feed/spline_feed.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/motion/natural/natural_law.hpp"

namespace bahnwerk {
namespace {

MethodResult acceleration_limited(const PathTask& task, const MethodOptions& given, bool keep_reserve, int refinement,
                                  Progress progress) {
  AccelerationLimitedOptions options;
  options.corner_angle = given.corner_angle;
  options.keep_reserve = keep_reserve;
  options.braking_reserve = given.braking_reserve;
  for (int i = 0; i < refinement; ++i) {
    options.grid.angle *= 0.5;
    options.grid.hermite *= 1.0 / 16;  // the error of a cell's model falls with the fourth power of its width
    options.tolerance *= 0.1;
  }
  AccelerationLimitedResult result = plan_acceleration_limited(task, options, progress);
  return {std::move(result.law), result.rounds, result.cells};
}

MethodResult braking_reserve(const PathTask& task, const MethodOptions& options, int refinement, Progress progress) {
  return acceleration_limited(task, options, true, refinement, progress);
}

MethodResult time_optimal(const PathTask& task, const MethodOptions& options, int refinement, Progress progress) {
  return acceleration_limited(task, options, false, refinement, progress);
}

MethodResult jerk_limited(const PathTask& task, const MethodOptions& given, int refinement, Progress progress) {
  JerkLimitedOptions options;
  options.corner_angle = given.corner_angle;
  options.path = given.along;
  for (int i = 0; i < refinement; ++i) {
    options.angle *= 0.5;
    options.tolerance *= 0.1;
  }
  JerkLimitedResult result = plan_jerk_limited(task, options, progress);
  return {std::move(result.law), result.iterations, result.cells};
}

MethodResult natural(const PathTask& task, const MethodOptions& given, int refinement, Progress progress) {
  NaturalOptions options;
  options.shares = given.shares;
  options.path = given.along;
  options.steps <<= refinement;
  MethodResult result{plan_natural(task, options, progress), 1, 0};
  result.cells = result.law.pieces().size();
  return result;
}

FeedOptions feed_options(const MethodOptions& given, int refinement) {
  FeedOptions options;
  options.profile = given.profile;
  options.corner_angle = given.corner_angle;
  options.path = given.along;
  options.feed = given.feed;
  options.nodes <<= refinement;
  return options;
}

MethodResult constant(const PathTask& task, const MethodOptions& given, int refinement, Progress progress) {
  MethodResult result{plan_constant_feed(task, feed_options(given, refinement), progress), 1, 0};
  result.cells = result.law.pieces().size();
  return result;
}

MethodResult critical_points(const PathTask& task, const MethodOptions& given, int refinement, Progress progress) {
  MethodResult result{plan_critical_points(task, feed_options(given, refinement), progress), 1, 0};
  result.cells = result.law.pieces().size();
  return result;
}

MethodResult spline(const PathTask& task, const MethodOptions& given, int refinement, Progress progress) {
  SplineFeedOptions options;
  options.path = given.along;
  options.steps <<= refinement;
  SplineFeed found = plan_spline_feed(task, options, progress);
  MethodResult result{std::move(found.law), found.evaluations, 0};
  result.cells = result.law.pieces().size();
  return result;
}

constexpr MethodRow rows[] = {
    // method, planner, order, limits_along, takes_profile, refinement, holds_at_nodes
    {PlanningMethod::braking_reserve, braking_reserve, 2, false, false, Refinement::to_steady, false},
    {PlanningMethod::time_optimal, time_optimal, 2, false, false, Refinement::to_bound, false},
    {PlanningMethod::jerk_limited, jerk_limited, 3, true, false, Refinement::none, false},
    {PlanningMethod::natural, natural, 3, true, false, Refinement::none, false},
    {PlanningMethod::constant, constant, 3, true, true, Refinement::none, false},
    {PlanningMethod::critical_points, critical_points, 3, true, true, Refinement::none, true},
    {PlanningMethod::spline, spline, 3, true, false, Refinement::none, false},
};

}  // namespace

MethodRow method_row(PlanningMethod method, const MethodOptions& options) {
  for (MethodRow row : rows) {
    if (row.method != method) continue;
    if (row.takes_profile) row.order = speed_profile_row(options.profile).order;
    return row;
  }
  throw std::logic_error("a planning method without a row");
}

Machine held_limits(Machine machine, const MethodRow& method) {
  for (AxisLimits& axis : machine.axes)
    for (int order = method.order + 1; order <= Limits::highest_order; ++order) axis.of(order) = unlimited;
  return machine;
}

}  // namespace bahnwerk
