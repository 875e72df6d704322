#pragma once
/// Links that the needle passes in little time: β and weights by the time itself, as whoever plans motions tells it.
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/winding/path/needle_path.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

/// Least time from rest to rest along these pieces, s; not finite where it is not known.
using PieceTimer = std::function<double(std::span<const BezierPiece>)>;

struct QuickLinks {
  NeedlePath path;
  std::size_t changed = 0;      ///< links that are no longer those of `smooth`
  std::size_t evaluations = 0;  ///< calls of the timer
};

/// `smooth` with quicker links. Each link is timed together with the fixed pieces at both sides of it, from rest to
/// rest (and, of two that meet at an extra point, with the other one), so that it pays to leave a slot fast. Of the
/// links of `smooth` and `other` and that of the turn before the quickest is where a search without gradients starts:
/// by γ (core/geometry/spline/search/link_variables.hpp), then by one weight for the inner control points of each half.
/// In the first turn that takes up to 50 calls of the timer per link; where the link at the other end of the part, or
/// the one on the way back, is known, it starts from there, too, and takes 35. Later turns search only where the link
/// of the turn before saves less than it did there. A link that has a cusp, is much rougher, turns or swings farther
/// than before is not looked at. The links are quicker each by itself; whether the whole path is has to be compared.
/// `smooth` and `other`: paths of the same pieces with the same options. Throws what the timer throws.
QuickLinks quick_links(const std::vector<FixedPiece>& pieces, const NeedlePath& smooth, const NeedlePath& other,
                       const LinkOptions& options, const PieceTimer& time, Progress& progress);

}  // namespace bahnwerk::winding
