#pragma once
/// How far a path strays from one block of a contour.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/matched.hpp"
#include "core/verify/geometry/curve_piece.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {

/// The segments [first, last) of a path.
struct Stretch {
  const Path* path = nullptr;
  std::size_t first = 0, last = 0;
};

/// Matches two stretches of positive length, begin to begin and end to end, forward on both in between. First by
/// following both piece by piece; where that shows more than the tolerance (coils and spikes smaller than it mislead
/// it), by the decision of the Fréchet distance of polygons that are within 0.2 % of the tolerance of them.
class TubeBlock {
 public:
  TubeBlock(double tolerance, ProgressScope& pulse) : tolerance_(tolerance), pulse_(pulse) {}

  /// A bound of the distance, mm, under the matching found, and where on the path, mm. Above the tolerance: a distance
  /// under the matching that was tried first.
  Worst measure(const Stretch& given, const Stretch& path);

 private:
  /// Matched pieces of a path segment and a contour segment.
  struct Cell {
    std::size_t path = 0, given = 0;
    MatchedPieces pieces;  ///< a: of the path, b: of the contour
  };

  void cut(const Stretch& stretch, std::vector<CurvePiece>& curve_pieces);
  void match();
  void follow(const CurvePiece& link, std::size_t curve_piece, double at, std::size_t& to, double& place) const;
  void lay(const CurvePiece& link, std::size_t curve_piece, double at, Vec p, std::size_t to, double place);
  Worst bound();
  bool traversable(double radius);
  bool polygon(const Stretch& stretch, double bulge, std::vector<Vec>& points);

  double tolerance_;
  ProgressScope& pulse_;
  Stretch given_, path_;
  std::vector<CurvePiece> limbs_, links_;  ///< of the contour, of the path
  std::vector<Cell> cells_;
  std::vector<Vec> given_points_, path_points_;
};

}  // namespace bahnwerk::verify
