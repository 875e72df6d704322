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
  /// A place of a segment by the curve's parameter and by its length from the segment's begin, mm.
  struct Place {
    double u, s;
  };

  /// `progress` has to outlive the object.
  explicit ArcLengthCheck(ProgressScope& progress) : progress_(progress) {}

  /// Compares the length that the law covers in a piece with the length of the segment's part, mm.
  void believe(const LawPiece& piece, const Segment& segment, double way);
  /// Compares ∫|dh/du| du between two places with the length between them, by Lobatto's rule, with more points and
  /// on halved intervals until the rule resolves the integral.
  void measure(const LawPiece& piece, const Segment& segment, Place from, Place to, int halvings = 0);
  /// Records an error of `miss` mm over a length of `way` mm at the time `when`.
  void raise(double miss, const Segment& segment, double way, double when);
  /// Returns the resolution of the quadrature over a length, mm.
  static double resolution(const Segment& segment, double way);

  const Strained& worst() const { return worst_; }

 private:
  ProgressScope& progress_;
  Strained worst_;
};

}  // namespace bahnwerk::verify
