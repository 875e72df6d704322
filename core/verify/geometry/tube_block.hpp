#pragma once
/// A bound of the distance of a path from one block of a contour.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/matched.hpp"
#include "core/verify/geometry/curve_piece.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {

/// The segments [first, last) of a path.
struct PathRange {
  const Path* path = nullptr;
  std::size_t first = 0, last = 0;
};

/// Matches two ranges of segments of positive length, beginning to beginning and end to end, forwards on both. The
/// first method follows both piece by piece. Where that gives more than the tolerance (coils and spikes smaller than
/// the tolerance mislead it), the Fréchet distance decides, for polygons within 0.2 % of the tolerance of the curves:
/// first for the surroundings of such a place, between two pairs of points that were matched well, then for wider ones,
/// up to the whole block.
class TubeBlock {
 public:
  TubeBlock(double tolerance, ProgressScope& progress) : tolerance_(tolerance), progress_(progress) {}

  /// Returns a bound of the distance, mm, under the matching found, and its place on the path, mm; if above the
  /// tolerance, a distance under the matching of the first method.
  Worst measure(const PathRange& given, const PathRange& path);

 private:
  /// Matched pieces of a path segment and of a contour segment.
  struct Cell {
    std::size_t path = 0, given = 0;
    MatchedPieces pieces;  ///< piece a of the path, piece b of the contour
  };
  /// The place of the contour that is matched to the end of a piece: a piece of the contour, a parameter, and the
  /// distance, mm.
  struct Match {
    std::size_t limb = 0;
    double u = 0, distance = 0;
  };
  /// The pieces [first, last) of the path.
  struct Window {
    std::size_t first = 0, last = 0;
  };

  void cut(const PathRange& stretch, std::vector<CurvePiece>& curve_pieces);
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
  ProgressScope& progress_;
  PathRange given_, path_;
  std::vector<CurvePiece> limbs_, links_;  ///< pieces of the contour and of the path
  std::vector<Match> ends_;                ///< matches of the ends of the path's pieces
  std::vector<Cell> cells_;                ///< cells of the current piece of the path
  std::vector<std::size_t> strayed_;       ///< pieces of the path that are farther away than the tolerance
  Worst near_, far_;  ///< largest distances: of the pieces that stay within the tolerance, and of those in strayed_
  std::vector<Vec> given_points_, path_points_;
};

}  // namespace bahnwerk::verify
