#pragma once
/// The few ways in which planning fails. They carry numbers and places, not prose; api/ turns them into problem
/// documents.
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bahnwerk {

/// Base class of every exception that core throws on purpose.
struct PlanningError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A fault in the input. Its place is a list of member names and indices: {"blocks", "3", "arc"} is the JSON pointer
/// /blocks/3/arc.
struct InputFault {
  std::vector<std::string> place;
  std::string message;
};
/// Thrown for input that is well-formed but contradictory: zero length, a gap, limits that exclude each other. It
/// contains all faults, in document order.
struct InvalidInput : PlanningError {
  explicit InvalidInput(std::vector<InputFault> list)
      : PlanningError(list.empty() ? std::string("invalid input") : list.front().message), faults(std::move(list)) {}
  std::vector<InputFault> faults;
};

/// Thrown where no motion satisfies the limits.
struct Infeasible : PlanningError {
  using PlanningError::PlanningError;
};
/// Thrown for a pose outside the machine's reach, and for one at which its axes cannot follow the tool (a singularity,
/// the end of a range).
struct UnreachablePose : PlanningError {
  using Pose = std::array<double, 5>;
  UnreachablePose(const std::string& what, double at, const Pose& tool = {})
      : PlanningError(what), path_length(at), pose(tool) {}
  double path_length;  ///< place on the path, mm; NaN as long as only the pose is known
  Pose pose;           ///< the tool: x, y, z, mm; φ, ψ, rad
};
/// Thrown where a tolerance cannot be met; `reached` is the smallest deviation found, in the tolerance's unit.
struct ToleranceUnreachable : PlanningError {
  ToleranceUnreachable(const std::string& what, double best) : PlanningError(what), reached(best) {}
  double reached;
};

/// Why a planner has to end.
enum class StopReason { cancelled, deadline, budget };
/// Thrown by Progress::report when the planner has to end.
struct Stopped : PlanningError {
  explicit Stopped(StopReason why) : PlanningError("stopped"), reason(why) {}
  StopReason reason;
};

}  // namespace bahnwerk
