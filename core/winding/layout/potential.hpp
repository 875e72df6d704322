#pragma once
/// The largest number of wires of one radius that a usable area holds, whether or not they can be wound: the reference
/// for real layouts. It is a potential-based search [Herrmann 4.2.3, Algorithm 4.3, (4.5)–(4.8)] with an elastic force
/// in place of the Coulomb force, exact minimisation, and basin hopping in place of plain restarts. As a heuristic it
/// proves that a number fits, never that one more does not. It is deterministic: usable area, radius, hints and options
/// determine every bit of the result; no clock is read. Lengths mm.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

struct PotentialOptions {
  /// Two wires may be nearer than two radii by this, mm; [Herrmann 4.2.3] allows ½ ε_D r_D. Wires never enter walls.
  double overlap = 0;
  std::uint64_t seed = 1;
  /// Factor of the work spent on a number of wires before it counts as too large.
  double effort = 1;
  /// Largest number of wires searched for.
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

/// Returns the largest layout found. Centres are at least 2·radius − overlap − 1e-9 apart and at least radius − 1e-9
/// from the boundary; an O(n²) check verifies every result. It has at least as many wires as the best of `hints` that
/// keeps these rules. Reports stage "potential". Throws std::invalid_argument unless radius > 0 and 0 ≤ overlap <
/// 2·radius.
std::vector<Point> potential(const Region& usable_area, double radius, std::span<const std::vector<Point>> hints,
                             const PotentialOptions& options, Progress progress);

/// Returns `count` wires, or nothing if none were found; `options.most` is ignored.
std::optional<std::vector<Point>> pack(const Region& usable_area, double radius, std::size_t count,
                                       std::span<const std::vector<Point>> hints, const PotentialOptions& options,
                                       Progress progress);

/// Tells whether `wires` satisfy the rules above.
bool packed(const Region& usable_area, double radius, double overlap, std::span<const Point> wires);

}  // namespace bahnwerk::winding
