#include "api/kinds/contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "api/kinds/coarse_fine.hpp"
#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "api/setpoint_summary.hpp"
#include "api/verification.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress_part.hpp"
#include "core/plan/coarse_fine/axis_drawing.hpp"
#include "core/plan/contour_drawing.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t max_joints_listed = 1000;  // a fine polyline passes as many as it has points

/// "line 1204: 14 % of the time, acceleration y, stops".
std::string sentence(const SlowLine& line, const char* what) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %zu: %.*f %% of the time", what, line.source, line.share < 0.1 ? 1 : 0,
                100 * line.share);
  std::string all = text;
  if (!line.limit.empty()) all += ", " + line.limit;
  if (line.stops && line.limit != "dwell") all += ", stops";
  return all;
}

/// The lines that cost most time. Only a program has lines: elsewhere it is the segment's number, from 0.
ordered_json slowest(const ContourPlan& plan, bool program) {
  ordered_json list = ordered_json::array();
  const char* const what = program ? "line" : "segment";
  for (const SlowLine& line : plan.slow_lines)
    list.push_back({{what, line.source},
                    {"time", line.time},
                    {"share", line.share},
                    {"length", line.length},
                    {"feed", std::isfinite(line.feed) ? ordered_json(line.feed) : ordered_json()},
                    {"limit", line.limit.empty() ? ordered_json() : ordered_json(line.limit)},
                    {"limit_share", line.limit_share},
                    {"stops", line.stops},
                    {"text", sentence(line, what)}});
  return list;
}

/// Sections between two rests, against their own bounds: how good the plan is where it is worst.
ordered_json sections(const ContourPlan& plan, bool program) {
  const SectionGaps& s = plan.sections;
  if (s.count == 0) return {{"count", 0}, {"median_gap", nullptr}, {"worst", nullptr}};
  return {{"count", s.count},
          {"median_gap", s.median},
          {"worst",
           {{program ? "line" : "segment", s.worst.source},
            {"length", s.worst.length},
            {"time", s.worst.time},
            {"bound", s.worst.bound},
            {"gap", s.worst.gap}}}};
}

/// "half the jerk: 12.31 s, 4.2 % more".
std::string sentence(const WhatIf& answer, const char* change, double planned) {
  if (!answer.duration) return std::string(change) + ": cannot be planned";
  const double more = 100 * (*answer.duration / planned - 1);
  char text[120];
  if (std::abs(more) < 1e-6) {
    std::snprintf(text, sizeof text, "%s: %.6g s, no change", change, *answer.duration);
    return text;
  }
  std::snprintf(text, sizeof text, "%s: %.6g s, %.2g %% %s", change, *answer.duration, std::abs(more),
                more < 0 ? "less" : "more");
  return text;
}

ordered_json what_if(const ContourPlan& plan) {
  ordered_json list = ordered_json::array();
  for (const WhatIf& answer : plan.what_if) {
    const bool twice = answer.factor > 1;
    const char *limit = "tolerance", *change = "twice the tolerance";
    if (answer.what == WhatIf::What::jerk) limit = "jerk", change = twice ? "twice the jerk" : "half the jerk";
    if (answer.what == WhatIf::What::acceleration) limit = "acceleration", change = "half the accelerations";
    list.push_back({{"limit", limit},
                    {"factor", answer.factor},
                    {"duration", answer.duration ? ordered_json(*answer.duration) : ordered_json()},
                    {"ratio", answer.duration ? ordered_json(*answer.duration / plan.duration) : ordered_json()},
                    {"text", sentence(answer, change, plan.duration)}});
  }
  return list;
}

ordered_json details(const ContourPlan& plan, const Machine& machine, const ContourPlanning& planning, bool program) {
  ordered_json blocks = ordered_json::array(), joints = ordered_json::array();
  for (const auto& block : plan.blocks)
    blocks.push_back({{"mode", block.mode == Mode::cut ? "cut" : "position"},
                      {"start_time", block.start_time},
                      {"end_time", block.end_time},
                      {"length", block.length}});
  for (const auto& joint : plan.joints) {
    if (joints.size() == max_joints_listed) break;
    ordered_json step = ordered_json::object();
    for (std::size_t k = 0; k < joint.step.size(); ++k) step[machine.axes[k].name] = joint.step[k];
    joints.push_back({{"s", joint.s},
                      {"angle", joint.angle * 180 / std::numbers::pi},
                      {"velocity", joint.velocity},
                      {"velocity_step", std::move(step)}});
  }
  ordered_json all = {{"method", name_of<PlanningMethod>(planning.method, planning_methods)},
                      {"law_pieces", plan.pieces},
                      {"notes", plan.notes},
                      {"blocks", std::move(blocks)},
                      {"joints_passed", plan.joints.size()},
                      {"joints", std::move(joints)},
                      {"sections", sections(plan, program)},
                      {"slowest", slowest(plan, program)}};
  if (planning.what_if) all["what_if"] = what_if(plan);
  return all;
}

