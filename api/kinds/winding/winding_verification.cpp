// The verdict on a winding: rotary axes in deg; failed checks with their place and advice.
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "api/kinds/winding/winding_result.hpp"
#include "api/slot/slot_input.hpp"
#include "api/verification.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::ordered_json;

Verification in_degrees(Verification verdict) {
  for (Check& check : verdict.checks) {
    if (check.unit != "rad") continue;
    check.unit = "deg";
    check.limit *= 180 / std::numbers::pi, check.value *= 180 / std::numbers::pi;
  }
  return verdict;
}

/// Returns the piece of the needle's path at time `t`, s.
const winding::NeedlePiece& piece_at(const WindingPlan& plan, double t) {
  const TimeLaw& law = plan.motion.motion->law();
  return plan.path.pieces.at(plan.tool->tool[law.pieces().at(law.find(t)).segment].source());
}

ordered_json place(const WindingPlan& plan, const winding::NeedlePiece& piece, const std::string& obstacle) {
  const winding::FixedPiece& fixed = plan.support.at(piece.fixed);
  std::string words = "turn " + std::to_string(fixed.turn + 1) + " of coil " + std::to_string(fixed.coil + 1) + ", " +
                      (piece.link ? "on the link after " : "in ") +
                      (fixed.kind == winding::FixedPiece::Kind::coil_change ? "the way to the next coil"
                                                                            : winding::region_in_words(fixed.region));
  if (!obstacle.empty()) words += ", nearest to: " + obstacle;
  ordered_json out{
      {"coil", fixed.coil + 1}, {"turn", fixed.turn + 1}, {"region", laying_region(fixed)}, {"link", piece.link}};
  if (!obstacle.empty()) out["obstacle"] = obstacle;
  out["words"] = std::move(words);
  return out;
}

std::string change(const WindingRequest& request, const std::string& name, const std::string& obstacle) {
  if (name == "needle clearance" && obstacle == "winding tool")
    return "needed is a smaller post (tool.width, tool.height), another part.tool_shift, or a narrower needle";
  if (name == "needle clearance") {
    std::string text = "needed is a narrower needle than " + short_number(request.needle.width) + " mm (needle.width)";
    if (std::holds_alternative<winding::StatorPart>(request.part))
      text += request.model.pivot_limit ? ", a larger needle.pivot_limit"
                                        : ", or a needle that swivels (needle.pivot_limit)";
    if (request.least_clearance > 0) text += ", or less needle.clearance";
    return text + ", another path.extra_point or fewer coil.turns";
  }
  if (name == "wire pull") return "needed is less pull.force or pull.effective_mass, or a slower feed";
  if (name == "wire slack") return "needed is more pull.force, less pull.effective_mass, or a slower feed";
  if (name == "chord error")
    return "needed is a slower feed, a shorter machine.cycle_time or more feed.chord_tolerance";
  if (name == "setpoint path velocity") return "needed is feed.interpolator exact, or more feed.tolerance";
  if (name.starts_with("setpoint ")) {
    if (request.interpolator != Interpolator::exact) return "needed is feed.interpolator exact, or a slower feed";
    return request.links.continuity < 2 ? "needed is path.continuity 2 or more, or a slower feed"
                                        : "needed is a slower feed";
  }
  return {};
}

}  // namespace

ordered_json placed_verification(const WindingRequest& request, const WindingPlan& plan) {
  ordered_json verdict = verification(in_degrees(plan.motion.verification));
  for (ordered_json& check : verdict["checks"]) {
    if (check["passed"].get<bool>()) continue;
    const auto name = check["name"].get<std::string>();
    if (name == "bound") continue;
    const bool clearance = name == "needle clearance";
    check["place"] = place(plan, clearance ? plan.path.pieces.at(plan.clearance.move) : piece_at(plan, check["at"]),
                           clearance ? plan.nearest : "");
    if (std::string text = change(request, name, plan.nearest); !text.empty()) check["change"] = std::move(text);
  }
  return verdict;
}

}  // namespace bahnwerk::api::winding_kind
