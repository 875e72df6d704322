#pragma once
/// Links with a short passing time: β and weights are chosen by the time, which a function of the caller computes.
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/winding/path/needle_path.hpp"

namespace bahnwerk::winding {

/// Returns the least time from rest to rest along these pieces, s; not finite where unknown.
using PieceTimer = std::function<double(std::span<const BezierPiece>)>;

struct QuickLinks {
  NeedlePath path;
  std::size_t changed = 0;      ///< number of links that differ from those of `smooth`
  std::size_t evaluations = 0;  ///< calls of the timer
};

/// Returns `smooth` with faster links. Each link is timed together with the fixed pieces on both sides of it, from rest
/// to rest (and, of two that meet at an extra point, with the other one), so that leaving a slot fast is rewarded. A
/// search without gradients starts from the fastest of the links of `smooth` and `other` and of the turn before: by γ
/// (core/geometry/spline/search/link_variables.hpp), then by one weight for the inner control points of each half. In
/// the first turn that takes up to 50 calls of the timer per link; where the link at the other end of the part, or the
/// one in the other direction, is known, the search starts from it, too, and takes 35. Later turns search only where
/// the link of the turn before saves less than it did there. A link that has a cusp, is much rougher, turns or swings
/// farther than before is rejected. Each link is faster by itself; the whole path has to be compared by the caller.
/// `smooth` and `other` are paths of the same pieces with the same options. Throws what the timer throws.
QuickLinks quick_links(const std::vector<FixedPiece>& pieces, const NeedlePath& smooth, const NeedlePath& other,
                       const LinkOptions& options, const PieceTimer& time, Progress progress);

}  // namespace bahnwerk::winding
