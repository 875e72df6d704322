#pragma once
/// Members `load` and `drive` of a motion law's spec → what the drive moves, and its limits.
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/cam/problem.hpp"
#include "core/cam_profile/given_drive.hpp"

namespace bahnwerk::api::motion_law {

struct DriveRequest {
  std::optional<cam::DriveLoad> load;
  cam::LoadLimits limits;
  std::optional<cam::DriveLimits> given_cycle;  ///< limits of velocity, acceleration, jerk in a cycle of given duration
  std::array<const char*, 4> section_limits{};  ///< by order: the member of `drive` that limits sections
};

/// Returns faults at limits of sections as faults at the member of `drive` that set them, once each.
std::vector<InputFault> blamed_on_drive(const std::vector<InputFault>& faults, const DriveRequest& drive);

/// Reads a spec that passed its schema. Limits become those of the problem: in a cycle of given duration limits of its
/// sections, else of its drive. A force or torque is one of acceleration where the load has neither spring nor damping.
/// Appends faults and notes.
DriveRequest read_drive(const nlohmann::json& spec, cam::MotionLawProblem& problem, std::vector<InputFault>& faults,
                        std::vector<std::string>& notes);

}  // namespace bahnwerk::api::motion_law
