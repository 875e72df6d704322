#pragma once
/// Guides a stator's needle past the posts of the winding tools between a slot and a winding head. Lengths mm, angles
/// rad.
///
/// The source's extra point lies on the slot's own radius [Herrmann 4.3.4]. Where a post reaches across that radius the
/// needle would collide with it. The point is then placed beside the post, on the side that faces away from the coil's
/// middle, where the wire will lie: the needle passes there on a radius and then round the post's outer face.
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/spline/bezier_piece.hpp"
#include "core/winding/needle/part_obstacles.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {

/// An extra point in the plane across the part's axis.
struct ExtraPoint {
  double azimuth = 0, radius = 0;
};

/// A passage from a slot into a winding head, or in the other direction.
struct Way {
  std::size_t coil = 0;
  bool second = false;    ///< side of the coil
  NeedlePose slot, head;  ///< poses at both ends
};

class PostPassage {
 public:
  /// `part` has to outlive the object. `clearance` is the required one, mm. Throws what part_obstacles throws.
  PostPassage(const StatorPart& part, const std::vector<Coil>& coils, const ToolPost& post, const NeedleShape& needle,
              double clearance);

  /// Returns the value that both clearances have to reach, mm: the required one plus the possible difference of two
  /// proofs.
  double enough() const { return clearance_ + 2 * tolerance; }
  /// Returns the least distance of the needle along these pieces from the posts of this coil, mm, proven to 0.001, or
  /// enough() if the distance is larger. 0.1 ms.
  double from_posts(std::size_t coil, std::span<const BezierPiece> pieces, Progress progress) const;
  /// Returns the least distance from its posts and from the stack, enough() at most.
  double from_all(std::size_t coil, std::span<const BezierPiece> pieces, Progress progress) const;

  /// Number of places beside the post that are tried, those nearest to the slot's radius first.
  static constexpr std::size_t places = 12;
  ExtraPoint beside(const Way& way, std::size_t place) const;

 private:
  static constexpr double tolerance = 1e-3;  // mm, of a clearance
  const StatorPart& part_;
  std::vector<Coil> coils_;
  ToolPost post_;
  NeedleShape needle_;
  double clearance_;
  std::vector<PartObstacles> obstacles_;  ///< obstacles of each coil
};

}  // namespace bahnwerk::winding
