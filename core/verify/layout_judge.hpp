#pragma once
/// The independent judge of wires in a slot: it shares the slot's outline with the planners and nothing else.
#include <cstddef>
#include <span>
#include <string>

#include "core/plan.hpp"
#include "core/progress.hpp"
#include "core/winding/region.hpp"

namespace bahnwerk {

struct JudgedLayout {
  std::string algorithm;
  double copper = 0;   ///< mm, names the wire
  double radius = 0;   ///< of a wire with its enamel, mm
  double overlap = 0;  ///< by which two wires may be nearer than 2 · radius, mm
  std::span<const winding::Point> wires;
  std::size_t bound = 0;  ///< wires that no layout exceeds
};

/// Every pair of wires and every wire against every edge of the room, by formulas and an inside test of its own.
/// Checks, per algorithm the worst over its layouts, with the wire's copper diameter (mm) as `at`: `overlap beyond what
/// is allowed <algorithm>` and `overlap with the boundary <algorithm>` (mm, a wire outside counts with its whole
/// distance), both against 1e-9; `count beyond the bound <algorithm>`.
/// Cost: O(n² + n · edges) per layout of n wires, about 2 ns per pair.
Verification judge_layouts(const winding::Region& room, std::span<const JudgedLayout> layouts, Progress& progress,
                           double progress_from, double progress_to);

}  // namespace bahnwerk
