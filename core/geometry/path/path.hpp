#pragma once
/// Consecutive curves over the arc length s ∈ [0, length()], mm: the geometry that planner and verifier share.
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/geometry/curve/curve.hpp"
#include "core/geometry/path/arc_length.hpp"

namespace bahnwerk {

/// h(s) and its derivatives by arc length: |d1| = 1, d2 ⟂ d1 is the curvature vector, 1/mm, d3 in 1/mm².
using PathPoint = Jet;

class EndExpansion;

/// A smooth piece [s0, s1] of a path. Cost: at_parameter O(degree), parameter(s) one or two Newton steps on the
/// arc-length table.
class Segment {
 public:
  /// `source` is a number of the caller's choice (index of the input segment). Throws InvalidInput for a curve without
  /// length (≤ 1e-12 mm), std::invalid_argument for one whose parametric tangent vanishes inside or at both ends:
  /// Path::append cuts such curves.
  Segment(std::shared_ptr<const Curve> curve, double s0, std::size_t source);
  /// Makes a segment of a piece of another segment's curve, as it is or reversed: it is regular inside, and rounding
  /// shall not decide that again. Throws InvalidInput for a curve without length.
  static Segment piece(std::shared_ptr<const Curve> curve, double s0, std::size_t source) {
    return {std::move(curve), s0, source, Regular{}};
  }

  const Curve& curve() const { return *curve_; }
  bool straight() const {
    return straight_;
  }  ///< whether it is a line, or a straight curve: all derivatives beyond the tangent vanish
  double s0() const { return s0_; }
  double s1() const { return s1_; }
  double length() const { return s1_ - s0_; }
  std::size_t source() const { return source_; }

  double parameter(double s) const;  ///< returns u(s), to 1e-10 of the segment's length
  double parameter_at(double travelled) const { return arc_length_.inverse(travelled); }  ///< inverse of travelled(u)
  PointPair parameter_at(PointPair travelled) const { return arc_length_.inverse(travelled); }
  double arc_length(double u) const;  ///< returns s(u) on the path, exact to 1e-12 of the segment's length
  double travelled(double u) const {
    return arc_length_.at(u);
  }  ///< returns s(u) from the beginning of the segment, mm
  /// Writes travelled() at the ascending parameters of a batch to batch.s. Two values take little longer than one.
  void travelled(PathBatch& batch) const { arc_length_.at(batch); }
  PathPoint at_parameter(
      double u) const;  ///< derivatives by arc length at u; one-sided limits at vanishing parametric tangents
  /// Returns the derivatives by arc length from known derivatives by the parameter.
  PathPoint at_parameter(double u, const Jet& by_parameter) const;
  /// Returns the point at path length s ∈ [s0, s1].
  PathPoint at(double s) const;
  /// Writes path length and derivatives by it at all parameters of a batch.
  void at_parameters(PathBatch& batch) const;
  /// Returns suitable places of nodes: the borders of the arc-length table's panels, ascending, ends included; they are
  /// dense where the curve is difficult.
  std::vector<double> panel_parameters() const;

  /// Returns whether the parametric tangent vanishes at that end and the curvature grows without bound (or beyond
  /// `sharpest_curvature` per length of the segment): the speed has to be 0 there. at_parameter() returns d2 = d3 = 0
  /// at the end itself.
  bool cusp_begin() const { return cusp_begin_; }
  bool cusp_end() const { return cusp_end_; }

 private:
  friend class Path;
  struct Regular {};  ///< tag: the curve is known to be regular inside
  Segment(std::shared_ptr<const Curve> curve, double s0, std::size_t source, Regular);

  std::shared_ptr<const Curve> curve_;
  ArcLength arc_length_;
  double s0_, s1_;
  std::size_t source_;
  bool straight_ = false, cusp_begin_ = false, cusp_end_ = false;
  Vec start_, tangent_;  ///< beginning and unit tangent of a straight segment
  std::shared_ptr<const EndExpansion>
      expansion_;  ///< derivatives near an end at which the parametric tangent vanishes; else null
};

/// Segments end to end. It is immutable and thread-safe after the last append().
class Path {
 public:
  /// Appends a curve that starts where the path ends (not checked). Curves are split at interior points with a
  /// vanishing parametric tangent; the caller drops lines of zero length. Throws InvalidInput for a curve without
  /// length; the path is then unchanged.
  void append(const std::shared_ptr<const Curve>& curve, std::size_t source);
  /// Appends one segment, Segment::piece.
  void append_piece(const std::shared_ptr<const Curve>& curve, std::size_t source) {
    segments_.push_back(Segment::piece(curve, length(), source));
  }

  std::size_t size() const { return segments_.size(); }
  bool empty() const { return segments_.empty(); }
  const Segment& operator[](std::size_t i) const { return segments_[i]; }
  /// Returns the total length, mm.
  double length() const { return segments_.empty() ? 0.0 : segments_.back().s1(); }
  /// Returns the index of the segment that holds s (the later one at a joint; the last one at the end). O(log n), O(1)
  /// with a good hint.
  std::size_t find(double s, std::size_t hint = 0) const;
  /// Returns the point at path length s. O(log n).
  PathPoint at(double s) const;

 private:
  std::vector<Segment> segments_;
};

}  // namespace bahnwerk
