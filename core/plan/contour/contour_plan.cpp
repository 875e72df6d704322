#include "core/plan/contour/contour_plan.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/base/progress.hpp"
#include "core/motion/setpoints/contour_setpoints.hpp"
#include "core/motion/setpoints/tool_setpoints.hpp"
#include "core/plan/contour/contour_faults.hpp"
#include "core/plan/contour/contour_report.hpp"
#include "core/plan/contour/prepared_contour.hpp"
#include "core/plan/contour/rounding_choice.hpp"
#include "core/plan/contour/section_gaps.hpp"
#include "core/plan/contour/what_if.hpp"
#include "core/plan/path_plan.hpp"
#include "core/verify/geometry/tube.hpp"
#include "core/verify/law/rest_check.hpp"
#include "core/verify/setpoints/tool_checks.hpp"

namespace bahnwerk {

namespace {

constexpr std::size_t slow_lines_listed = 20;

void check(const Contour& contour, const ToolMachine& machine, const ContourPlanning& planning) {
  std::vector<InputFault> faults = machine_faults(machine);
  if (faults.empty()) faults = planning_faults(machine, planning);
  if (faults.empty()) faults = contour_faults(contour, machine, planning);
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

std::unique_ptr<SetpointSource> setpoints(const std::shared_ptr<const Contour>& contour, const ContourAxes& axes,
                                          const ToolMachine& machine, const std::shared_ptr<const PathMotion>& motion,
                                          std::size_t cycles) {
  if (!axes.kinematics()) return std::make_unique<ContourSetpoints>(motion, *contour, machine, cycles);
  return std::make_unique<ToolSetpoints>(motion, contour, machine, cycles,
                                         ToolColumns{axes.shown(), machine.coordinates, axes.height(*contour)});
}

}  // namespace

ContourPlan plan_contour(Contour input, const ToolMachine& machine, const ContourPlanning& planning,
                         Progress progress) {
  check(input, machine, planning);
  if (planning.stop_at_mode_change) stop_at_mode_changes(input);
  const auto given = std::make_shared<const Contour>(std::move(input));
  const double all = planning.what_if ? 0.25 : 1;  // part of the progress before `what_if` is planned
  const bool blended = planning.corner_mode == CornerMode::blend;
  const double prepared_at = blended ? 0.1 * all : 0.0, chosen_at = blended ? 0.5 * all : 0.0,
               served = (blended ? 0.95 : 1.0) * all;
  const PreparedContour prepared = prepare_contour(given, machine, planning, progress.part(0, prepared_at));
  DrivenContour driven = choose_rounding(prepared, planning, progress.part(prepared_at, chosen_at));
  const std::shared_ptr<const Contour> contour = std::move(driven.contour);
  const ContourAxes& axes = *prepared.axes;
  PathPlanning path = path_planning(prepared, contour, planning);
  path.blocks = contour.get();
  path.setpoints = [&](const std::shared_ptr<const PathMotion>& motion, std::size_t cycles) {
    return setpoints(contour, axes, machine, motion, cycles);
  };
  if (axes.kinematics())
    path.row_checks = [&](const PathMotion&, const SetpointSource& rows, const Verification&) {
      RowChecks list;
      std::vector<double> columns;  // forward() takes the machine's units, which columns have but for deg
      for (const AxisLimits& axis : machine.axes) columns.push_back(axis.unit == "rad" ? 180 / std::numbers::pi : 1);
      list.push_back(tool_row_check(
          {contour->path, axes.height(*contour), machine.coordinates, *axes.kinematics(), rows, columns}));
      return list;
    };
  PathPlan planned = plan_along(path, progress.part(chosen_at, served), std::move(driven.law));

  const TimeLaw& sampled = planned.motion->law();
  show(axes, machine, planned.verification);
  for (const auto& rows : planned.row_checks) planned.verification.add(rows->checks());
  if (!given->rests.empty())
    planned.verification.add(rest_check(*given, *contour, sampled, progress.part(served, served)));
  if (blended)
    planned.verification.add(tube_checks(*given, *contour, planning.blend_tolerance, progress.part(served, all)));

  ContourPlan plan;
  plan.notes = contour->notes;
  if (!axes.kinematics())
    note_still_axes(*contour, machine, plan);
  else if (contour->dimension < 3)
    note_still_axes({*path.path, axes.shown()}, machine, plan);
  plan.path_length = contour->path.length();
  plan.iterations = planned.iterations;
  plan.pieces = planned.pieces;
  plan.duration = planned.duration;
  plan.bound = planned.bound;
  const SampledLaw sampled_law{sampled, planned.cycles.factor};
  report_blocks(*contour, sampled_law, plan);
  report_joints(*contour, {*path.moving, axes.shown()}, sampled_law, planning.corner_angle, plan,
                progress.part(all, all));
  plan.slow_lines = slow_lines(*planned.motion, prepared.held, path.feeds, planning.along, slow_lines_listed,
                               progress.part(all, all));
  plan.sections =
      section_gaps(*path.path, sampled, planned.cycles.factor, planned.section_bounds, progress.part(all, all));
  plan.verification = std::move(planned.verification);
  plan.setpoints = std::move(planned.setpoints);
  plan.path = contour;
  plan.axes = prepared.axes;
  plan.motion = std::move(planned.motion);
  if (planning.what_if) plan.what_if = what_if(given, machine, planning, progress.part(all, 1));
  return plan;
}

ContourPlan plan_contour(Contour contour, const ToolMachine& machine, const ContourPlanning& planning) {
  Progress silent;
  return plan_contour(std::move(contour), machine, planning, silent);
}

}  // namespace bahnwerk
