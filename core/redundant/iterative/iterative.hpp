#pragma once
/// The iterative method [Bock chapter 4]: the head is planned with the fine axes' limits, the coarse axes are splines
/// fitted to its motion over time, and where the split exceeds a limit the head's limits fall, block by block, until
/// the split is valid. A block is a segment of the path; a section from rest to rest is planned with the least limits
/// of its blocks.
///
/// The contour is planned at once or in overlapping windows [Bock 4.3.4]. Windows begin where the head rests, so only
/// the coarse axes' state is carried over. If a window has no valid split, the window before is kept up to its end, at
/// rest, and the window begins there (the source's rescue stop). If that fails, too, half and then a quarter of the
/// fine accelerations are tried. A split keeps all limits, by bounds between samples (split_peaks.hpp).
///
/// The motion is not the fastest one, because the head never gets more than the fine axes' acceleration. Cost:
/// O(samples) per iteration; docs/methods/coarse_fine_iterative.md lists times.
#include "core/base/progress.hpp"
#include "core/redundant/iterative/adaptive_split.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Plans the task with the given constants. Returns NoPlan if no split is valid
/// before the head gets slower than the coarse axes are alone. Throws InvalidInput if degree and knots
/// do not make the coarse motion smooth enough, if thinning leaves nothing of the stroke, and where the head's planner
/// does; Stopped.
Expected<RedundancyResult, NoPlan> plan_iterative(const RedundancyTask& task, const RedundancyOptions& options,
                                                  const IterativeOptions& constants, Progress progress);
/// Plans with the constants of the source. Throws as above.
Expected<RedundancyResult, NoPlan> plan_iterative(const RedundancyTask& task, const RedundancyOptions& options,
                                                  Progress progress);

}  // namespace bahnwerk
