#pragma once
/// The most wires of one radius that a usable area holds, whether or not anyone could wind them: the upper bound that
/// real layouts are measured by. Potential-based search [Herrmann 4.2.3, Algorithm 4.3, (4.5)–(4.8)] with an elastic
/// force in place of the Coulomb force, exact minimisation, and basin hopping in place of plain restarts. A heuristic:
/// it proves that a number fits, never that one more does not. Deterministic: usable area, radius, hints and options
/// decide every bit of the result, no clock is read. Lengths mm.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

struct PotentialOptions {
  /// Two wires may be this much nearer than two radii, mm; [Herrmann 4.2.3] allows ½ ε_D r_D. Walls are never entered.
  double overlap = 0;
  std::uint64_t seed = 1;
  /// Scales the work spent on a number of wires before it counts as too many.
  double effort = 1;
  /// Search no further than this number.
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

/// The most wires found. Centres are at least 2·radius − overlap − 1e-9 apart and at least radius − 1e-9 from the
/// boundary; an O(n²) check looks at every result. Never fewer than the best of `hints` that keeps these rules.
/// Reports stage "potential". Throws std::invalid_argument unless radius > 0 and 0 ≤ overlap < 2·radius.
std::vector<Point> potential(const Region& usable_area, double radius, std::span<const std::vector<Point>> hints,
                             const PotentialOptions& options, Progress& progress);

/// `count` wires, or nothing if none were found; `options.most` means nothing here.
std::optional<std::vector<Point>> pack(const Region& usable_area, double radius, std::size_t count,
                                       std::span<const std::vector<Point>> hints, const PotentialOptions& options,
                                       Progress& progress);

/// Whether `wires` keep the rules above.
bool packed(const Region& usable_area, double radius, double overlap, std::span<const Point> wires);

}  // namespace bahnwerk::winding