/// `law`: of the motion along the path; `way`: of the coarse axes, if there are such.
ordered_json drawings(const ContourPlan& plan, const TimeLaw& law, std::vector<Vec> way, Progress& progress) {
  char title[80];
  std::snprintf(title, sizeof title, "path of %.6g mm, %.6g s", plan.path_length, plan.duration);
  return {{"contour.svg", contour_drawing(*plan.path, {.title = title, .way = std::move(way), .law = &law}, progress)}};
}

}  // namespace

namespace {

void throw_if_any(std::vector<InputFault> faults) {
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

/// `member` of the machine has the axes that its head needs.
void check_axes(const Contour& contour, const Machine& head, const char* member, std::vector<InputFault>& faults) {
  if (head.dimension() < contour.dimension)
    faults.push_back({{"machine", member, "z"}, "is required: the contour is in space"});
}

/// s: no motion along a segment is faster than its feed or all axes at full speed together. Of a planar contour's
/// machine the axes beyond the plane stand still.
double shortest_time(const Contour& contour, const Machine& head) {
  double fastest = 0, time = contour.dwell();
  for (std::size_t k = 0; k < std::min(head.dimension(), contour.dimension); ++k)
    fastest += head.axes[k].velocity * head.axes[k].velocity;
  fastest = std::sqrt(fastest);
  for (const auto& block : contour.blocks)
    for (std::size_t i = block.first; i < block.last; ++i)
      time += contour.path[i].length() / std::min(block.feed, fastest);
  return time;
}

void check_setpoints(double shortest, const Machine& head, std::vector<InputFault>& faults) {
  if (shortest / head.cycle_time > max_setpoints)
    faults.push_back({{"machine", "cycle_time"},
                      "the motion would have more than " + std::to_string(static_cast<long>(max_setpoints)) +
                          " setpoints: lengthen the cycle, raise the speeds, shorten the dwells or split the contour"});
}

void check_corners(const ContourPlanning& planning, std::vector<InputFault>& faults) {
  if (planning.corner_mode == CornerMode::blend && !(planning.blend_tolerance > 0))
    faults.push_back({{"planning", "corner", "tolerance"}, "is required by mode blend"});
  if (planning.corner_mode == CornerMode::stop && planning.blend_tolerance > 0)
    faults.push_back({{"planning", "corner", "tolerance"}, "belongs to mode blend"});
}

}  // namespace

void check_together(const Contour& contour, const Machine& machine, const ContourPlanning& planning) {
  std::vector<InputFault> faults;
  check_axes(contour, machine, "axes", faults);
  if (method_row(planning.method).limits_jerk && !(planning.along.jerk < unlimited)) {
    bool jerk = false;
    for (std::size_t k = 0; k < std::min(machine.dimension(), contour.dimension); ++k)
      jerk |= machine.axes[k].jerk < unlimited;
    if (!jerk)
      faults.push_back({{"machine", "axes", "x", "jerk"},
                        "is required by method jerk_limited, of one axis at least that the contour moves"});
  }
  check_setpoints(shortest_time(contour, machine), machine, faults);
  throw_if_any(std::move(faults));
}

void check_planning(const Machine& machine, const ContourPlanning& planning) {
  std::vector<InputFault> faults;
  const bool smooth = method_row(planning.method).limits_jerk;
  const auto& axes = machine.axes;
  const bool jerk = std::any_of(axes.begin(), axes.end(), [](const AxisLimits& axis) { return axis.jerk < unlimited; });
  if (smooth && !jerk && !(planning.along.jerk < unlimited))
    faults.push_back({{"machine", "axes", "x", "jerk"}, "is required by method jerk_limited, of one axis at least"});
  const Limits& path = planning.along;
  if (!smooth && std::min({path.velocity, path.acceleration, path.jerk}) < unlimited)
    faults.push_back(
        {{"planning", "path"}, "is held by method jerk_limited only; blocks limit the speed by their feed"});
  check_corners(planning, faults);
  throw_if_any(std::move(faults));
}

namespace {

/// What a job asks for, checked as far as its geometry is not needed.
struct ContourJob {
  std::optional<CoarseFineMachine> coarse_fine;
  Machine head;  ///< of coarse and fine axes the sums
  ContourPlanning planning;
  RedundancyOptions redundancy;
};

ContourJob read_contour_job(const json& spec) {
  ContourJob job;
  job.planning = planning(spec);
  job.planning.max_setpoints = max_setpoints;
  std::vector<InputFault> faults;
  if (coarse_fine(spec)) {
    job.coarse_fine = coarse_fine_machine(spec);
    job.head = summed(*job.coarse_fine);
    job.redundancy = redundancy(spec, job.planning);
    check_redundancy(spec, *job.coarse_fine, job.planning, faults);
    check_corners(job.planning, faults);
    throw_if_any(std::move(faults));
    job.planning.method = job.coarse_fine->limits_jerk() ? PlanningMethod::jerk_limited : PlanningMethod::time_optimal;
    return job;
  }
  job.head = machine(spec);
  if (job.planning.machine_study)
    faults.push_back({{"planning", "machine_study"}, "is for machines with coarse and fine axes"});
  throw_if_any(std::move(faults));
  check_planning(job.head, job.planning);
  return job;
}

void check_contour(const Contour& contour, const ContourJob& job) {
  if (!job.coarse_fine) return check_together(contour, job.head, job.planning);
  std::vector<InputFault> faults;
  check_axes(contour, job.head, "coarse", faults);
  const double shortest = shortest_time(contour, job.head);
  check_setpoints(shortest, job.head, faults);
  check_grid(*job.coarse_fine, shortest, faults);
  check_range(*job.coarse_fine, contour, faults);
  throw_if_any(std::move(faults));
}

ordered_json result_of(const ContourPlan& plan, const ContourJob& job, bool program) {
  return {{"kind", "contour"},
          {"summary",
           {{"duration", plan.duration},
            {"cut_time", plan.cut_time},
            {"position_time", plan.position_time},
            {"path_length", plan.path_length},
            {"iterations", plan.iterations}}},
          {"verification", verification(plan.verification)},
          {"bound", bound(plan.bound)},
          {"setpoints", setpoint_summary(*plan.setpoints)},
          {"details", details(plan, job.head, job.planning, program)}};
}

PlannedJob finished(ContourPlan& plan, ordered_json result, ordered_json drawn) {
  PlannedJob job;
  job.verified = plan.verification.passed;
  job.result = std::move(result);
  job.result["details"]["drawings"] = std::move(drawn);
  job.setpoints = std::move(plan.setpoints);
  return job;
}

PlannedJob plan_cartesian(Contour contour, const ContourJob& job, bool program, Progress& progress) {
  ContourPlan plan = plan_contour(std::move(contour), job.head, job.planning, progress);
  if (!method_row(job.planning.method).limits_jerk)
    for (const auto& axis : job.head.axes)
      if (axis.jerk < unlimited) {
        plan.notes.push_back("jerk limits are given but not held: only method jerk_limited holds them");
        break;
      }
  return finished(plan, result_of(plan, job, program), drawings(plan, plan.motion->law(), {}, progress));
}

PlannedJob plan_with_fine_axes(const Contour& contour, const ContourJob& job, const json& spec, bool program,
                               Progress& progress) {
  const CoarseFineMachine& machine = *job.coarse_fine;
  const bool study = job.planning.machine_study;
  const double planned = study ? 0.15 : 1;
  ProgressPart part(progress, "planning", 0, planned);
  Progress& first = study ? static_cast<Progress&>(part) : progress;  // without a study its stages have their names
  CoarseFinePlan plan = plan_coarse_fine(contour, machine, job.planning, job.redundancy, first);
  for (std::string& note : unused_options(spec)) plan.contour.notes.push_back(std::move(note));
  ordered_json result = result_of(plan.contour, job, program);
  report(plan, machine, job.redundancy.method, program, result);
  if (job.redundancy.method == RedundancyMethod::lag_compensation)
    report_prefilter(job.redundancy, machine.cycle_time, result);
  ordered_json drawn = drawings(plan.contour, plan.head->law(), coarse_way(plan), first);
  drawn["axes.svg"] = axis_drawing(plan, machine, first);
  if (study) {
    const MachineStudy others =
        machine_study(contour, machine, job.planning, job.redundancy, study_requests(spec), progress, planned, 1);
    report(others, plan.contour.duration, result);
    drawn["machine_study.svg"] = machine_study_drawing(others, plan.contour.duration);
  }
  return finished(plan.contour, std::move(result), std::move(drawn));
}

}  // namespace

void check(const json& spec) {
  try {
    const ContourJob job = read_contour_job(spec);
    check_contour(geometry(spec), job);
  } catch (const InvalidInput&) {
    throw problem_from_current_exception("/spec");
  }
}

PlannedJob plan(const json& spec, Progress& progress) {
  progress.report("read", 0.0);
  const ContourJob job = read_contour_job(spec);
  Contour path = geometry(spec, progress);
  check_contour(path, job);
  const bool program = spec["contour"].contains("gcode");
  return job.coarse_fine ? plan_with_fine_axes(path, job, spec, program, progress)
                         : plan_cartesian(std::move(path), job, program, progress);
}

}  // namespace bahnwerk::api::contour
