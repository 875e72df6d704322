#pragma once
/// A planned motion law → result document.
#include "api/kind_frame.hpp"
#include "api/kinds/motion_law/motion_law_input.hpp"

namespace bahnwerk::api::motion_law {

/// Returns the report without drawings and table.
KindReport report_law(const MotionLawRequest& request, const LawPlan& plan);

}  // namespace bahnwerk::api::motion_law
