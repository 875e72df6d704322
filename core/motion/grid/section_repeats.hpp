#pragma once
/// Sections along which all axes do what they do along an earlier one: the same hole at another place. One law serves
/// both.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/rough_shape.hpp"
#include "core/motion/grid/sections.hpp"

namespace bahnwerk {

/// Laws know of a section its q′, q″, q‴ over path length, feeds and joints; where the axes are does not matter.
/// Sections count as the same when the numbers of their segments, feeds and caps of joints agree, and lengths, q′, q″
/// and q‴ at 16 places of every segment do to 1e-11 of the section's own: what rounding of coordinates leaves. That is
/// no proof; whoever takes over a law has it verified like any other. Axes through kinematics seldom repeat where the
/// tool does.
class SectionRepeats {
 public:
  /// All outlive it.
  SectionRepeats(const PathTask& task, const Sections& sections, ProgressScope& scope);
  /// Of the sections in order: the earlier one that section i repeats, which repeats none itself, or i. O(segments) of
  /// the section, below 2 µs per arc.
  std::size_t source(std::size_t i);

 private:
  bool same(std::size_t a, std::size_t b) const;
  bool same_segment(std::size_t a, std::size_t b, double ratio, double length) const;

  const PathTask& task_;
  const Sections& sections_;
  ProgressScope& scope_;
  double acceleration_ = 0;  ///< of all axes together, mm/s²
  RoughIndex index_;
};

}  // namespace bahnwerk
