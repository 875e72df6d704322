#include "api/kinds/contour/contour.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "api/kinds/contour/coarse_fine.hpp"
#include "api/kinds/contour/contour_details.hpp"
#include "api/kinds/contour/contour_scene.hpp"
#include "api/kinds/kind_frame.hpp"
#include "api/verification.hpp"
#include "api/views/segments.hpp"
#include "core/base/borrowed.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/machine/degrees.hpp"
#include "core/plan/coarse_fine/axis_drawing.hpp"
#include "core/plan/contour/contour_axes.hpp"
#include "core/plan/contour/contour_drawing.hpp"
#include "core/plan/contour/contour_faults.hpp"
#include "core/plan/contour/contour_outline.hpp"
#include "core/plan/contour/driven_segments.hpp"
#include "core/plan/path_plan.hpp"
#include "core/plan/planning_method.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t max_outline = 5000;  // vertices

/// `law` is the time law of the motion along the path; `way` is the path of the coarse axes, if there are any.
ordered_json drawings(const ContourPlan& plan, const TimeLaw& law, std::vector<Vec> way, Progress progress) {
  char title[80];
  std::snprintf(title, sizeof title, "path of %.6g mm, %.6g s", plan.path_length, plan.duration);
  return {{"contour.svg", contour_drawing(*plan.path, {.title = title, .way = std::move(way), .law = &law}, progress)}};
}

