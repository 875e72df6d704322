#pragma once
/// Root mean square accelerations of coarse and fine axes, a measure of the heat in their motors.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// √(∫a² dt / T) per axis, mm/s².
struct RmsAccelerations {
  std::vector<double> coarse, fine;
};

/// Returns the values for the coarse axes and for the fine ones (`head` less `coarse`, of equal duration), by Gauss
/// quadrature with five points in every interval in which both are smooth; exact where positions are polynomials.
/// O(pieces of both).
RmsAccelerations rms_accelerations(const Motion& head, const Motion& coarse, ProgressScope& scope);

}  // namespace bahnwerk
