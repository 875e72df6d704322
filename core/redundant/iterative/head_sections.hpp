#pragma once
/// The head's time law, section by section from rest to rest, each section with its own limits, so that only a section
/// whose limits fall is planned again.
///
/// With limited acceleration the cells of the planner's grid are up to 8 times as wide as usual, so that the law has
/// about four pieces per cycle: the coarse axes are fitted to samples of it, and a finer law would not change the fit.
/// Durations change by about 1e-5 (AccelerationLimitedOptions::width).
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

class HeadSections {
 public:
  /// Plans all sections with the limits of `machine` and `feeds`, mm/s; with limited jerk if `machine` limits it.
  /// `task` and `options` must outlive this object. `width` is that of cells in units of the usual one; 0: it is
  /// determined, with a second plan unless it is 1. Throws what the planners throw.
  HeadSections(const RedundancyTask& task, const RedundancyOptions& options, const Machine& machine,
               const std::vector<double>& feeds, Progress progress, double width = 0);

  double width() const { return width_; }
  std::size_t size() const { return begin_.size() - 1; }
  /// Returns the first segment of a section; begin(size()) is the number of segments.
  std::size_t begin(std::size_t section) const { return begin_[section]; }
  std::size_t section_of(std::size_t segment) const;

  /// Plans a section again with the given limits and feeds. O(cells of the section).
  void replan(std::size_t section, const Machine& machine, const std::vector<double>& feeds);
  /// Returns the law of the sections [first, last) from time 0 on, including the dwells before each section and those
  /// at the end of the path. O(pieces).
  TimeLaw law(std::size_t first, std::size_t last) const;
  /// Returns the duration of law(first, last), s. O(sections + dwells).
  double duration(std::size_t first, std::size_t last) const;

 private:
  TimeLaw plan(const PathTask& task, Progress progress) const;
  void append_dwells(TimeLaw& law, std::size_t segment) const;

  const RedundancyTask& task_;
  const RedundancyOptions& options_;
  Progress progress_;
  double width_ = 1;  ///< width of the cells, in units of the usual one
  std::vector<std::size_t> begin_;
  std::vector<TimeLaw> laws_;  ///< per section, with path lengths of the whole path
};

}  // namespace bahnwerk
