#pragma once
/// The source's own method [Bock chapter 4]: the head is planned with the fine axes' limits, the coarse axes are
/// splines fitted to its motion over time, and where the split exceeds a limit the head's limits fall, block by block,
/// until it does not. A block is a segment of the path; a section from rest to rest is planned with the least limits of
/// its blocks.
///
/// The whole contour at once, or in windows that overlap [Bock 4.3.4]: then windows begin where the head rests, so only
/// the coarse axes' motion is carried over. Where a window finds no valid split the one before is kept to its end, at
/// rest, and the window begins there (the source's rescue stop). Should that fail, too, the joint planner plans the
/// contour, and where it finds nothing the coarse axes move alone: every contour ends in a split that holds all limits,
/// by bounds between samples (split_peaks.hpp); `fallbacks` counts.
///
/// Not the fastest motion: the head never gets more than the fine axes' acceleration. Cost: O(samples) per iteration;
/// docs/methods/coarse_fine_iterative.md has times.
#include "core/redundant/iterative/adaptive_split.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

class Progress;

/// Plans the task with those constants. Throws InvalidInput for degrees and knots that do not make the coarse motion as
/// smooth as it has to be, for thinning that leaves nothing of the stroke, and as the head's planner does; Stopped.
RedundancyResult plan_iterative(const RedundancyTask& task, const RedundancyOptions& options,
                                const IterativeOptions& constants, Progress& progress, double from = 0, double to = 1);
/// Plans with the constants of the source.
RedundancyResult plan_iterative(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                double from, double to);

}  // namespace bahnwerk
