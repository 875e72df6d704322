#pragma once
/// Replaces a run of short segments by one smooth curve.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/contour/blend/elements.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::blending {

/// A range of an element run.
struct RunRange {
  double a = 0, b = 0;  ///< ends of the range along the element run, mm
  bool clamped_begin = false,
       clamped_end = false;  ///< whether the curve has three derivatives in common with the contour at that end
};

/// Largest distances of the curve from the contour.
struct RunTolerance {
  double aimed = 0;   ///< largest distance at every place that is evaluated, mm
  double proven = 0;  ///< largest distance anywhere, mm; a little larger
};

/// How smooth_run() replaces a run.
struct SmoothRunOptions {
  RunTolerance tolerance;
  std::size_t dimension = 2;  ///< number of the contour's coordinates, 2 or 3
  bool rests = false;         ///< whether a window in which no curve is found may end at a rest
};

/// The result of smooth_run().
struct SmoothedRun {
  bool done = false;
  /// Bézier curves of degree 5, joined with three or four continuous derivatives; an empty entry means that the contour
  /// stays as given.
  std::vector<std::optional<Rational>> pieces;
  std::vector<double> breaks;             ///< places along the element run at which pieces meet, pieces + 1
  std::vector<double> failure_positions;  ///< places at which no curve was found, ascending; empty if done
};

/// Replaces a run by one curve with |f(t) − contour(t)| ≤ tolerance.proven for all t, from distances at places so close
/// together that the bulges of both curves between them are included. Each curve is therefore within the tolerance of
/// the other, in order, and a place of the contour has its place on the curve. A piece ends at each of `borders`
/// (changes of the block, strictly ascending), however close together they are. `done` is false if the curve would
/// reverse in a point or cannot stay inside.
///
/// The shape of a run decides from which end it is smoothed (core/contour/blend/reversed_run.hpp), so its reverse
/// becomes the same curve.
///
/// A long run is smoothed in windows of some 1 000 intervals of the spline: each starts from the state in which the
/// previous one was cut (three derivatives are common there) and extends 96 intervals beyond its own cut, where its end
/// has no visible influence. If a window cannot start from a cut, it is merged with the previous one. Memory: about 1.5
/// kB per interval of a window, and the pieces.
SmoothedRun smooth_run(const ElementRun& stretch, const RunRange& range, const std::vector<double>& borders,
                       const SmoothRunOptions& options, ProgressScope& progress);

}  // namespace bahnwerk::blending
