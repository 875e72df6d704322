#pragma once
/// The head's time-optimal motion under the summed limits of coarse and fine axes, and its slower versions for sections
/// in which the coarse axes cannot follow.
#include <map>
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/head/slower_sections.hpp"
#include "core/redundant/joint_task.hpp"

namespace bahnwerk {

/// How far a smoother head stays below the summed limits, so that the coarse axes need less acceleration.
struct HeadReserve {
  double unused_share = 0;  ///< unused part (0 … 1) of the coarse accelerations and of the fine velocities
  double longer = 1;        ///< factor ≥ 1 of the duration of straight moves longer than two strokes
  double acceleration_share =
      1;  ///< used part of the remaining accelerations and of the largest speed that then results
};

/// Plans the head repeatedly while section limits fall. A section that is one straight line has a closed form
/// (straight_move.hpp); any other section is planned again when its feeds or accelerations fell. Every plan also costs
/// O(pieces) of the sections that are asked for.
template <std::size_t order>
class HeadPlan {
 public:
  /// Plans the head with `share` (0 … 1) of the summed limits and derives the section limits of straight sections.
  /// `corner_angle` is in rad. Throws as the planners of time laws do.
  HeadPlan(const JointTask& task, double corner_angle, double share, Progress progress,
           const HeadReserve& reserve = {});
  /// Returns a head with the given reserve that is nowhere quicker than the section limits of this plan.
  std::shared_ptr<const PathMotion> smoother_head(double share, const HeadReserve& reserve) const;

  const Machine& limits() const { return limits_; }
  SectionLimits& section_limits() { return section_limits_; }
  const SectionLimits& section_limits() const { return section_limits_; }
  /// Returns the task's feed of a segment, mm/s.
  double feed(std::size_t segment) const { return task_.feeds[segment]; }
  /// Returns the largest speed, mm/s, of the head planned with the task's feeds on the segments [first, last).
  double peak(std::size_t first, std::size_t last) const;
  /// Returns the number of segments with a limit below the task's feed.
  std::size_t slowed() const;
  std::shared_ptr<const PathMotion> motion() { return motion(0, task_.path->size()); }
  /// Returns the head on the sections that begin in the segments [first, last), starting at time 0; `last` is the begin
  /// of a section. Unless they are the last sections, one more piece behind them is included.
  std::shared_ptr<const PathMotion> motion(std::size_t first, std::size_t last);
  /// Returns the first segment of the section that holds a segment; section_end() returns the first segment of the next
  /// section.
  std::size_t section_begin(std::size_t segment) const;
  std::size_t section_end(std::size_t segment) const;
  /// Returns the head planned with the coarse axes' limits alone; with limited jerk the fine axes take jumps of
  /// curvature.
  std::shared_ptr<const PathMotion> coarse_alone() const;

 private:
  struct SlowerLaw {
    std::vector<double> feeds;  // feeds, mm/s, with which the law was planned
    double share = 1;           // used share of the accelerations
    TimeLaw law;
  };
  /// Returns the law of a section whose feeds or accelerations fell; null if none fell.
  const TimeLaw* slower_law(std::size_t first, std::size_t last);
  TimeLaw planned(const PathTask& path) const;
  TimeLaw planned(const Machine& limits, const std::vector<double>& feeds, const std::vector<bool>& rests) const;

  const JointTask& task_;
  double corner_angle_;
  Progress progress_;
  Machine limits_;
  SectionLimits section_limits_;
  TimeLaw base_;                             // law with the task's feeds
  std::map<std::size_t, SlowerLaw> slower_;  // by first segment
  std::vector<std::size_t> sections_;        // first segments, and the end of the path
};

extern template class HeadPlan<2>;
extern template class HeadPlan<3>;

}  // namespace bahnwerk
