#pragma once
/// Support points for tests that nobody follows.
#include <vector>

#include "core/base/progress.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {

inline std::vector<FixedPiece> support_points(const StatorPart& part, const std::vector<Coil>& coils,
                                              const std::vector<Turn>& turns, const NeedleModel& model) {
  Progress progress;
  return *support_points(part, coils, turns, model, progress);
}
inline std::vector<FixedPiece> support_points(const RotorPart& part, const std::vector<Turn>& turns,
                                              const NeedleModel& model) {
  Progress progress;
  return *support_points(part, turns, model, progress);
}

}  // namespace bahnwerk::winding
