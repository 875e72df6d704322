#pragma once
/// The sections of a path in the form that stroke_bound.hpp and stroke_chains.hpp need: their bounds, the distances of
/// their ends, and the head's reach around them.
#include <cstddef>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "core/verify/redundant/stroke_axis.hpp"

namespace bahnwerk {

struct StrokeBoundTask {
  const PathTask& head;                        ///< path, feeds and rests with the summed limits
  const std::vector<AxisLimits>&coarse, fine;  ///< limits per axis of the path; a fine axis' stroke is its `highest`
};

namespace verify {

class StrokeSections {
 public:
  /// The head's reach before and behind some sections.
  struct Surroundings {
    HeadReach before, behind;
    bool rests_before, rests_behind;  ///< whether the path begins, or ends, there
    bool known() const { return before.until > 0 && behind.until > 0; }
    ReachableStates begin(const StrokeAxis& axis) const { return axis.before(before, rests_before); }
    /// Returns the states at the end, in reversed time.
    ReachableStates end(const StrokeAxis& axis) const { return axis.before(behind, rests_behind); }
  };

  /// Both arguments must outlive this object; bounds may be raised meanwhile.
  StrokeSections(const StrokeBoundTask& task, const std::vector<SectionBound>& sections);

  std::size_t count() const { return sections_.size(); }
  std::size_t axes() const { return task_.head.path.axes(); }
  /// Tells whether an axis has a fine axis; without one the limits of the head are the only conditions.
  bool split(std::size_t k) const;
  /// Returns the sum of the bounds of the sections [first, last), s.
  double bound(std::size_t first, std::size_t last) const;
  /// Returns the distance of a section's ends along axis k, mm.
  double end_distance(std::size_t k, std::size_t section) const;
  double stroke(std::size_t k) const { return split(k) ? task_.fine[k].highest : 0; }
  const AxisLimits& coarse(std::size_t k) const { return task_.coarse[k]; }
  /// Tells whether a section is longer than the shortest stroke and its bound shorter than the coarse axes alone
  /// permit.
  bool far(std::size_t section) const;
  /// Tells whether the head dwells before a section, or behind the last one.
  bool waits(std::size_t before) const;
  /// Returns axis k with positions counted from the begin of section `origin`.
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
