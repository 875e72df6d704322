#pragma once
/// The sections of a path as bounds that know the stroke look at them (stroke_bound.hpp, stroke_chains.hpp).
#include <cstddef>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "core/verify/redundant/stroke_axis.hpp"

namespace bahnwerk {

struct StrokeBoundTask {
  const PathTask& head;                        ///< with the limits of both axes summed
  const std::vector<AxisLimits>&coarse, fine;  ///< per axis of the path; a fine axis' stroke is its `highest`
  double progress_from = 0, progress_to = 1;
};

namespace verify {

class StrokeSections {
 public:
  /// What lies around some of them: where the head may be before and behind.
  struct Surroundings {
    HeadReach before, behind;
    bool rests_before, rests_behind;  ///< the path begins, or ends, there
    bool known() const { return before.until > 0 && behind.until > 0; }
    ReachableStates begin(const StrokeAxis& axis) const { return axis.before(before, rests_before); }
    /// In time that runs backwards.
    ReachableStates end(const StrokeAxis& axis) const { return axis.before(behind, rests_behind); }
  };

  /// Both outlive it, and bounds may be raised meanwhile.
  StrokeSections(const StrokeBoundTask& task, const std::vector<SectionBound>& sections);

  std::size_t count() const { return sections_.size(); }
  std::size_t axes() const { return task_.head.path.axes(); }
  /// Whether an axis has a fine one; of others the limits of the head are all there is to say.
  bool split(std::size_t k) const;
  /// Sum of the bounds of sections [first, last), s.
  double bound(std::size_t first, std::size_t last) const;
  /// How far apart the ends of a section are along axis k, mm; its stroke; its coarse axis.
  double way(std::size_t k, std::size_t section) const;
  double stroke(std::size_t k) const { return split(k) ? task_.fine[k].highest : 0; }
  const AxisLimits& coarse(std::size_t k) const { return task_.coarse[k]; }
  /// Whether one is longer than the shortest stroke, and faster than the coarse axes alone may be.
  bool far(std::size_t section) const;
  /// Whether the head dwells before a section, or behind the last one.
  bool waits(std::size_t before) const;
  /// Places from where section `origin` begins.
  StrokeAxis axis(std::size_t k, std::size_t origin) const;
  Surroundings around(std::size_t first, std::size_t last) const;
  Passage passage(std::size_t first, std::size_t last) const;

 private:
  AxisJet rest(std::size_t before) const;

  const StrokeBoundTask& task_;
  const std::vector<SectionBound>& sections_;
  double step_, horizon_ = 0;
};

}  // namespace verify
}  // namespace bahnwerk