void throw_if_any(std::vector<InputFault> faults) {
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

/// The request of a job, with all checks that do not need its geometry.
struct ContourJob {
  std::optional<CoarseFineMachine> coarse_fine;
  ToolMachine head;  ///< the machine; of coarse and fine axes the sums
  ContourPlanning planning;
  RedundancyOptions redundancy;
  std::vector<StudyRequest> studies;
  std::vector<std::string> unused;  ///< notes on what of the document plays no part
  bool program = false;             ///< whether the contour is a program, which has lines
  Contour contour;
};

ContourJob read_contour_job(const json& spec) {
  ContourJob job;
  job.program = spec["contour"].contains("gcode");
  job.planning = planning(spec);
  job.planning.max_setpoints = max_setpoints;
  std::vector<InputFault> faults;
  if (coarse_fine(spec)) {
    job.coarse_fine = coarse_fine_machine(spec);
    job.head = summed(*job.coarse_fine);
    job.redundancy = redundancy(spec, job.planning);
    job.studies = study_requests(spec);
    job.unused = unused_options(spec);
    check_redundancy(spec, *job.coarse_fine, job.planning, faults);
    check_corners(job.planning, faults);
    throw_if_any(std::move(faults));
    job.planning.method =
        job.coarse_fine->limited_order() == 3 ? PlanningMethod::jerk_limited : PlanningMethod::time_optimal;
    return job;
  }
  job.head = machine(spec);
  if (job.planning.machine_study)
    faults.push_back({{"planning", "machine_study"}, "is for machines with coarse and fine axes"});
  throw_if_any(std::move(faults));
  throw_if_any(planning_faults(job.head, job.planning));
  return job;
}

void check_contour(const Contour& contour, ContourJob& job) {
  std::vector<InputFault> faults;
  if (!job.coarse_fine) return throw_if_any(contour_faults(contour, job.head, job.planning));
  check_axes(contour, job.head, "coarse", faults);
  const double shortest = shortest_time(contour, job.head);
  check_setpoints(shortest, job.head, max_setpoints, faults);
  check_range(*job.coarse_fine, contour, faults);
  throw_if_any(std::move(faults));
  job.redundancy.least_stroke = least_stroke(*job.coarse_fine, shortest);
  for (std::string& note : unresolved_strokes(*job.coarse_fine, job.redundancy.least_stroke))
    job.unused.push_back(std::move(note));
}

/// Throws InvalidInput where the machine cannot follow, with the line of the program or the number of the segment.
[[noreturn]] void unreachable(const ContourJob& job, const Contour& contour, const UnreachablePose& pose) {
  char text[120];
  const std::size_t source = contour.path[contour.path.find(pose.path_length >= 0 ? pose.path_length : 0)].source();
  std::snprintf(text, sizeof text, "%s %zu, at x %.6g, y %.6g, z %.6g mm: ", job.program ? "line" : "segment", source,
                pose.pose[0], pose.pose[1], pose.pose[2]);
  throw InvalidInput(
      {{{"contour"},
        std::string(text) + pose.what() + "; move the contour, the machine's origin or the ends of the range"}});
}

/// The axes of the machine along the contour as it is given. The job has to outlive it.
struct GivenAxes {
  explicit GivenAxes(const ContourJob& job)
      : axes(borrowed(job.contour), job.head), moving(axes.along(borrowed(job.contour)).moving) {}
  ContourAxes axes;
  std::shared_ptr<const AxisPath> moving;
};

/// Throws InvalidInput naming the place at which the machine cannot follow the contour, as it is given.
void check_reach(const ContourJob& job) {
  if (job.head.cartesian()) return;
  try {
    const GivenAxes reached(job);
  } catch (const UnreachablePose& pose) {
    unreachable(job, job.contour, pose);
  }
}

/// The plan: along the machine's axes, or with coarse and fine ones and possibly a study of machines.
struct Planned {
  ContourPlan contour;
  std::optional<CoarseFinePlan> coarse_fine;  ///< has its own `contour`
  std::optional<MachineStudy> study;

  ContourPlan& head() { return coarse_fine ? coarse_fine->contour : contour; }
};

ContourPlan plan_cartesian(ContourJob& job, Progress progress) {
  ContourPlan plan = plan_contour(std::move(job.contour), job.head, job.planning, progress);
  if (method_row(job.planning.method).order == 2)
    for (const auto& axis : job.head.axes)
      if (axis.jerk < unlimited) {
        plan.notes.push_back("jerk limits are given but not held: only method jerk_limited holds them");
        break;
      }
  return plan;
}

constexpr double planned_of_study =
    0.15;  // part of the progress in which a job with a study plans the machine as it is

Planned plan_with_fine_axes(const ContourJob& job, Progress progress) {
  const CoarseFineMachine& machine = *job.coarse_fine;
  const bool study = job.planning.machine_study;
  // A job without a study shows the planner's own stages.
  const Progress first = study ? progress.part(0, planned_of_study).named("planning") : progress;
  Planned planned;
  planned.coarse_fine = plan_coarse_fine(job.contour, machine, job.planning, job.redundancy, first);
  std::vector<std::string>& notes = planned.head().notes;
  notes.insert(notes.end(), job.unused.begin(), job.unused.end());
  if (study)
    planned.study = machine_study(job.contour, machine, job.planning, job.redundancy, job.studies,
                                  progress.part(planned_of_study, 1));
  return planned;
}

/// Returns all coarse and fine axes with their limits, named as their columns are.
Machine stage_axes(const CoarseFineMachine& machine) {
  Machine axes;
  for (const bool fine : {false, true})
    for (const CoarseFineAxis& axis : machine.axes)
      if (!fine || axis.stroke > 0)
        axes.axes.emplace_back(axis.name + (fine ? "f" : "c"), fine ? axis.fine : axis.coarse);
  return axes;
}

void report_fine_axes(const ContourJob& job, const Planned& planned, Progress progress, KindReport& out) {
  const CoarseFinePlan& plan = *planned.coarse_fine;
  report(plan, *job.coarse_fine, job.redundancy.method, job.program, out);
  if (job.redundancy.method == RedundancyMethod::lag_compensation)
    report_prefilter(job.redundancy, job.coarse_fine->cycle_time, out);
  out.drawings["axes.svg"] = axis_drawing(plan, *job.coarse_fine, progress);
  if (!planned.study) return;
  report(*planned.study, plan.contour.duration, out);
  out.drawings["machine_study.svg"] = machine_study_drawing(*planned.study, plan.contour.duration);
}

std::shared_ptr<const SegmentTable> table_of(const std::vector<DrivenSegment>& segments, bool program) {
  auto table = std::make_shared<SegmentTable>();
  table->program = program;
  table->segments.reserve(segments.size());
  for (const DrivenSegment& s : segments)
    table->segments.push_back({static_cast<std::uint32_t>(s.source), static_cast<std::uint32_t>(s.block),
                               s.mode == Mode::cut, s.rests, s.start, s.time, s.length, s.feed, s.least_time});
  return table;
}

/// Returns what the motion of the setpoints drives when.
std::shared_ptr<const SegmentTable> segments(const ContourPlan& plan, const ContourJob& job, const TimeLaw& law,
                                             Progress progress) {
  const auto axes = plan.axes ? plan.axes : std::make_shared<const ContourAxes>(plan.path, job.head);
  return table_of(driven_segments(*plan.path, *axes->along(plan.path).moving, axes->machine(), law, progress),
                  job.program);
}

struct ContourKind {
  static constexpr std::string_view name = "contour";
  static constexpr std::string_view title = "A tool head along a planar or spatial contour";

  static constexpr std::array<std::string_view, 0> scene_parts{};

  static ContourJob read(const json& spec, Progress progress) {
    ContourJob job = read_contour_job(spec);
    job.contour = geometry(spec, progress);
    check_contour(job.contour, job);
    check_reach(job);
    return job;
  }

  static ViewFacts view_facts(const ContourJob& job) {
    ViewFacts facts;
    std::vector<double> feeds;
    for (const Block& block : job.contour.blocks) feeds.push_back(std::min(block.feed, job.planning.along.velocity));
    declare_feeds(facts.limits, feeds);
    Limits along = job.planning.along;
    along.velocity = unlimited;  // it is part of the feeds
    if (!job.coarse_fine) {
      declare_axes(facts.limits, held_limits(in_degrees(job.head), method_row(job.planning.method)));
      declare_path(facts.limits, along);
      return facts;
    }
    declare_axes(facts.limits, stage_axes(*job.coarse_fine));
    declare_path(facts.limits, along);
    for (const CoarseFineAxis& axis : job.coarse_fine->axes)
      if (axis.stroke > 0)
        facts.limits.push_back({"stroke " + axis.name + "f", "mm", axis.name + "f", 0, {-axis.stroke, axis.stroke}});
    return facts;
  }

  static std::shared_ptr<const SegmentTable> document_segments(const ContourJob& job, Progress progress) {
    const GivenAxes given(job);
    return table_of(bahnwerk::document_segments(job.contour, *given.moving, given.axes.machine(), progress),
                    job.program);
  }

  /// A contour has a scene where coarse and fine axes move in space.
  static bool has_scene(const json& spec) {
    const json& machine = spec.at("machine");
    return machine.contains("coarse") && machine["coarse"].contains("z");
  }

  static Scene scene(const ContourJob& job, const json&, Progress progress) {
    return contour_scene(job.contour, *job.coarse_fine, progress);
  }

  static ordered_json preview(const ContourJob& job, Progress progress) {
    const GivenAxes given(job);
    const DurationEstimate time =
        estimate_duration(job.contour, *given.moving, given.axes.machine(), job.planning.corner_angle, progress);
    const Outline shape = outline(job.contour, max_outline, progress);
    ordered_json vertices = ordered_json::array(), cut = ordered_json::array();
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
      ordered_json vertex = ordered_json::array();
      for (std::size_t k = 0; k < job.contour.dimension; ++k) vertex.push_back(shape.vertices[i][k]);
      vertices.push_back(std::move(vertex));
      cut.push_back(shape.cut[i] ? 1 : 0);
    }
    std::vector<std::string> notes = job.contour.notes;
    notes.insert(notes.end(), job.unused.begin(), job.unused.end());
    const double duration = time.cut_time + time.position_time;
    return {{"notes", std::move(notes)},
            {"estimate",
             {{"duration", duration},
              {"cut_time", time.cut_time},
              {"position_time", time.position_time},
              {"path_length", job.contour.path.length()},
              {"setpoints", static_cast<std::size_t>(duration / job.head.cycle_time) + 1}}},
            {"outline", {{"vertices", std::move(vertices)}, {"cut", std::move(cut)}, {"tolerance", shape.tolerance}}}};
  }

  static Planned plan(ContourJob& job, Progress progress) {
    return job.coarse_fine ? plan_with_fine_axes(job, progress)
                           : Planned{plan_cartesian(job, progress), std::nullopt, std::nullopt};
  }

  static KindReport report(const ContourJob& job, Planned& planned, Progress progress) {
    ContourPlan& plan = planned.head();
    KindReport out;
    out.summary = {{"duration", plan.duration},
                   {"cut_time", plan.cut_time},
                   {"position_time", plan.position_time},
                   {"path_length", plan.path_length},
                   {"iterations", plan.iterations}};
    out.verification = verification(plan.verification);
    out.bound = bound(plan.bound);
    out.details = details(plan, job.head, job.planning, job.program);
    const auto& fine = planned.coarse_fine;
    out.drawings = drawings(plan, fine ? fine->head->law() : plan.motion->law(),
                            fine ? coarse_way(*fine) : std::vector<Vec>{}, progress);
    if (fine) report_fine_axes(job, planned, progress, out);
    out.segments = segments(plan, job, fine ? fine->head->law() : plan.motion->law(), progress);
    out.setpoints = std::move(plan.setpoints);
    return out;
  }
};

}  // namespace

}  // namespace bahnwerk::api::contour

namespace bahnwerk::api {
Kind describe_contour() { return kind_of<contour::ContourKind>(); }
}  // namespace bahnwerk::api
