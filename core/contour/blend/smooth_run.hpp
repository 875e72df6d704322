#pragma once
/// One smooth curve in place of a run of short segments.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/contour/blend/elements.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::blending {

struct RunRange {
  double a = 0, b = 0;                              ///< along the stretch, mm
  bool clamped_begin = false, clamped_end = false;  ///< leave and meet the contour with three derivatives
};

struct RunTolerance {
  double aimed = 0;   ///< mm, at every place looked at
  double proven = 0;  ///< mm, everywhere; a little larger
};

struct SmoothedRun {
  bool done = false;
  /// Bézier curves of degree 5, joined with three continuous derivatives or four; none: the contour stays as it is.
  std::vector<std::optional<Rational>> pieces;
  std::vector<double> breaks;    ///< along the stretch, pieces + 1
  std::vector<double> troubles;  ///< if not done: where along the stretch it failed, ascending
};

/// |f(t) − contour(t)| ≤ tolerance.proven for all t: from the distances at places so close together that what both
/// curves bulge between them fits in, too. So each is within the tolerance of the other, in order, and a place of the
/// contour has its own on the curve. `borders`: places, strictly ascending (changes of the block), at which a piece
/// ends, however close together they are. Not done when the curve would turn round in a point or cannot be kept inside.
///
/// A run is smoothed from the end that its shape tells (core/contour/blend/reversed_run.hpp): backwards it becomes the
/// same curve.
///
/// A long run is smoothed in windows of some 1 000 intervals of the spline: each goes on from the state in which the
/// one before it was cut (three derivatives are common there) and reaches 96 intervals beyond its own cut, on which its
/// end then no longer shows. Where a window cannot go on from a cut, it and the one before it become one. Memory: about
/// 1.5 kB per interval of a window, and the pieces.
SmoothedRun smooth_run(const Stretch& stretch, const RunRange& range, const std::vector<double>& borders,
                       const RunTolerance& tolerance, std::size_t dimension, bool rests, ProgressScope& scope);

}  // namespace bahnwerk::blending
