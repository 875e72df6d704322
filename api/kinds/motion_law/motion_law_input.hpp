#pragma once
/// The spec of kind "motion_law" → problem and table.
#include <nlohmann/json_fwd.hpp>

#include "api/kinds/motion_law/drive_input.hpp"
#include "core/cam_profile/cam_geometry.hpp"
#include "core/plan/motion_law/law_plan.hpp"

namespace bahnwerk::api::motion_law {

struct MotionLawRequest {
  cam::MotionLawProblem problem;
  LawSampling sampling;
  bool drawings = true;
  std::optional<cam::CamGeometry> cam;
  DriveRequest drive;
  std::vector<std::string> notes;  ///< remarks on members without effect
};

/// Reads a spec that passed its schema. Throws InvalidInput naming every fault, with places relative to the spec.
MotionLawRequest request(const nlohmann::json& spec);

}  // namespace bahnwerk::api::motion_law
