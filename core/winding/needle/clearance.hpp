#pragma once
/// How far the needle stays from what it must not touch, along a whole path: the least distance over all poses, not
/// only over samples [Herrmann 4.2.6, Fig. 4.16]. Lengths mm, angles rad.
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/winding/needle/obstacles.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

/// A move from one pose to another: tip and angles change evenly, on a line or, with `arc`, about the part's axis.
struct NeedleMove {
  NeedlePose from, to;
  bool arc = false;
  double sweep = 0;               ///< of an arc, rad
  NeedlePose at(double u) const;  ///< u in [0, 1]
};
/// The fixed pieces with straight moves between them: tip and angles change evenly there, too.
std::vector<NeedleMove> straight_links(const std::vector<FixedPiece>& pieces);

struct Clearance {
  double minimum = 0;        ///< mm; negative: so deep the needle reaches into an obstacle
  std::size_t move = 0;      ///< on which move or piece
  double at = 0;             ///< where on it, u or v in [0, 1]
  double along = 0;          ///< where on the needle, from the tip, mm
  std::size_t obstacle = 0;  ///< which obstacle
};

/// The least clearance over all moves, all points of the needle and all obstacles. What is reported is reached there,
/// and nowhere the clearance is less than that by more than `tolerance`: moves and needle are halved until the distance
/// in the middle of each piece, which changes by no more than points move, proves that. Asks `progress`. Without moves
/// or obstacles infinite. Throws InvalidInput naming needle.width or needle.length,
/// std::invalid_argument for a tolerance below 1e-6.
Clearance clearance(const std::vector<NeedleMove>& moves, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress& progress);

/// The same along the rational pieces of a path in x, y, z (mm), phi, psi (rad): how far the needle is from its pose in
/// the middle of a stretch follows from the stretch's own control points, in whose convex hull it lies.
Clearance clearance(std::span<const BezierPiece> pieces, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress& progress);

}  // namespace bahnwerk::winding
