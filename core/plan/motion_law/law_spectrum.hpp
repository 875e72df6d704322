#pragma once
/// The spectrum of a law's acceleration.
#include <cstddef>
#include <vector>

#include "core/cam/cam_law.hpp"

namespace bahnwerk {

/// Returns the number of harmonics that are worth showing: 40, and up to 200 where there are many sections.
std::size_t shown_harmonics(const cam::MotionLawProblem& problem);

/// Returns the amplitudes 2/T |∫ a(t) e^(−2πikt/T) dt| over one cycle, k = 1 … harmonics, unit/s²: of an open law those
/// of its repetition. Gauss–Legendre quadrature, at most half a period of the last harmonic per five points: to 1e-9 of
/// the peak acceleration.
std::vector<double> acceleration_spectrum(const cam::CamLaw& law, std::size_t harmonics);

}  // namespace bahnwerk
