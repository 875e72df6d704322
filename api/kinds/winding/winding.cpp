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
#include "core/plan/winding/feed_drawing.hpp"
#include "core/plan/winding/slot_access.hpp"
#include "core/plan/winding/winding_drawings.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// The setpoints with what they are computed from: path and machine are the plan's.
class PlannedSetpoints final : public SetpointSource {
 public:
  PlannedSetpoints(WindingPlan& plan, PoseFrame frame)
      : frame_(frame), tool_(plan.tool), machine_(plan.machine.kinematics), source_(std::move(plan.motion.setpoints)) {}
  const std::vector<Column>& columns() const override { return source_->columns(); }
  std::size_t count() const override { return source_->count(); }
  double cycle_time() const override { return source_->cycle_time(); }
  double duration() const override { return source_->duration(); }
  std::optional<PoseFrame> pose_frame() const override { return frame_; }
  void read(std::size_t first, std::size_t rows, double* out) const override { source_->read(first, rows, out); }

 private:
  PoseFrame frame_;
  std::shared_ptr<const PosePath> tool_;
  std::shared_ptr<const Kinematics> machine_;
  std::unique_ptr<SetpointSource> source_;
};

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
  const Bound& bound = plan.motion.bound;
  PlannedJob job;
  job.verified = plan.motion.verification.passed;
  job.result = {{"kind", "winding"},
                {"summary", summary(asked, plan)},
                {"verification", placed_verification(asked, plan)},
                {"bound", {{"duration", bound.duration}, {"gap", bound.gap}, {"basis", bound.basis}}},
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
  job.setpoints = std::make_unique<PlannedSetpoints>(plan, pose_frame(spec));
  return job;
}

}  // namespace bahnwerk::api::winding_kind
