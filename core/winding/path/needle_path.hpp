#pragma once
/// The needle's whole path: the fixed pieces of support_points() and free links between them, as rational pieces in
/// five coordinates (x, y, z in mm, φ, ψ in rad) that join with G^k [Herrmann 4.3]. Lengths mm, angles rad.
#include <cstddef>
#include <vector>

#include "core/base/expected.hpp"
#include "core/base/progress.hpp"
#include "core/geometry/spline/nurbs_path.hpp"
#include "core/winding/needle/support_points.hpp"
#include "core/winding/path/link_search.hpp"
#include "core/winding/path/post_passage.hpp"

namespace bahnwerk::winding {

/// A rational piece of the path.
struct NeedlePiece {
  BezierPiece curve;
  std::size_t fixed = 0;  ///< index of the fixed piece to which it belongs, or from which its link starts
  bool link = false;
  /// 1 for a link that the natural feed passes at constant parameter speed, else 0: of two links that meet at an extra
  /// point it is the one at the slot, since their parameter speeds differ there.
  double share = 0;
};

/// A link from fixed piece `from` to the next one; two consecutive links where an extra point lies between.
struct NeedleLink {
  std::size_t from = 0;
  std::size_t piece = 0;  ///< index in NeedlePath::pieces
  LinkEnds ends;          ///< the ends to which the β belong
  BestLink best;          ///< the β and the smoothness J of (4.60)
  double curvature = 0;   ///< ∫ |κ| ds, the angle by which the tangent turns, rad
};

/// Returns the coil that is wound on this piece; for the link down from a coil change the one to which it leads.
std::size_t coil_of(const NeedlePiece& piece, const std::vector<FixedPiece>& fixed);

struct NeedlePath {
  std::vector<NeedlePiece> pieces;
  std::vector<NeedleLink> links;  ///< links in their order
  std::vector<BezierPiece> curves() const;
  /// Returns all pieces as one NURBS, piece n over [n, n + 1].
  NurbsPath united() const;
};

/// Why there is no path.
struct NoPath {
  enum class Reason {
    no_length,  ///< the fixed piece has none
    no_room,    ///< there is no room for a link from the fixed piece to the next one
    cusp        ///< no such link without a cusp was found
  } reason;
  std::size_t fixed;  ///< index of the fixed piece
};

/// `stator` says whether links between slot and winding head have an extra point. `posts` are the obstacles of that
/// point in a stator; it is moved only where a post is in the way (core/winding/path/post_passage.hpp). Each link
/// starts its search from the shape of the link at this place of the turn before. Throws InvalidInput naming
/// path.continuity or path.extra_point. 1.5 ms per link of a
/// stator, 1 ms of a rotor; beside posts the first turn takes up to 0.3 s more.
Expected<NeedlePath, NoPath> needle_path(const std::vector<FixedPiece>& pieces, bool stator, const LinkOptions& options,
                                         Progress progress, const PostPassage* posts = nullptr);

}  // namespace bahnwerk::winding
