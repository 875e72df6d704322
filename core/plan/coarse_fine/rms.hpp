#pragma once
/// How much coarse and fine axes accelerate on the whole: what heats their motors.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// √(∫a² dt / T) per axis, mm/s².
struct RmsAccelerations {
  std::vector<double> coarse, fine;
};

/// Returns both for the axes of `coarse` and for the rest of `head`, which lasts as long; Gauss' rule of five points in
/// every smooth piece of both, exact where positions are polynomials. O(pieces of both).
RmsAccelerations rms_accelerations(const Motion& head, const Motion& coarse, ProgressScope& scope);

}  // namespace bahnwerk
