#pragma once
/// Energy of accelerations: a measure of how much a motion stresses its axes.
#include <vector>

#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Returns ∫a² dt over the whole motion, per axis, in mm²/s³ (or deg²/s³). Gauss–Legendre quadrature with five points
/// per piece is exact up to rounding where positions are polynomials of degree at most 6. O(pieces · axes).
std::vector<double> acceleration_energy(const Motion& motion);

}  // namespace bahnwerk
