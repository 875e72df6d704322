#pragma once
/// How a stator's needle gets past the posts of the winding tools between a slot and a winding head. Lengths mm, angles
/// rad.
///
/// The source's extra point lies on the slot's own radius [Herrmann 4.3.4]. Where a post reaches across that radius the
/// needle would run into it. Then the point is put beside the post, on the side that faces away from the coil's middle,
/// where the wire comes to lie: the needle passes there on a radius and goes round the post's outer face.
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/winding/needle/part_obstacles.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

/// In the plane across the part's axis.
struct ExtraPoint {
  double azimuth = 0, radius = 0;
};

/// From a slot into a winding head, or the other way round.
struct Way {
  std::size_t coil = 0;
  bool second = false;    ///< side of the coil
  NeedlePose slot, head;  ///< between which it leads
};

class PostPassage {
 public:
  /// `part` outlives it. `clearance`: that the needle has to keep, mm. Throws what part_obstacles throws.
  PostPassage(const StatorPart& part, const std::vector<Coil>& coils, const ToolPost& post, const NeedleShape& needle,
              double clearance);

  /// What both have to be, mm: as much as two proofs of a clearance can differ above what was asked for.
  double enough() const { return clearance_ + 2 * tolerance; }
  /// The least distance of the needle along these pieces from the posts of this coil, mm, proven to 0.001. 0.1 ms.
  double from_posts(std::size_t coil, std::span<const BezierPiece> pieces, Progress& progress) const;
  /// From its posts and from the stack.
  double from_all(std::size_t coil, std::span<const BezierPiece> pieces, Progress& progress) const;

  /// Places beside the post, all of them worth a try; the ones nearest to the slot's radius first.
  static constexpr std::size_t places = 12;
  ExtraPoint beside(const Way& way, std::size_t place) const;

 private:
  static constexpr double tolerance = 1e-3;  // mm, of a clearance
  const StatorPart& part_;
  std::vector<Coil> coils_;
  ToolPost post_;
  NeedleShape needle_;
  double clearance_;
  std::vector<PartObstacles> obstacles_;  ///< by coil
};

}  // namespace bahnwerk::winding
