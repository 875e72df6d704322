#pragma once
/// Phase 2 by smoothing splines [Bock 4.2.6]: (1 − λ) E + λ G of the squared errors E at the samples and the energy
/// G = ∫ (f″)², for the λ that the tolerance or the limits ask for. Each λ takes one band system: O(samples).
#include <functional>
#include <optional>
#include <vector>

#include "core/redundant/iterative/band_matrix.hpp"
#include "core/redundant/iterative/coarse_fit.hpp"
#include "core/redundant/iterative/fit_rows.hpp"

namespace bahnwerk {

/// ∫ (f″)² of the variables, half its Hessian: Gauss' rule is exact in every span. The gradient's constant part, which
/// fixed control points leave, goes to `linear`.
BandMatrix energy(const FitRows& fit, std::vector<double>& linear);

/// The smoothest of (1 − λ) E + λ G within tolerance, searched from large λ on by its logarithm.
std::optional<std::vector<double>> smoothing_spline(const CoarseTask& task, const FitRows& fit,
                                                    const std::function<void()>& tick);

/// Least squares that exceed a limit of the coarse axis while the fine one has room, made as much smoother as the limit
/// needs and the room allows: (1 − λ) E + λ G with the least such λ. Where no λ within tolerance holds the limits, the
/// one that exceeds them least. Ours: the source lowers the head's limits there, which the fit does not depend on.
std::vector<double> relieved(const CoarseTask& task, const FitRows& fit, std::vector<double> y,
                             const std::function<void()>& tick);

}  // namespace bahnwerk
