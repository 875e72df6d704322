#pragma once
/// Closed form of a single straight move from rest to rest with coarse and fine axes.
///
/// Along the line the coarse axes travel L − 2σ and the fine ones 2σ, from −σ to σ, where σ is limited by the strokes.
/// Both begin and end at rest, so the least duration is the larger one of T_c(L − 2σ) and T_f(2σ), the least times from
/// rest to rest of the two stages. The former falls with σ and the latter rises, so the best σ makes them equal or is
/// the largest admissible one. If all axes have the same limits no motion is shorter, with or without limited jerk, and
/// larger strokes or limits never make it longer.
///
/// If the feed is below the sum of both speeds, two more forms are compared and the quicker one is returned. In the
/// first both stages follow one profile of the whole length in proportion to their shares, and σ is the best of several
/// values. In the second the coarse axes accelerate to the feed and brake from it at their limits, and the fine axes
/// add a move of length q at both ends: the head reaches the feed earlier and leaves it later, by q/feed each. The two
/// additional moves sum up to 2 q; what exceeds two strokes the fine axes move back in between, while the head keeps
/// its feed. q is the largest value that strokes and limits of the fine axes allow (with limited jerk it is chosen
/// within a quarter of the coarse axes' change of speed).
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
  std::vector<SplineMotion::Piece> coarse;  ///< polynomials of every axis; the pieces are those of the head
};

/// Returns the quickest motion along a path of one straight segment, or none for any other path. The head is not faster
/// than `feed`, mm/s. An axis without stroke is moved by its coarse axis alone. O(1).
std::optional<LoneMove> lone_move(const AxisPath& path, const CoarseFineMachine& machine, double feed);

}  // namespace bahnwerk
