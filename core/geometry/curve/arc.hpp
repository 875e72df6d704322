#pragma once
/// A circular arc, or a helix: h(u) = c + r (cos φ e₁ + sin φ e₂) + u·rise·n, φ = u·sweep, u ∈ [0, 1], n = e₁ × e₂.
#include "core/geometry/curve/curve.hpp"

namespace bahnwerk {

class Arc final : public Curve {
 public:
  /// `e1`, `e2` are orthonormal; `sweep` in rad, negative values turn from e₂ to e₁; `rise` in mm over the whole arc.
  Arc(Vec centre, Vec e1, Vec e2, double radius, double sweep, double rise = 0);

  /// Returns the arc from one point to another about a centre. `counter_clockwise` is seen with the normal pointing to
  /// the viewer; the height of `to` above `from` along the normal becomes the rise of a helix; equal points (to 1e-9 mm
  /// in the plane) mean a full circle. The radii at the ends may differ by `tolerance`, mm: the centre then moves, as
  /// little as possible, to the perpendicular bisector of the chord. Throws InvalidInput at {"arc"} for values that are
  /// not finite or beyond 1e9 mm, at {"arc","normal"} for a zero normal, and at {"arc","center"} for a zero radius, for
  /// radii that differ by more, and for an arc of more than half a turn whose end points are so close that the centre
  /// would move by over 5 % of the radius.
  static Arc through(Vec from, Vec to, Vec centre, Vec normal, bool counter_clockwise, double tolerance = 0.01);

  CurveKind kind() const override { return CurveKind::arc; }
  double begin() const override { return 0; }
  double end() const override { return 1; }
  Jet at(double u) const override;
  double speed(double) const override { return length_; }
  bool derivatives(PathBatch& batch) const override;

  Vec centre() const { return centre_; }
  double radius() const { return radius_; }
  double sweep() const { return sweep_; }
  double rise() const { return rise_; }
  Vec e1() const { return e1_; }
  Vec e2() const { return e2_; }
  Vec normal() const { return cross(e1_, e2_); }
  double length() const { return length_; }

 private:
  Vec centre_, e1_, e2_, start_, climb_;
  double radius_, sweep_, rise_, length_;
};

}  // namespace bahnwerk
