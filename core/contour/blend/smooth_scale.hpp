#pragma once
/// The length scale of a spline along a run of segments: the scale on which the tube around them lets a curve bend. The
/// spline's breaks follow from it (smooth.hpp).
#include <cstddef>
#include <vector>

#include "core/contour/blend/elements.hpp"

namespace bahnwerk::blending {

/// H(t) is approximately the length of contour around t that stays within the tolerance of its chord (√(8 R ε) on an
/// arc). It changes by at most 0.4 per mm of t, so neighbouring spline intervals are of similar size.
class TubeScale {
 public:
  /// Computes H between the places a and b of an element run, mm; `tolerance` in mm. O(nodes · log elements), about 4
  /// nodes per H.
  TubeScale(const ElementRun& stretch, double a, double b, double tolerance, ProgressScope& progress);

  /// Returns H at the place `t`, both in mm. O(log nodes).
  double at(double t) const;
  /// Returns at(t) for queries in nearly ascending order; `node` is the place of the last query, 0 at first.
  double at(double t, std::size_t& node) const;
  /// Halves H around these places (ascending), but not below a sixteenth of the tolerance. Returns false if nothing
  /// could be halved.
  bool refine(const std::vector<double>& places);
  /// Returns the scale between two of its places, to be refined separately. O(log nodes + nodes between them).
  TubeScale part(double a, double b) const;
  /// Returns the place `breaks` breaks after `t`, at most the end. O(log nodes + nodes passed).
  double ahead(double t, double breaks) const;
  /// Returns the spline breaks from a to b: intervals of H/2, at least 8.
  std::vector<double> breaks() const;

 private:
  TubeScale() = default;
  /// Lowers H where its slope exceeds 0.4.
  void grade();

  std::vector<double> t_, h_;  ///< nodes: places along the element run, ascending, and H there, mm
  double min_ = 0;             ///< least H that refine() reaches
};

/// Returns the point of an element run at `t`; `at` becomes the element that holds it. O(1) near the previous element
/// `at`, else O(log elements).
Vec point_of(const ElementRun& stretch, double t, std::size_t& at);
/// Returns the point of an element run at `t`.
inline Vec point_of(const ElementRun& stretch, double t) {
  std::size_t at = stretch.find(t, stretch.elements.size());
  return point_of(stretch, t, at);
}

}  // namespace bahnwerk::blending
