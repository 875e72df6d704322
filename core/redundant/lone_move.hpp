#pragma once
/// One straight move from rest to rest: the coarse axes' motion and the fine ones', each in closed form.
///
/// Along the line let the coarse axes travel L − 2σ and the fine ones 2σ, from −σ to σ, with σ at most what every
/// stroke allows. Both begin and end at rest, so the least time is the larger one of two times from rest to rest, T_c(L
/// − 2σ) and T_f(2σ). The first falls with σ and the second rises: the best σ is where they are equal, or the largest
/// one. Where all axes have the same limits nothing is quicker, with limited jerk or without, and more stroke, speed,
/// acceleration or jerk never takes longer.
/// Where a feed is less than both speeds reach together there are two forms, of which the quicker one counts. Both
/// follow one profile of the whole way, in proportion to their shares of it, and σ is the best of those looked at. Or
/// the coarse axes go up to the feed and down from it at their limits, and the fine ones push by q on top of that at
/// both ends: the head gets to the feed sooner, and leaves it later, by q/feed. Two pushes are 2 q; what is beyond two
/// strokes the fine axes go back in between, while the head keeps its feed. q is the largest one that strokes and the
/// fine axes' limits allow (with limited jerk a quarter of what the coarse axes need for the change of speed).
#include <memory>
#include <optional>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

struct LoneMove {
  TimeLaw head;
  std::vector<SplineMotion::Piece> coarse;  ///< every axis of the path; its pieces are those of the head
};

/// The quickest motion along a path of one straight segment; none where it has more, or is not straight. The head is
/// not faster than `feed`, mm/s. An axis without stroke travels with its coarse axis alone. O(1).
std::optional<LoneMove> lone_move(const AxisPath& path, const CoarseFineMachine& machine, double feed);

}  // namespace bahnwerk
