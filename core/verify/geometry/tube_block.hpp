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
/// following both piece by piece. Where that shows more than the tolerance (coils and spikes smaller than it mislead
/// it), by the decision of the Fréchet distance of polygons that are within 0.2 % of the tolerance of them: of the
/// surroundings of such a place, between two pairs of points that were matched well, and if that does not do of wider
/// ones, up to the whole block.
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
  /// A place of the contour that a piece's end is matched to: on a piece of it, at a parameter; mm apart.
  struct Match {
    std::size_t limb = 0;
    double u = 0, distance = 0;
  };
  /// Pieces of the path, [first, last).
  struct Window {
    std::size_t first = 0, last = 0;
  };

  void cut(const Stretch& stretch, std::vector<CurvePiece>& curve_pieces);
  void match();
  Match follow(const CurvePiece& link, const Match& from) const;
  void lay(const CurvePiece& link, const Match& from, const Match& to);
  Worst bound(double& found);
  std::vector<Window> windows(std::size_t margin) const;
  bool separates(std::size_t link) const;
  double decided(const Window& window);
  bool polygon(const Path& path, const CurvePiece& first, double begin, const CurvePiece& last, double end,
               std::vector<Vec>& points);

  double tolerance_;
  ProgressScope& pulse_;
  Stretch given_, path_;
  std::vector<CurvePiece> limbs_, links_;  ///< of the contour, of the path
  std::vector<Match> ends_;                ///< of the links
  std::vector<Cell> cells_;                ///< of one link
  std::vector<std::size_t> strayed_;       ///< links that are farther away than the tolerance
  Worst near_, far_;                       ///< of all other links, and of these
  std::vector<Vec> given_points_, path_points_;
};

}  // namespace bahnwerk::verify
