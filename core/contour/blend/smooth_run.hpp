#pragma once
/// One smooth curve in place of a run of short segments.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/contour/blend/elements.hpp"
#include "core/curve/rational.hpp"

namespace bahnwerk::blending {

struct RunRange {
  double a = 0, b = 0;                              ///< along the stretch, mm
  bool clamped_begin = false, clamped_end = false;  ///< leave and meet the contour with three derivatives
};

struct SmoothedRun {
  bool done = false;
  std::vector<Rational> pieces;  ///< Bézier curves of degree 5, joined with four continuous derivatives
  std::vector<double> breaks;    ///< along the stretch, pieces + 1
  std::vector<double> troubles;  ///< if not done: where along the stretch it failed
};

/// |f(t) − contour(t)| ≤ tolerance for all t (checked between the sites as well), so both are within the tolerance of
/// each other. `borders`: places, ascending, at which a break should lie (changes of the block). Not done when the
/// curve would turn round in a point or cannot be kept inside.
SmoothedRun smooth_run(const Stretch& stretch, const RunRange& range, const std::vector<double>& borders,
                       double tolerance, std::size_t dimension, const std::function<void()>& breathe);

}  // namespace bahnwerk::blending
