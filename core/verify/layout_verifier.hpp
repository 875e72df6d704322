#pragma once
/// The independent verifier of wires in a slot: it shares the slot's outline with the planners and nothing else.
#include <cstddef>
#include <span>
#include <string>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/geometry/region/region.hpp"

namespace bahnwerk {

/// A layout: wires of one size in a region of the slot.
struct LayoutToVerify {
  std::string algorithm;         ///< name of the algorithm that made the layout
  double copper = 0;             ///< diameter of the copper, mm, which identifies the wire
  double radius = 0;             ///< radius of a wire with its enamel, mm
  double overlap = 0;            ///< allowed overlap of two wires, mm
  std::span<const Point> wires;  ///< centres of the wires, mm
  std::size_t bound = 0;         ///< upper bound of the number of wires
  /// Name and usable area of the region, and number of wires in the first region, for a layout with several regions.
  std::string region = {};
  const Region* usable_area = nullptr;
  std::size_t count = 0;
};

/// Checks every pair of wires, and every wire against every edge of the usable area, by formulas and an inside test
/// that planners do not use. The checks, per algorithm and region the worst over its layouts, with the wire's copper
/// diameter (mm) as `at`, are: `overlap beyond what is allowed <algorithm>[, <region>]` and `overlap with the boundary
/// <algorithm>[, <region>]` (mm, a wire outside counts with its whole distance), both against core/winding/margin.hpp;
/// `wires missing <algorithm>, <region>` (the difference of its count to that of the first region); `bound`, the
/// largest excess of a count over its bound. Cost: O(n · edges) per layout of n wires, about 30 ns each, and the pairs
/// that overlap along x. Reports stage "verification" at least every 65536 comparisons.
Verification verify_layouts(const Region& usable_area, std::span<const LayoutToVerify> layouts, Progress progress);

}  // namespace bahnwerk
