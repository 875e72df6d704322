#pragma once
/// The least distance of the needle from its obstacles along a whole path: over all poses, not only over samples
/// [Herrmann 4.2.6, Fig. 4.16]. Lengths mm, angles rad.
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/spline/bezier_piece.hpp"
#include "core/winding/needle/obstacles.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {

/// A move from one pose to another: tip and angles are linear, on a line or, with `arc`, about the part's axis.
struct NeedleMove {
  NeedlePose from, to;
  bool arc = false;
  double sweep = 0;               ///< angle of an arc, rad
  NeedlePose at(double u) const;  ///< returns the pose at u in [0, 1]
};

struct Clearance {
  double minimum = 0;        ///< mm; negative: depth to which the needle enters an obstacle
  std::size_t move = 0;      ///< index of the move or piece
  double at = 0;             ///< place on it, u or v in [0, 1]
  double along = 0;          ///< place on the needle, from the tip, mm
  std::size_t obstacle = 0;  ///< index of the obstacle
};

/// Returns the least clearance over all moves, all points of the needle and all obstacles. The reported value is
/// reached at the reported place, and the clearance is nowhere less by more than `tolerance`: moves and needle are
/// halved until the distance in the middle of each part, which changes by at most the displacement of points, proves
/// it. Asks `progress`. Infinite without moves or obstacles. Throws InvalidInput naming needle.width or needle.length,
/// std::invalid_argument for a tolerance below 1e-6.
Clearance clearance(const std::vector<NeedleMove>& moves, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress progress);

/// Returns the least clearance along the rational pieces of a path in x, y, z (mm), phi, psi (rad). The displacement of
/// the needle from its pose in the middle of an interval follows from the interval's control points, in whose convex
/// hull it lies.
Clearance clearance(std::span<const BezierPiece> pieces, const NeedleShape& needle,
                    const std::vector<const Obstacle*>& obstacles, double tolerance, Progress progress);

/// What a search has to tell apart, mm. Not to distinguish large clearances takes far less time than to find the least.
struct ClearanceResolution {
  double enough;     ///< clearances above it are not distinguished from it
  double tolerance;  ///< largest error of a clearance below it; 1e-6 at least
};

/// Returns the least clearance in each of 2^`halvings` intervals of a piece, which are equal in its parameter, as the
/// search above does; or `enough` where it is nowhere less. `move` is the index of the interval.
std::vector<Clearance> clearance_in_intervals(const BezierPiece& piece, int halvings, const NeedleShape& needle,
                                              const std::vector<const Obstacle*>& obstacles,
                                              const ClearanceResolution& resolution, Progress progress);

/// Returns the least clearance along the pieces, mm, or `enough` if it is nowhere less than that by more than
/// `tolerance`.
double clearance_up_to(std::span<const BezierPiece> pieces, const NeedleShape& needle,
                       const std::vector<const Obstacle*>& obstacles, const ClearanceResolution& resolution,
                       Progress progress);

}  // namespace bahnwerk::winding
