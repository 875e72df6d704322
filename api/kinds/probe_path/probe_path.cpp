#include "api/kinds/probe_path/probe_path.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "api/setpoint_summary.hpp"
#include "api/verification.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/plan/probe/probe_drawings.hpp"

namespace bahnwerk::api::probe_path {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json summary(const ProbePlan& plan) {
  return {{"duration", plan.duration},
          {"path_length", plan.figures.path_length},
          {"max_deviation", plan.figures.max_deviation},
          {"mean_speed", plan.figures.path_length / plan.duration},
          {"speed_ripple", plan.figures.speed_ripple}};
}

}  // namespace

void check(const json& spec) {
  try {
    request(spec);
  } catch (const InvalidInput&) {
    throw problem_from_current_exception("/spec");
  }
}

PlannedJob plan(const json& spec, Progress& progress) {
  progress.report("read", 0.0);
  const ProbeRequest asked = request(spec);
  ProbePlan plan = plan_probe(asked, progress);
  PlannedJob job;
  job.verified = plan.verification.passed;
  job.result = {{"kind", "probe_path"},
                {"summary", summary(plan)},
                {"verification", verification(plan.verification)},
                {"bound", bound(plan.bound)},
                {"setpoints", setpoint_summary(*plan.setpoints)},
                {"details", details(spec, asked, plan)}};
  progress.report("drawing", 1);
  job.result["details"]["drawings"] = {{"path.svg", probe_path_drawing(plan)},
                                       {"motion.svg", probe_motion_drawing(plan, progress)}};
  job.setpoints = std::move(plan.setpoints);
  return job;
}

}  // namespace bahnwerk::api::probe_path
