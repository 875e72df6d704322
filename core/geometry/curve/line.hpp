#pragma once
/// A straight line, u ∈ [0, 1].
#include "core/geometry/curve/curve.hpp"

namespace bahnwerk {

class Line final : public Curve {
 public:
  Line(Vec from, Vec to) : from_(from), to_(to), way_(to - from), length_(norm(way_)) {}

  CurveKind kind() const override { return CurveKind::line; }
  double begin() const override { return 0; }
  double end() const override { return 1; }
  Jet at(double u) const override;
  double speed(double) const override { return length_; }

  Vec from() const { return from_; }
  Vec to() const { return to_; }
  double length() const { return length_; }

 private:
  Vec from_, to_, way_;
  double length_;
};

}  // namespace bahnwerk
