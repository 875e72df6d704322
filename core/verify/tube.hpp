#pragma once
/// How far a path strays from the contour that it stands for: a proven bound, by code that knows nothing of how the
/// path was made.
#include "core/contour/contour.hpp"
#include "core/plan.hpp"
#include "core/progress.hpp"

namespace bahnwerk {

/// Walks along both at once, never back on either (so a branch that happens to be near does not count), and matches
/// them piece by piece; where that matching is too coarse (spikes smaller than the tolerance), either side is compared
/// with what lies at most some tolerances further along the other. `value`, mm, is an upper bound of the distance from
/// any point of the path to the contour around the place matched to it, and of any point of the contour to the path;
/// it is at most 1e-6 mm (or a thousandth of the tolerance) above the largest distance evaluated, or 0.99 tolerances
/// where the matching was too coarse. `at` is where on the
/// path, mm (not a time). `passed`: value ≤ tolerance. Where the path leaves the tube a distance that shows it is
/// reported, not always the largest one. Name "deviation from contour".
///
/// Between two matched pairs of points the distance is at most that of the farther pair plus what both curves bulge
/// from their chords, max|h_uu| Δu²/8 each; cells are halved until that suffices. Cost: O(segments of both), some µs
/// per segment. Progress runs from `from` to `to`; throws Stopped.
Check tube_check(const Contour& given, const Contour& path, double tolerance, Progress& progress, double from = 0,
                 double to = 1);

}  // namespace bahnwerk
