#pragma once
/// Adaptation of the head's limits where a split exceeds limits of the coarse or the fine axes [Bock 4.3.2].
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/iterative/split_peaks.hpp"

namespace bahnwerk {

struct AdaptationOptions {
  /// λ_k: share of the coarse axis' excess by which limits fall in the block itself and in blocks 1, 2 … k* away.
  std::array<double, 3> spread{1.0, 0.7, 0.4};
  double fine_factor = 1.15;  ///< K_xf: factor of the fine axis' excess by which limits fall
  double feed_factor = 1.1;   ///< factor of (4.42)
  int anchor_steps = 20;      ///< divisor in (4.40): the least limit is the coarse axis' limit divided by this
  /// Least relative decrease of a limit that falls (not in the source), against excess that vanishes slowly.
  double least_change = 2e-3;
  /// Whether acceleration and jerk limits fall at least in proportion to the coarse axis' excess (not in the source).
  bool proportional = false;
  /// Relative excess that counts as rounding.
  double rounding = 1e-9;
};

/// Returns options whose limits fall proportionally, and by half as much again per pass, for the pass number `passes` ≥
/// 1 in which only falling limits can remove the excess. Not in the source.
AdaptationOptions with_larger_steps(AdaptationOptions options, int passes);

/// The head's limits per block (segment of the path): accelerations mm/s² and jerks mm/s³ per axis, feeds mm/s.
struct HeadLimits {
  std::vector<std::vector<double>> acceleration, jerk;  ///< [axis][block]
  std::vector<double> feeds;                            ///< [block]
};

/// Peaks of an axis per block, and the axis' limit, both in the limit's unit. The peaks have to outlive the object.
struct LimitedPeaks {
  const std::vector<double>& peaks;
  double limit;
};

/// Algorithm 4.1 for one axis and one kind of limit in as many blocks from `first` on as there are peaks: `limits`, of
/// all blocks, fall where the coarse or the fine axis exceeds its limit in iteration `iteration` ≥ 1. No limit rises.
/// Excess of the coarse axis lowers limits at most to the iteration's anchor (4.40), excess of the fine axis at most to
/// coarse.limit/anchor_steps, where the source has no bound. Returns whether a limit fell.
bool adapt(std::vector<double>& limits, std::size_t first, const LimitedPeaks& coarse, const LimitedPeaks& fine,
           int iteration, const AdaptationOptions& options);

/// Lowers the feed of one block by (4.41), (4.42); `peaks` has one entry per axis. Returns whether it fell.
bool adapt_feed(double& feed, double first_feed, const std::vector<SplitPeaks>& peaks, const CoarseFineMachine& machine,
                const AdaptationOptions& options);

/// Returns the feed of a segment in the first iteration, mm/s: the document's feed, at most the speed that the coarse
/// axes alone reach along the segment (end of [Bock 4.3.2]), by q′ at a few places of a curved segment.
double first_feed(const AxisPath& path, std::size_t segment, double feed, const CoarseFineMachine& machine);

}  // namespace bahnwerk
