#pragma once
/// Sections along which all axes do what they do along an earlier one, such as a hole at another place. One law serves
/// both.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/rough_shape.hpp"
#include "core/motion/grid/sections.hpp"
#include "core/motion/law/repeated_law.hpp"

namespace bahnwerk {

/// A law depends on q′, q″, q‴ over path length, feeds and joints of its section, not on the position of the axes.
/// Sections are equal when the numbers of their segments, feeds and caps of joints agree, and lengths, q′, q″ and q‴ at
/// 16 places of every segment agree to 1e-11 of the section's size, which is what rounding of coordinates leaves. This
/// is no proof; every law that is taken over is verified. Axes through kinematics seldom repeat where the tool does.
class SectionRepeats {
 public:
  /// The arguments have to outlive the object.
  SectionRepeats(const PathTask& task, const Sections& sections, ProgressScope& stage_progress);
  /// Returns the earlier section that section i repeats (which repeats none itself), or i. It has to be called for the
  /// sections in order. O(segments) of the section, below 2 µs per arc.
  std::size_t source(std::size_t i);

 private:
  bool same(std::size_t a, std::size_t b) const;
  bool same_segment(std::size_t a, std::size_t b, double ratio, double length) const;

  const PathTask& task_;
  const Sections& sections_;
  ProgressScope& progress_;
  double acceleration_ = 0;  ///< largest acceleration of all axes together, mm/s²
  RoughIndex index_;
};

/// Plans section by section as for_each_section() does, but each distinct section once. plan(first segment, one past
/// the last, its part of the progress) appends to `result` and returns its work; a section that repeats an earlier one
/// gets a copy of its law and counts with as many cells and as much work. Returns the sum of the work.
template <class Result, class Plan>
double for_each_section_once(const PathTask& task, const Sections& sections, Progress progress, Result& result,
                             Plan&& plan) {
  ProgressScope stage_progress(progress, "planning");
  SectionRepeats repeats(task, sections, stage_progress);
  struct Before {  // sums before a section, and at the end
    std::size_t pieces, cells;
    double work;
  };
  std::vector<Before> before;
  double work = 0;
  for_each_section(task.path.tool(), sections, progress, [&](std::size_t first, std::size_t last, Progress part) {
    stage_progress.done(part_before(task.path.tool(), first));
    const std::size_t i = before.size();
    before.push_back({result.law.pieces().size(), result.cells, work});
    const std::size_t source = last == first + 1 && task.path.linear(first) ? i : repeats.source(i);
    if (source == i) {
      work += plan(first, last, part);
    } else {
      const Before &a = before[source], &b = before[source + 1];
      repeat_law(result.law, task.path.tool(), {a.pieces, b.pieces, sections.begin[source], first, last - first},
                 stage_progress);
      result.cells += b.cells - a.cells;
      work += b.work - a.work;
    }
  });
  return work;
}

}  // namespace bahnwerk
