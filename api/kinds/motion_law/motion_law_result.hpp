#pragma once
/// A planned motion law → result document.
#include <optional>

#include "api/kinds/kind_frame.hpp"
#include "api/kinds/motion_law/motion_law_input.hpp"
#include "core/plan/motion_law/cam_plan.hpp"
#include "core/plan/motion_law/load_plan.hpp"

namespace bahnwerk::api::motion_law {

/// The law, and what it moves.
struct MotionLawPlan : LawPlan {
  std::optional<CamPlan> cam;
  std::optional<LoadPlan> load;
};

/// Returns the report without drawings and table.
KindReport report_law(const MotionLawRequest& request, const MotionLawPlan& plan);

}  // namespace bahnwerk::api::motion_law
