#pragma once
/// Divides a contour into sections from rest to rest, and limits the speed at small tangent jumps.
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/axes/path_task.hpp"

namespace bahnwerk {

/// The sections of a path.
struct Sections {
  /// Segment indices at which a section begins: 0 first, path.size() last. The motion does not stop inside a section.
  std::vector<std::size_t> begin;
  /// Largest v² at the joint where each segment begins; infinity at smooth joints, unused at the beginning of sections.
  std::vector<double> joint_cap;
};

/// A tangent jump of the tool above `corner_angle` (rad), a cusp or a rest ends a section. A smaller jump Δ of q′ is
/// passed so slowly that the velocity step |Δ_k| v of every axis stays within its acceleration · cycle_time.
/// O(segments); reports to `progress`.
Sections find_sections(const PathTask& task, double corner_angle, ProgressScope& progress);

/// Returns the part of the path's length that lies before a segment; 1 for the end.
inline double part_before(const Path& path, std::size_t segment) {
  return segment < path.size() ? path[segment].s0() / path.length() : 1;
}

/// Plans section by section: plan(first segment, one past the last, its part of the progress, by path length).
template <class Plan>
void for_each_section(const Path& path, const Sections& sections, Progress progress, Plan&& plan) {
  for (std::size_t i = 0; i + 1 < sections.begin.size(); ++i)
    plan(sections.begin[i], sections.begin[i + 1],
         progress.part(part_before(path, sections.begin[i]), part_before(path, sections.begin[i + 1])));
}

}  // namespace bahnwerk
