#pragma once
/// The passages of a winding through the slots of its coils, for the verifier.
#include "core/plan/winding/winding_plan.hpp"
#include "core/verify/setpoints/coil_slot_checks.hpp"

namespace bahnwerk {

/// Returns the check's inputs: slots by the part and the coils of the request, wires by the turns of the plan, which
/// has its turns and its machine's path. `setpoints` has to outlive the result. O(turns).
CoilSlotInput coil_passes(const WindingRequest& request, const WindingPlan& plan, const SetpointSource& setpoints);

}  // namespace bahnwerk
