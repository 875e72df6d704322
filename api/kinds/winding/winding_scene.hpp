#pragma once
/// The scene of a winding: the obstacles of its needle, the slots of its coils, the needle, the laid wires.
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "api/scene.hpp"
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk::api::winding_kind {

/// Members of the result that the scene needs: the layouts and the times of the turns.
inline constexpr std::array<std::string_view, 2> scene_parts{"details.layout.regions", "details.turns"};
/// Returns the scene in the frame of the part. `result` has the scene_parts; without them no wires are laid. About
/// 1 ms.
Scene winding_scene(const WindingRequest& request, const nlohmann::json& result);

}  // namespace bahnwerk::api::winding_kind
