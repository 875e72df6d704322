#pragma once
/// The needle's whole path: the fixed pieces of support_points() and free links between them, as rational pieces in
/// five coordinates (x, y, z in mm, φ, ψ in rad) that join with G^k [Herrmann 4.3]. Lengths mm, angles rad.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/spline/nurbs_path.hpp"
#include "core/geometry/spline/search/best_link.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {

struct LinkOptions {
  std::size_t continuity = 3;  ///< k of G^k, 1 … 4
  LinkObjective objective = LinkObjective::curvature;
  SmoothnessWeights weights;
  /// A stator's needle leaves the slot radially: between slot and winding head it passes an extra point above the slot,
  /// so far out towards the head's radius (λ of [Herrmann 4.3.4]), where it has finished its swivel. 0: no such point.
  /// There are two links then, which meet there on a radius, without curvature and without turning. (The source has one
  /// link with a double knot, which goes on turning behind the point: ψ overshoots by up to 90°.)
  double extra_point = 0.5;
};

/// One rational piece of the path.
struct NeedlePiece {
  BezierPiece curve;
  std::size_t fixed = 0;  ///< index of the fixed piece that this is part of, or that its link starts from
  bool link = false;
  /// 1 of a link that the natural feed passes evenly, else 0: of two links that meet at an extra point it is the one at
  /// the slot, since their parameters' speeds do not agree there.
  double share = 0;
};

/// From fixed piece `from` to the one after it; two that follow each other where an extra point lies between.
struct NeedleLink {
  std::size_t from = 0;
  BestLink best;         ///< the β found, and the smoothness J of (4.60)
  double curvature = 0;  ///< ∫ |κ| ds, the angle that the tangent turns, rad
};

struct NeedlePath {
  std::vector<NeedlePiece> pieces;
  std::vector<NeedleLink> links;  ///< in order
  /// All pieces as one NURBS, piece n over [n, n + 1].
  NurbsPath united() const;
};

/// `stator`: whether links between slot and winding head have an extra point. Each link starts its search from the
/// shape of the link at the same place of the turn before. Throws Infeasible where two fixed pieces leave no room for a
/// link, InvalidInput naming path.continuity or path.extra_point. About 1 ms per link.
NeedlePath needle_path(const std::vector<FixedPiece>& pieces, bool stator, const LinkOptions& options,
                       Progress& progress);

}  // namespace bahnwerk::winding
