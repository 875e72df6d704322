#pragma once
/// A lower bound that knows the stroke, of sections together: what one long move takes away from the next.
///
/// The argument. Sections one after the other are parted at one of their rests. What either part takes more than the
/// sum of its bounds lies in some cell of a grid. Slow either part about that rest until it takes the most of its cell:
/// velocities and accelerations become no larger, at each time the head is where it was nearer to the rest, as it may
/// be (stroke_bound.hpp holds for a part as for one section, with what the head can do from rest to rest on the way),
/// and only the velocities at the rest, slowed by two factors, need not agree any more: they differ by no more than the
/// factors between the least and the most of the cells. So if all states in which the first part may end in the most of
/// its time, and all from which the second one may go on in the most of its own, widened by these factors, have none in
/// common, the two times are not in those cells. The least sum of the cells that are left bounds what both take more.
/// No section counts twice: of all chains those that do not overlap and gain most.
#include <vector>

#include "core/verify/redundant/stroke_sections.hpp"

namespace bahnwerk {

class Progress;

/// By how much a path takes longer than the sum of the bounds of its sections, s. `planned`: what they take in a plan,
/// without dwells. That only says where to look: where they take longer than their bounds, and in steps that could
/// close the gap. Cost: 1 ms per chain, 50 ms where it gains; of at most 5 sections, with a long one, without dwells.
double gain_of_chains(const StrokeBoundTask& task, const std::vector<SectionBound>& sections,
                      const std::vector<double>& planned, Progress& progress);

}  // namespace bahnwerk
