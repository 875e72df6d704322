#pragma once
/// Estimate of a random winding: every wire drops to the lowest place [Herrmann 4.2.2, Algorithm 4.2; Raabe].
#include "core/base/progress.hpp"
#include "core/geometry/region/region.hpp"
#include "core/winding/layout/layout.hpp"

namespace bahnwerk::winding {

/// Wires take the lowest free place one after another, of equally low ones the leftmost, until none is left; distances
/// to all wires laid before count (4.4), the safety distance is 0. This is repeated `shifts` times, with the first wire
/// starting 0, 1/shifts, 2/shifts, … of the radius to the right of the lowest place of the empty usable area (the
/// leftmost of several) and dropping to the lowest place there; starts to the right of all places are skipped. Then the
/// same is done from the other side, in the mirror image, so that a slot and its mirror image take equally many wires.
/// Returns the layout with the most wires, of several the first one. O(shifts · n · open corners) for n wires.
Layout raabe(const Region& usable_area, double radius, Progress progress, int shifts = 4);

}  // namespace bahnwerk::winding
