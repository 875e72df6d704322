#pragma once
/// How far a path strays from the contour that it stands for, block by block: a proven bound, by code that knows
/// nothing of how the path was made.
#include <vector>

#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"

namespace bahnwerk {

class Progress;

/// Two checks.
///
/// "blocks out of order": how many blocks of the path are not the contour's. Both must have the same blocks: as many,
/// in the same modes, each with a length where the given one has one, end to end. Feeds are not looked at: those of the
/// path count for nothing (core/verify/verifier.hpp takes the contour's).
///
/// "deviation from contour": every block of the path against the same block of the contour, begin to begin and end to
/// end, so a border that has moved by more than the tolerance shows. In between both are traversed at once, never back
/// on either: a branch that happens to be near does not count. `value`, mm, is an upper bound of the distance from
/// any point of the path to the contour at the place matched to it, and of any point of the contour to the path; it
/// is at most 1e-6 mm (or a thousandth of the tolerance) above the largest distance evaluated, or 0.99 tolerances or
/// the tolerance where another matching had to be proven to exist. `at` is where on the path, mm (not a time).
/// `passed`: value ≤ tolerance. Where the path leaves the tube a distance that shows it is reported, not always the
/// largest one; infinite if blocks are out of order.
///
/// A block whose distance is below 0.996 tolerances passes, whatever its shape; the bounds rest on what curves bulge
/// from their chords (core/geometry/path/matched.hpp), the search for a matching on the Fréchet distance of polygons
/// (core/verify/geometry/frechet.hpp). Cost: O(segments of both), some µs per segment; in coils smaller than the
/// tolerance up to 30 ns per pair of segments, and at most 64 pairs per segment (but at least 5e7), beyond which a
/// block fails. Progress runs from `from` to `to`; throws Stopped.
std::vector<Check> tube_checks(const Contour& given, const Contour& path, double tolerance, Progress& progress,
                               double from = 0, double to = 1);

}  // namespace bahnwerk
