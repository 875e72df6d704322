#pragma once
/// How roughly a motion drives its axes.
#include <vector>

#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Returns ∫a² dt of every axis, unit²/s³, by Gauss' rule of five points on every piece: exact up to rounding where
/// positions are polynomials of degree 6 at most. O(pieces · axes).
std::vector<double> acceleration_energy(const Motion& motion);

}  // namespace bahnwerk
