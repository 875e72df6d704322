#pragma once
/// Checks that the arc length used by a law is the length of the curve.
#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {

/// Collects the largest error, mm, in relation to the error of quadrature and rounding.
class ArcLengthCheck {
 public:
  /// `progress` has to outlive the object.
  explicit ArcLengthCheck(ProgressScope& progress) : progress_(progress) {}

  /// Compares the length that the law covers in a piece with the length of the segment's part, mm.
  void believe(const LawPiece& piece, const Segment& segment, double way);
  /// Compares ∫|dh/du| du over [u0, u1] with the length from s0 to s1 of the segment, by Lobatto's rule, with more
  /// points and on halved intervals until the rule resolves the integral.
  void measure(const LawPiece& piece, const Segment& segment, double u0, double u1, double s0, double s1) {
    measure(piece, segment, u0, u1, s0, s1, 0);
  }
  /// Records an error of `miss` mm over a length of `way` mm at the time `when`.
  void raise(double miss, const Segment& segment, double way, double when);
  /// Returns the resolution of the quadrature over a length, mm.
  static double resolution(const Segment& segment, double way);

  const Strained& worst() const { return worst_; }

 private:
  void measure(const LawPiece& piece, const Segment& segment, double u0, double u1, double s0, double s1, int depth);

  ProgressScope& progress_;
  Strained worst_;
};

}  // namespace bahnwerk::verify
