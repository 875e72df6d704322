#pragma once
/// A head's motion law section by section from rest to rest, each with limits of its own: lowering those of one section
/// plans that section again and no other.
///
/// With limited acceleration cells are so wide that the law has about four pieces per cycle, up to 8 times as wide as
/// usual: the axes are fitted to samples of it, and more cells would only take time. Durations change by 1e-5 or so
/// (AccelerationLimitedOptions::width).
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

class Progress;

class HeadSections {
 public:
  /// Plans all sections at once with the limits of `machine` and `feeds`. With jerks where `machine` limits them.
  /// `task` and `options` outlive it. `width` of cells, in usual ones; 0: it is found, by planning twice where it is
  /// not 1. Throws what the planners throw.
  HeadSections(const RedundancyTask& task, const RedundancyOptions& options, const Machine& machine,
               const std::vector<double>& feeds, Progress& progress, double from, double to, double width = 0);

  double width() const { return width_; }
  std::size_t size() const { return begin_.size() - 1; }
  /// The first segment of a section; of size(): one past the last.
  std::size_t begin(std::size_t section) const { return begin_[section]; }
  std::size_t section_of(std::size_t segment) const;

  /// Plans a section again, with these limits and feeds. O(cells of the section).
  void replan(std::size_t section, const Machine& machine, const std::vector<double>& feeds);
  /// The law of sections [first, last) from time 0 on, with the dwells that come before each, and those at the end of
  /// the path. O(pieces).
  TimeLaw law(std::size_t first, std::size_t last) const;
  /// How long that lasts, s. O(sections + dwells).
  double duration(std::size_t first, std::size_t last) const;

 private:
  TimeLaw plan(const PathTask& task, Progress& progress, double from, double to) const;
  void append_dwells(TimeLaw& law, std::size_t segment) const;

  const RedundancyTask& task_;
  const RedundancyOptions& options_;
  Progress& progress_;
  double at_;         // of the progress, while sections are planned again
  double width_ = 1;  ///< of the cells in which laws are planned, in usual ones
  std::vector<std::size_t> begin_;
  std::vector<TimeLaw> laws_;  ///< per section, places along the whole path
};

}  // namespace bahnwerk
