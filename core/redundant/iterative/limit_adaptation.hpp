#pragma once
/// How the head's limits fall where a split exceeds those of the coarse or the fine axes [Bock 4.3.2].
#include <array>
#include <cstddef>
#include <vector>

#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/iterative/split_peaks.hpp"

namespace bahnwerk {

struct AdaptationOptions {
  /// λ_k: by how much of what the coarse axis exceeds its limit, here and on the neighbours 1, 2 … k* blocks away.
  std::array<double, 3> spread{1.0, 0.7, 0.4};
  double fine_factor = 1.15;  ///< K_xf: by how much of what the fine axis exceeds its limit
  double feed_factor = 1.1;   ///< of (4.42)
  int anchor_steps = 20;      ///< of (4.40): the least limit is that of the coarse axis over this
  /// What falls, falls by this at least, relative: ours, for excess that vanishes slowly.
  double least_change = 2e-3;
  /// With `proportional`: acceleration and jerk limits fall at least by the share by which the coarse axis has to.
  /// Ours.
  bool proportional = false;
  /// Excess that counts as none, relative: rounding.
  double rounding = 1e-9;
};

/// Ours, for passes in which excess only vanishes by what falls: in proportion, and in each by half as much again as in
/// the one before, at least. `passes` ≥ 1 such passes so far.
AdaptationOptions with_larger_steps(AdaptationOptions options, int passes);

/// The head's limits per block (segment of the path), of each axis.
struct HeadLimits {
  std::vector<std::vector<double>> acceleration, jerk;  ///< [axis][block]
  std::vector<double> feeds;                            ///< (per block) mm/s
};

/// Algorithm 4.1 for one axis and one kind of limit, for blocks [first, first + coarse.size()): `limits` of all blocks
/// fall where `coarse` or `fine`, the peaks of those blocks, exceed `coarse_limit` or `fine_limit` in iteration
/// `iteration` ≥ 1. Nothing rises, nothing falls below the anchor (4.40), of the fine axis' branch neither (the source
/// has none there), nor by what the coarse axis does beyond that. Returns whether anything fell.
bool adapt(std::vector<double>& limits, std::size_t first, const std::vector<double>& coarse, double coarse_limit,
           const std::vector<double>& fine, double fine_limit, int iteration, const AdaptationOptions& options);

/// (4.41), (4.42): the feed of one block. `peaks` are those of its axes.
bool adapt_feed(double& feed, double first_feed, const std::vector<SplitPeaks>& peaks, const CoarseFineMachine& machine,
                const AdaptationOptions& options);

/// The feed of the first iteration: what the document says, and not more than the coarse axes reach by themselves along
/// that segment, end of [Bock 4.3.2]. By q′ at a few places of a curved one.
double first_feed(const AxisPath& path, std::size_t segment, double feed, const CoarseFineMachine& machine);

}  // namespace bahnwerk
