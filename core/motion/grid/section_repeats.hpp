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

/// Plans section by section as for_each_section() does, but no section twice: plan(first segment, one past the last,
/// begin and end of its share of the progress) appends to `result` and returns how much work that was; what repeats an
/// earlier section is left to repeat, with what repeat_law() (core/motion/law/repeated_law.hpp) takes, and counts as
/// many cells and as much work. Returns the work of all.
template <class Result, class Plan, class Repeat>
double for_each_section_once(const PathTask& task, const Sections& sections, Progress& progress, double from, double to,
                             Result& result, Plan&& plan, Repeat&& repeat) {
  ProgressScope scope(progress, "planning", from, to);
  SectionRepeats repeats(task, sections, scope);
  struct Before {  // each section, and at the end
    std::size_t pieces, cells;
    double work;
  };
  std::vector<Before> before;
  double work = 0;
  for_each_section(task.path.tool(), sections, from, to,
                   [&](std::size_t first, std::size_t last, double begin, double end) {
                     scope.done(to > from ? (begin - from) / (to - from) : 1);
                     const std::size_t i = before.size();
                     before.push_back({result.law.pieces().size(), result.cells, work});
                     const std::size_t source = last == first + 1 && task.path.linear(first) ? i : repeats.source(i);
                     if (source == i) {
                       work += plan(first, last, begin, end);
                     } else {
                       const Before &a = before[source], &b = before[source + 1];
                       repeat(a.pieces, b.pieces, task.path.tool(), sections.begin[source], first, last - first, scope);
                       result.cells += b.cells - a.cells;
                       work += b.work - a.work;
                     }
                   });
  return work;
}

}  // namespace bahnwerk
