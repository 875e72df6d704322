#pragma once
/// Head and split of a run of sections, planned in turn until the split is valid [Bock 4.1, 4.3]: the head with the
/// limits of each block, the coarse axes fitted to it, the check, and lower limits where it failed.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/head_cells.hpp"
#include "core/redundant/iterative/coarse_fit.hpp"
#include "core/redundant/iterative/head_sections.hpp"
#include "core/redundant/iterative/kept_knots.hpp"
#include "core/redundant/iterative/limit_adaptation.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Constants of the method; `redundancy` of a document has the others.
struct IterativeOptions {
  AdaptationOptions adaptation;
  std::size_t wide_gap = 6;  ///< K* of inserting knots
  /// Least squares without a second phase, jerk not limited: gaps between knots are graded (KnotChoice), and after so
  /// many iterations (≥ 1) knots are kept and only added to.
  double grading = 1.5;
  int iterations_with_new_knots = 3;
  bool sampled_limits = false;  ///< programs of phase 2 hold limits at the samples (4.29), not of control points (4.30)
  int max_iterations = 40;      ///< of one window
  double long_move = 10;        ///< straight segments longer than so many strokes are windows of their own (4.3.4)
  /// Head and coarse axes that start at rest are slowed together by as much, in place of further iterations, where that
  /// makes all of what they exceed vanish.
  double most_slowing = 5e-4;
  /// From this iteration on limits fall faster in each, where jerk is not limited.
  int patience = 2;
  /// A motion that takes so much more than the head's first plan is planned backwards in time, too.
  double backward_from = 9e-4;
};

/// The motion of sections [first, last); its time begins with 0.
struct SplitPart {
  std::size_t first = 0, last = 0;
  TimeLaw law;
  std::vector<TimeSpline> coarse;  ///< per axis
};

class AdaptiveSplit {
 public:
  /// All are kept by reference. Throws InvalidInput where thinning leaves nothing of the stroke, Infeasible where
  /// samples of the cycle do, and what planners of the head throw.
  AdaptiveSplit(const RedundancyTask& task, const RedundancyOptions& options, const IterativeOptions& constants,
                Progress& progress, double from, double to);

  const HeadSections& sections() const { return sections_; }
  double fastest() const { return fastest_; }  ///< s, the head's first plan
  /// Returns the head as the coarse axes move it alone, within their own limits.
  const HeadSections& alone() const { return alone_; }
  /// Returns the passes of all windows so far, those that were given up included; the last one of a solved window is
  /// valid.
  const std::vector<RedundancyIteration>& passes() const { return passes_; }
  /// Returns the blocks whose limits are below those of the first iteration.
  std::vector<SlowedSegment> slowed() const;

  /// Valid motions of these sections, from what the coarse axes do at their begin to rest, with the first limits of
  /// their blocks at first. From rest each pass has a factor by which all together can be slowed until no limit is
  /// exceeded; the pass with the shortest such motion counts, and passes end where the head alone takes as long. None
  /// where there is no such pass within `max_iterations`, or the head gets slower than the coarse axes are alone.
  ///
  /// `backward`: the coarse axes are fitted from the end to the begin, where they begin at rest at the head's place.
  std::optional<SplitPart> solve(std::size_t first, std::size_t last, const std::vector<SplineBegin>& begin,
                                 bool backward = false);

 private:
  std::size_t axes() const { return task_.machine.axes.size(); }
  Machine limits_of(std::size_t section) const;
  void reset(std::size_t first, std::size_t last);
  HeadSamples sample(const PathMotion& head) const;
  /// Returns what fine axes may make up for, mm, where samples are that far apart.
  double tolerance(std::size_t axis, double spacing, double speed) const;
  /// How many iterations have kept their knots, iteration `iteration` included.
  int kept(int iteration) const {
    return may_keep_ ? std::max(0, iteration - constants_.iterations_with_new_knots) : 0;
  }
  /// `ends`: whether the head is at the end of the path at last.
  bool fit(const HeadSamples& head, const std::vector<SplineBegin>& begin, int iteration, bool backward, bool ends,
           std::vector<TimeSpline>& coarse);
  /// Returns bounds of the peaks between samples, [axis][block], of sections [first, last).
  std::vector<std::vector<SplitPeaks>> exact_peaks(const TimeLaw& law, const std::vector<TimeSpline>& coarse,
                                                   std::size_t first, std::size_t last);
  HeadCells cells_of(const TimeLaw& law);
  void replan(std::size_t section);
  struct Assessment {
    RedundancyIteration pass;
    double slowing = 1;  ///< factor of the duration that makes all valid; infinite where none does
  };
  Assessment assessed(double duration, const std::vector<std::vector<SplitPeaks>>& peaks) const;
  /// Lowers limits, and plans sections again whose limits fell. False: nothing fell.
  bool adapt_all(const std::vector<std::vector<SplitPeaks>>& peaks, std::size_t first, std::size_t last, int iteration);

  const RedundancyTask& task_;
  const RedundancyOptions& options_;
  const IterativeOptions& constants_;
  ProgressScope scope_;
  bool jerk_;
  bool may_keep_;    ///< knots: where the fit is least squares alone, and jerk is not limited (there it does not help)
  Machine machine_;  ///< of the head's first plan
  std::vector<double> first_feeds_;
  HeadLimits limits_;
  std::vector<char> touched_;  ///< per section: not planned with the first limits any more
  HeadSections sections_, alone_;
  double fastest_ = 0;
  std::vector<RedundancyIteration> passes_;
  KeptKnots knots_;
};

}  // namespace bahnwerk
