#include "api/kinds/winding/winding.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/kinds/kind_frame.hpp"
#include "api/kinds/winding/winding_input.hpp"
#include "api/kinds/winding/winding_result.hpp"
#include "api/kinds/winding/winding_scene.hpp"
#include "api/verification.hpp"
#include "core/base/progress.hpp"
#include "core/machine/degrees.hpp"
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

struct WindingKind {
  static constexpr std::string_view name = "winding";
  static constexpr std::string_view title =
      "Coils of a stator or rotor wound by a needle, from slot to machine setpoints";

  static constexpr auto scene_parts = winding_kind::scene_parts;

  static WindingRequest read(const json& spec, Progress) { return request(spec); }

  static ViewFacts view_facts(const WindingRequest& asked) {
    ViewFacts facts;
    declare_path(facts.limits, asked.along);
    declare_axes(facts.limits, in_degrees({asked.configurations.front()->axes(), 0}));
    const double bears = std::min(asked.tension.permitted, asked.bears > 0 ? asked.bears : unlimited);
    if (std::isfinite(bears)) facts.limits.push_back({"wire tension", "N", "tension", 0, {-bears, bears}});
    return facts;
  }

  static Scene scene(const WindingRequest& asked, const json& result, Progress) { return winding_scene(asked, result); }

  static WindingPlan plan(const WindingRequest& asked, Progress progress) {
    try {
      return plan_winding(asked, progress);
    } catch (const InvalidInput& error) {
      throw relocated(error);
    }
  }

  static KindReport report(const WindingRequest& asked, WindingPlan& plan, Progress progress) {
    KindReport out;
    out.summary = summary(asked, plan);
    out.verification = placed_verification(asked, plan);
    out.bound = bound(plan.motion.bound);
    out.details = details(asked, plan, progress);
    progress.report("drawing", 1);
    out.details["drawings"] = {{"needle_path.svg", needle_path_drawing(asked, plan)},
                               {"needle_path.dxf", needle_path_dxf(plan)},
                               {"curvature.svg", turn_curvature_drawing(plan)},
                               {"feed.svg", feed_drawing(asked, plan)}};
    out.details["access"] = nullptr;  // stands behind the drawings
    if (const auto access = slot_access(asked, progress)) {
      out.details["access"] = slot_access_result(*access);
      out.details["drawings"]["clearance_map.svg"] = access->drawing;
    }
    out.setpoints = std::move(plan.motion.setpoints);
    return out;
  }
};

}  // namespace
}  // namespace bahnwerk::api::winding_kind

namespace bahnwerk::api {
Kind describe_winding() { return kind_of<winding_kind::WindingKind>(); }
}  // namespace bahnwerk::api
