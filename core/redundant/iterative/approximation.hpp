#pragma once
/// Phase 1 of the coarse fit: knots, and a spline within tolerance of the samples, by least squares [Bock 4.2.2],
/// Chebyshev approximation (least largest error) [4.2.4] or Schoenberg's operator [4.2.5].
#include <optional>
#include <vector>

#include "core/redundant/iterative/coarse_fit.hpp"
#include "core/redundant/iterative/fit_rows.hpp"

namespace bahnwerk {

struct Approximation {
  FitRows rows;
  std::vector<double> variables;  ///< free control points, mm
  std::size_t knots = 0;          ///< number of places of inner knots
};

/// Returns the approximation, or none if not even the finest knots, T_max, bring the error within tolerance.
///
/// Deviations from the source: each pass inserts a knot at every place where the error is too large, unless two such
/// places are so close that one knot may serve both; the source inserts one per pass, so that its number of passes
/// grows with the duration. Even knots of Chebyshev's approximation are found by doubling and halving their number.
/// Schoenberg's control points are the positions at the Greville abscissae interpolated between samples; the source
/// takes the nearest sample.
std::optional<Approximation> approximate(const CoarseTask& task, const CoarseFitOptions& options);

}  // namespace bahnwerk
