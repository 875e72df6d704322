#pragma once
/// Adaptive split of consecutive sections [Bock 4.1, 4.3]: plan the head with the limits of each block, fit the coarse
/// axes to it, check the split, lower limits where it fails; repeat until the split is valid.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/head/head_cells.hpp"
#include "core/redundant/iterative/coarse_fit.hpp"
#include "core/redundant/iterative/head_sections.hpp"
#include "core/redundant/iterative/kept_knots.hpp"
#include "core/redundant/iterative/limit_adaptation.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Constants of the iterative method; its other options are in RedundancyOptions.
struct IterativeOptions {
  AdaptationOptions adaptation;
  std::size_t wide_gap = 6;  ///< K* of KnotChoice
  /// For least squares without a second phase and without limited jerk: gaps between knots are graded (KnotChoice), and
  /// after `iterations_with_new_knots` ≥ 1 iterations knots are kept and only added to.
  double grading = 1.5;
  int iterations_with_new_knots = 3;
  bool sampled_limits =
      false;                ///< programs of phase 2 keep limits at the samples (4.29), else of control points (4.30)
  int max_iterations = 40;  ///< most iterations per window
  double long_move = 10;    ///< straight segments longer than this many strokes are windows of their own (4.3.4)
  /// Largest relative slowing of head and coarse axes together that replaces further iterations, if it removes all
  /// excess of a motion that starts at rest.
  double most_slowing = 5e-4;
  /// Iteration from which on limits fall faster in each iteration, if jerk is not limited.
  int patience = 2;
};

/// The motion of the sections [first, last); its time begins with 0.
struct SplitPart {
  std::size_t first = 0, last = 0;
  TimeLaw law;
  std::vector<TimeSpline> coarse;  ///< per axis
};

/// Iterates head plan, coarse fit and limit adaptation.
class AdaptiveSplit {
 public:
  /// All references must outlive this object. Throws InvalidInput if thinning leaves nothing of the stroke, and what
  /// the head's planners throw.
  AdaptiveSplit(const RedundancyTask& task, const RedundancyOptions& options, const IterativeOptions& constants,
                Progress progress);

  /// Tells whether samples at every cycle leave enough of every stroke for the fit; without that solve() is not called.
  bool resolves_samples() const { return resolves_samples_; }
  const HeadSections& sections() const { return sections_; }
  double fastest() const { return fastest_; }  ///< s, duration of the head's first plan
  /// Returns the passes of all windows so far, including windows without a result; the last pass of a solved window is
  /// valid.
  const std::vector<RedundancyIteration>& passes() const { return passes_; }
  /// Returns the blocks whose limits are below those of the first iteration.
  std::vector<SlowedSegment> slowed() const;

  /// Returns a valid motion of the sections [first, last), which begins with the coarse states `begin` (one per axis)
  /// and ends at rest; the limits of its blocks start with the first ones. If it starts at rest, each pass yields the
  /// factor by which head and coarse axes can be slowed together until no limit is exceeded; the pass with the shortest
  /// such motion is returned, and passes end when the head alone takes as long. None if no pass within `max_iterations`
  /// is valid, or if the head gets slower than the coarse axes are alone.
  std::optional<SplitPart> solve(std::size_t first, std::size_t last, const std::vector<SplineBegin>& begin);

 private:
  std::size_t axes() const { return task_.machine.axes.size(); }
  Machine limits_of(std::size_t section) const;
  void reset(std::size_t first, std::size_t last);
  HeadSamples sample(const PathMotion& head) const;
  /// Returns the tolerance of the fit, mm, for samples `spacing` s apart and the head's largest speed, mm/s.
  double tolerance(std::size_t axis, double spacing, double speed) const;
  /// Returns how many iterations have kept their knots, including iteration `iteration`.
  int kept(int iteration) const {
    return may_keep_ ? std::max(0, iteration - constants_.iterations_with_new_knots) : 0;
  }
  /// Fits all axes into `coarse`; `ends`: whether the last section is included. Returns false if an axis has no fit.
  bool fit(const HeadSamples& head, const std::vector<SplineBegin>& begin, int iteration, bool ends,
           std::vector<TimeSpline>& coarse);
  /// Returns upper bounds of the peaks, [axis][block], of the sections [first, last), valid between samples as well.
  std::vector<std::vector<SplitPeaks>> exact_peaks(const TimeLaw& law, const std::vector<TimeSpline>& coarse,
                                                   std::size_t first, std::size_t last);
  HeadCells cells_of(const TimeLaw& law);
  void replan(std::size_t section);
  struct Assessment {
    RedundancyIteration pass;
    double slowing = 1;  ///< factor of the duration that makes the split valid; infinite if none does
  };
  Assessment assessed(double duration, const std::vector<std::vector<SplitPeaks>>& peaks) const;
  /// Lowers limits and plans the sections again whose limits fell. Returns false if no limit fell.
  bool adapt_all(const std::vector<std::vector<SplitPeaks>>& peaks, std::size_t first, std::size_t last, int iteration);

  const RedundancyTask& task_;
  const RedundancyOptions& options_;
  const IterativeOptions& constants_;
  ProgressScope scope_;
  int order_;        // the highest derivative that is limited
  bool may_keep_;    ///< whether knots may be kept: for least squares alone without limited jerk
  Machine machine_;  ///< limits of the head's first plan
  std::vector<double> first_feeds_;
  HeadLimits limits_;
  std::vector<char> touched_;  ///< per section: whether it was planned again with lower limits
  HeadSections sections_, alone_;
  double fastest_ = 0;
  bool resolves_samples_ = true;
  std::vector<RedundancyIteration> passes_;
  KeptKnots knots_;
};

}  // namespace bahnwerk
