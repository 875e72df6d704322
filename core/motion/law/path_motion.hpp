#pragma once
/// An axis path driven by a time law.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The motion has the pieces of the law, which ends at rest at the end of the path. Snap is not available: it needs a
/// fourth derivative of the path.
class PathMotion final : public Motion {
 public:
  /// The law has at least one piece.
  PathMotion(std::shared_ptr<const AxisPath> path, TimeLaw law) : path_(std::move(path)), law_(std::move(law)) {}
  const AxisPath& path() const { return *path_; }
  const TimeLaw& law() const& { return law_; }
  TimeLaw law() && { return std::move(law_); }
  std::size_t axes() const override { return path_->axes(); }
  std::size_t pieces() const override { return law_.pieces().size(); }
  double begin(std::size_t piece) const override { return law_.pieces()[piece].t0; }
  double duration() const override { return law_.duration(); }
  /// Costs one inversion of the arc length and one evaluation of the path.
  MotionState in_piece(std::size_t piece, double t) const override;
  /// Returns rest, exactly at the end of the path.
  MotionState final_state() const override;
  /// Returns place and speed along the tool's path, s between the ends of the piece.
  LawState along(std::size_t piece, double t) const {
    const LawPiece& p = law_.pieces()[piece];
    LawState x = p.at(std::clamp(t - p.t0, 0.0, p.duration));
    x.s = std::clamp(x.s, p.s, p.s_end);
    return x;
  }
  /// Returns the axes for the tool at `x` in that piece: in_piece(piece, t) = driven(piece, along(piece, t)).
  MotionState driven(std::size_t piece, const LawState& x) const;
  /// Writes position, velocity and acceleration of driven(): axes() numbers of each, one after the other.
  void write_driven(std::size_t piece, const LawState& x, double* out) const;

 private:
  std::shared_ptr<const AxisPath> path_;
  TimeLaw law_;
};

}  // namespace bahnwerk
