#pragma once
/// Whether the arc length that a law counts in is the length of the curve.
#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {

/// Keeps the largest miss, mm, with what quadrature and rounding may be of it.
class ArcLengthCheck {
 public:
  /// `pulse` outlives it.
  explicit ArcLengthCheck(ProgressScope& pulse) : pulse_(pulse) {}

  /// The way that the law goes along a piece against the length of what it goes along, mm.
  void believe(const LawPiece& piece, const Segment& segment, double way);
  /// ∫|dh/du| du over [u0, u1] against the way from s0 to s1 of the segment, by Lobatto's rule, with more points and
  /// then halved until the rule resolves it.
  void measure(const LawPiece& piece, const Segment& segment, double u0, double u1, double s0, double s1) {
    measure(piece, segment, u0, u1, s0, s1, 0);
  }
  /// A stretch of `way` mm is `miss` mm longer or shorter, found at the time `when`.
  void raise(double miss, const Segment& segment, double way, double when);
  /// To what quadrature resolves the length of a stretch, mm.
  static double resolution(const Segment& segment, double way);

  const Strained& worst() const { return worst_; }

 private:
  void measure(const LawPiece& piece, const Segment& segment, double u0, double u1, double s0, double s1, int depth);

  ProgressScope& pulse_;
  Strained worst_;
};

}  // namespace bahnwerk::verify
