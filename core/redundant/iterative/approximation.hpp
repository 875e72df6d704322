#pragma once
/// Phase 1: knots and a spline within tolerance, by least squares [Bock 4.2.2], with the least largest error [4.2.4],
/// or by Schoenberg's operator [4.2.5].
#include <optional>
#include <vector>

#include "core/redundant/iterative/coarse_fit.hpp"
#include "core/redundant/iterative/fit_rows.hpp"

namespace bahnwerk {

struct Approximation {
  FitRows rows;
  std::vector<double> variables;
  std::size_t knots = 0;  ///< inner places
};

/// None where not even T_max brings the error within tolerance. Deviations from the source, which inserts one knot per
/// pass: every pass inserts one wherever the error is too large, provided that those are so far apart that one does
/// not help the other, so the number of passes does not grow with the duration. Even knots of Chebyshev's
/// approximation are found by doubling and halving their number. The control points of Schoenberg's are the
/// positions at the Greville abscissae interpolated between samples, not those at the nearest one.
std::optional<Approximation> approximate(const CoarseTask& task, const CoarseFitOptions& options);

}  // namespace bahnwerk
