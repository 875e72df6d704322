#pragma once
/// The result of kind "winding". Angles are deg; turns and coils are counted from 1.
#include <nlohmann/json_fwd.hpp>

#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk::api::winding_kind {

/// Returns the result's name of a region 0 … 3; a fixed piece may also be "coil_change".
const char* laying_region(std::size_t region);
const char* laying_region(const winding::FixedPiece& piece);
/// Returns the number of places of the layout that one coil takes.
std::size_t wires_per_coil(const WindingRequest& request, const WindingPlan& plan);
/// Returns the needle's least clearance; null where there is nothing that it could touch.
nlohmann::ordered_json clearance(const WindingPlan& plan);
/// Returns everything but summary, verification, bound and setpoints.
nlohmann::ordered_json details(const WindingRequest& request, const WindingPlan& plan, Progress progress);
/// Return members of `details`.
nlohmann::ordered_json support_points(const WindingPlan& plan, Progress progress);
nlohmann::ordered_json path(const WindingRequest& request, const WindingPlan& plan, Progress progress);
nlohmann::ordered_json links(const WindingRequest& request, const WindingPlan& plan, Progress progress);

/// Returns the verdict, rotary axes in deg; a failed check also says where on the winding it failed and what to change.
nlohmann::ordered_json placed_verification(const WindingRequest& request, const WindingPlan& plan);

}  // namespace bahnwerk::api::winding_kind
