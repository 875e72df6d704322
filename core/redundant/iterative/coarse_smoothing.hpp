#pragma once
/// Phase 2 by smoothing splines [Bock 4.2.6]: minimises (1 − λ) E + λ G, with the sum E of squared errors at the
/// samples and the energy G = ∫ (f″)², for the λ that the tolerance or the limits require. Each λ takes one band
/// system: O(samples).
#include <functional>
#include <optional>
#include <vector>

#include "core/numeric/linear/symmetric_band.hpp"
#include "core/redundant/iterative/coarse_fit.hpp"
#include "core/redundant/iterative/fit_rows.hpp"

namespace bahnwerk {

/// Returns half the Hessian of ∫ (f″)² with respect to the variables, exact by Gauss' rule in every span. `linear`
/// receives the constant part of the gradient, which comes from fixed control points.
SymmetricBand<> energy(const FitRows& fit, std::vector<double>& linear);

/// Returns the control points of the smoothest spline within tolerance, searched over log λ from large λ on; none if no
/// λ is within tolerance.
std::optional<std::vector<double>> smoothing_spline(const CoarseTask& task, const FitRows& fit,
                                                    const std::function<void()>& tick);

/// Smooths a least-squares spline y that exceeds a limit of the coarse axis, with the least λ that keeps the limits. If
/// no λ within tolerance keeps them, returns the spline that exceeds them least. This step is not in the source, which
/// lowers the head's limits instead, on which the fit does not depend.
std::vector<double> relieved(const CoarseTask& task, const FitRows& fit, std::vector<double> y,
                             const std::function<void()>& tick);

}  // namespace bahnwerk
