#pragma once
/// How finely a spline has to be able to bend along a run of segments.
#include <cstddef>
#include <vector>

#include "core/contour/blend/elements.hpp"

namespace bahnwerk::blending {

/// H(t): about the length of contour around t that stays within the tolerance of its chord (√(8 R ε) on an arc). It
/// changes by at most 0.4 per mm of t, so neighbouring spline intervals are of similar size.
class BendScale {
 public:
  /// Between a and b of a stretch, mm; `tolerance` mm. O(nodes · log elements), some 4 nodes per H.
  BendScale(const Stretch& stretch, double a, double b, double tolerance, ProgressScope& scope);

  double at(double t) const;
  /// The same for places that are asked for nearly in order: `node` is where the last one was, 0 at first.
  double at(double t, std::size_t& node) const;
  /// Halves H around these places (ascending), but not below a sixteenth of the tolerance. False: nothing is left to
  /// be halved.
  bool refine(const std::vector<double>& places);
  /// The same between two of its places, to be refined on its own. O(log nodes + nodes between them).
  BendScale part(double a, double b) const;
  /// From `t` on: where so many breaks have passed, at most the end. O(log nodes + nodes passed).
  double ahead(double t, double breaks) const;
  /// Spline breaks: intervals of H/2, at least 8, their ends a and b.
  std::vector<double> breaks() const;

 private:
  BendScale() = default;
  /// Applies the bound on the slope.
  void grade();

  std::vector<double> t_, h_;
  double min_ = 0;
};

/// Point of a stretch at `t`, which lies on element `at` afterwards. O(1) near the element that `at` was before, else
/// O(log elements).
Vec point_of(const Stretch& stretch, double t, std::size_t& at);
/// The same from nowhere.
inline Vec point_of(const Stretch& stretch, double t) {
  std::size_t at = stretch.find(t, stretch.elements.size());
  return point_of(stretch, t, at);
}

}  // namespace bahnwerk::blending
