#pragma once
/// The link at one place of the needle's path: the smoothest, or that of (4.61), without cusps and loops
/// [Herrmann 4.3].
#include <cstddef>
#include <optional>

#include "core/base/progress.hpp"
#include "core/geometry/spline/search/best_link.hpp"

namespace bahnwerk::winding {

struct LinkOptions {
  std::size_t continuity = 3;  ///< k of G^k, 1 … 4
  LinkObjective objective = LinkObjective::curvature;
  SmoothnessWeights weights;
  /// A stator's needle leaves the slot radially: between slot and winding head it passes an extra point above the slot,
  /// at this fraction of the distance to the head's radius (λ of [Herrmann 4.3.4]), where its swivel is complete. 0: no
  /// such point. There are then two links, which meet there on a radius, without curvature and without turning. (The
  /// source has one link with a double knot, which continues to turn behind the point: ψ overshoots by up to 90°.)
  double extra_point = 0.5;
};

/// Returns ∫ κ ds along a piece, the angle by which its tangent turns, rad, by the midpoint rule with 128 nodes.
double turned_angle(const BezierPiece& piece);

/// Returns the largest κ where the parametric speed has a minimum, 1/mm. A place too narrow for a quadrature is one at
/// which the needle nearly stands still. 50 µs.
double sharpest_curvature(const BezierPiece& piece);
constexpr double sharpest_usable = 100;  ///< κ, 1/mm; above it the place counts as a cusp

struct FoundLink {
  BestLink best;  ///< the link; J is computed by a fine rule and is no less than the sharpest place implies
  LinkObjective objective = LinkObjective::curvature;  ///< the objective that was minimised last
  double bend = 0;                                     ///< largest κ at a minimum of the speed, 1/mm
  bool cusped() const { return !(bend <= sharpest_usable); }
};

class LinkSearch {
 public:
  /// `options` has to outlive the object.
  explicit LinkSearch(const LinkOptions& options);

  /// Returns the link. `known` is the link at this place of the turn before, which is nearly equal. (4.61) ignores the
  /// curvature of a link: where it leads to a cusp, that place has the smoothest link, from turn to turn. The result
  /// may still have a cusp. About 1.5 ms, 10 ms for the first turn.
  FoundLink find(const LinkEnds& ends, const std::optional<FoundLink>& known, Progress progress) const;

 private:
  FoundLink again(const LinkEnds& ends, const std::optional<FoundLink>& known, LinkObjective objective,
                  Progress progress) const;
  FoundLink solve(const LinkEnds& ends, const LinkShape& start, LinkObjective objective, std::size_t evaluations,
                  Progress progress) const;
  struct ByRule {
    FoundLink link;
    double smoothness = 0;  // J by the rule of the search
  };
  ByRule by(const SmoothnessRule& rule, const LinkEnds& ends, const BestLinkOptions& options, Progress progress) const;
  FoundLink search(const LinkEnds& ends, LinkObjective objective, Progress progress) const;

  const LinkOptions& options_;
  SmoothnessRule rule_, fine_rule_;
};

}  // namespace bahnwerk::winding
