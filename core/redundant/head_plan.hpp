#pragma once
/// The head's quickest motion with both axes' limits summed, and how fast it may go where that is too fast for the
/// coarse axes.
#include <map>
#include <memory>
#include <vector>

#include "core/motion/law/path_motion.hpp"
#include "core/redundant/joint_task.hpp"
#include "core/redundant/slower_sections.hpp"

namespace bahnwerk {

class Progress;

/// Tells what a calmer head leaves unused.
struct Freedom {
  double calm = 0;  ///< part of the coarse axes' accelerations, and of the fine ones' velocities, that it does without
  double longer = 1;              ///< so many times as long moves of more than two strokes last
  double acceleration_share = 1;  ///< part that it uses of the accelerations left to it, and of its largest speed then
};

/// Plans the head again and again, with section_limits that fall. A straight section whose pace fell has a closed form;
/// of other sections those are planned again whose feeds or accelerations fell. Every plan costs O(pieces) of the
/// sections asked for besides.
template <std::size_t order>
class HeadPlan {
 public:
  /// `share` of the summed limits is used. Straight sections get their section_limits. Throws as the planners of laws
  /// do.
  HeadPlan(const JointTask& task, double corner_angle, double share, Progress& progress, const Freedom& freedom = {});
  /// A head that leaves the coarse axes more freedom than motion(), nowhere quicker than the section_limits of this
  /// plan.
  std::shared_ptr<const PathMotion> calmer(double share, const Freedom& freedom) const;

  const Machine& limits() const { return limits_; }
  SectionLimits& section_limits() { return section_limits_; }
  const SectionLimits& section_limits() const { return section_limits_; }
  /// Returns the task's feed of a segment, mm/s.
  double feed(std::size_t segment) const { return task_.feeds[segment]; }
  /// Returns the largest speed of the head, mm/s, on segments [first, last) with the task's feeds.
  double peak(std::size_t first, std::size_t last) const;
  /// Counts the segments that may not be passed as fast as the task lets them be.
  std::size_t slowed() const;
  std::shared_ptr<const PathMotion> motion() { return motion(0, task_.path->size()); }
  /// Plans the sections that begin in the segments [first, last), and one more piece behind them unless they are the
  /// last; `last` is the begin of a section. Time begins with 0.
  std::shared_ptr<const PathMotion> motion(std::size_t first, std::size_t last);
  /// Returns the begin of the section that a segment is in; section_end() that of the one behind it.
  std::size_t section_begin(std::size_t segment) const;
  std::size_t section_end(std::size_t segment) const;
  /// Plans every section with the limits of the coarse axes alone, which can follow that by themselves. With limited
  /// jerk they cannot where curvature jumps; `stops`: the head rests there, too.
  std::shared_ptr<const PathMotion> coarse_alone(bool stops = false) const;

 private:
  struct SlowerLaw {
    std::vector<double> feeds;  // that it is planned with
    double share = 1;           // of the accelerations
    TimeLaw law;
  };
  /// The law of a section whose feeds or accelerations fell.
  const TimeLaw* slower_law(std::size_t first, std::size_t last);
  TimeLaw planned(const PathTask& path) const;
  TimeLaw planned(const Machine& limits, const std::vector<double>& feeds, const std::vector<bool>& rests) const;

  const JointTask& task_;
  double corner_angle_;
  Progress& progress_;
  Machine limits_;
  SectionLimits section_limits_;
  TimeLaw base_;                             // with the task's feeds
  std::map<std::size_t, SlowerLaw> slower_;  // by first segment
  std::vector<std::size_t> sections_;        // first segments, and the end of the path
};

extern template class HeadPlan<2>;
extern template class HeadPlan<3>;

}  // namespace bahnwerk
