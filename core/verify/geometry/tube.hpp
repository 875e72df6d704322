#pragma once
/// A proven bound of the distance of a path from its contour, block by block, independent of how the path was made.
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"

namespace bahnwerk {

/// Returns two checks.
///
/// "blocks out of order" counts blocks of the path that are not the contour's. Both must have equal blocks: as many, in
/// equal modes, each with a length where the given one has one, end to end. Feeds of the path are ignored
/// (core/verify/law/verifier.hpp uses the contour's).
///
/// "deviation from contour" compares every block of the path with its block of the contour, beginning to beginning and
/// end to end, so a border that has moved by more than the tolerance fails. Between them both are traversed at once,
/// forwards only: another branch nearby does not count. `value`, mm, is an upper bound of the distance from any point
/// of the path to the contour at the place matched to it, and of any point of the contour to the path. It is at most
/// 1e-6 mm (or a thousandth of the tolerance) above the largest distance evaluated, or 0.99 tolerances or the tolerance
/// where the existence of another matching had to be proven. `at` is the place on the path, mm (not a time). `passed`:
/// value ≤ tolerance. Where the path leaves the tube a distance that proves it is reported, not always the largest one;
/// infinite if blocks are out of order.
///
/// A block whose distance is below 0.996 tolerances passes, whatever its shape. The bounds use the bulges of curves
/// from their chords (core/geometry/path/matched.hpp), the search for a matching the Fréchet distance of polygons
/// (core/verify/geometry/frechet.hpp). Cost: O(segments of both), some µs per segment; in coils smaller than the
/// tolerance up to 30 ns per pair of segments, and at most 64 pairs per segment (but at least 5e7), beyond which a
/// block fails. Throws Stopped.
std::vector<Check> tube_checks(const Contour& given, const Contour& path, double tolerance, Progress progress);

}  // namespace bahnwerk
