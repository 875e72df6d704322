#include "api/kinds/winding/winding.hpp"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/kinds/winding/winding_input.hpp"
#include "api/kinds/winding/winding_result.hpp"
#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "api/setpoint_summary.hpp"
#include "api/verification.hpp"
#include "core/base/progress.hpp"
#include "core/plan/winding/feed_drawing.hpp"
#include "core/plan/winding/slot_access.hpp"
#include "core/plan/winding/winding_drawings.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json slot_access_result(const SlotAccess& access) {
  return {{"step", access.step},
          {"without_pivot_shift", access.shares.front()},
          {"with_pivot_shift", access.shares.size() > 1 ? ordered_json(access.shares[1]) : ordered_json()}};
}

ordered_json summary(const WindingRequest& request, const WindingPlan& plan) {
  const double least = plan.clearance.minimum;
  return {{"duration", plan.motion.duration},
          {"path_length", plan.path_length},
          {"wire_length", plan.wire_length},
          {"resistance", plan.resistance},
          {"strokes_per_minute", plan.strokes_per_minute},
          {"coils", plan.turns.empty() ? 0 : plan.turns.back().coil + 1},
          {"turns", plan.turns.size()},
          {"parallel", request.parallel},
          {"producible", plan.windable.can_be_wound(wires_per_coil(request, plan))},
          {"windable_turns", plan.windable.most() / request.parallel},
          {"clearance", std::isfinite(least) ? ordered_json(least) : ordered_json()}};
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
  const WindingRequest asked = request(spec);
  WindingPlan plan = [&] {
    try {
      return plan_winding(asked, progress);
    } catch (const InvalidInput& error) {
      throw relocated(error);
    }
  }();
  PlannedJob job;
  job.verified = plan.motion.verification.passed;
  job.result = {{"kind", "winding"},
                {"summary", summary(asked, plan)},
                {"verification", placed_verification(asked, plan)},
                {"bound", bound(plan.motion.bound)},
                {"setpoints", setpoint_summary(*plan.motion.setpoints)},
                {"details", details(asked, plan, progress)}};
  progress.report("drawing", 1);
  job.result["details"]["drawings"] = {{"needle_path.svg", needle_path_drawing(asked, plan)},
                                       {"needle_path.dxf", needle_path_dxf(plan)},
                                       {"curvature.svg", turn_curvature_drawing(plan)},
                                       {"feed.svg", feed_drawing(asked, plan)}};
  job.result["details"]["access"] = nullptr;
  if (const auto access = slot_access(asked, progress)) {
    job.result["details"]["access"] = slot_access_result(*access);
    job.result["details"]["drawings"]["clearance_map.svg"] = access->drawing;
  }
  job.setpoints = std::move(plan.motion.setpoints);
  return job;
}

}  // namespace bahnwerk::api::winding_kind
