#pragma once
/// Writes a motion piece by piece: velocity, acceleration and jerk at joints are given, positions continue where the
/// piece before ends, so that rounding opens no gaps.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

class MotionWriter {
 public:
  /// Begins at rest at the first point, which is passed.
  explicit MotionWriter(const ProbeProblem& problem);

  struct State {
    Vec x, v, a, j;  ///< mm, mm/s, mm/s², mm/s³
  };
  /// Returns the state at the end of the last piece as SplineMotion evaluates it, from which the next piece can go on.
  /// The planned duration of the last piece becomes that of its rounded times.
  State carry();

  double time() const { return time_; }       ///< s
  Vec position() const { return position_; }  ///< place where the last piece ends, mm
  /// Adds a piece of `duration` s from position() with these derivatives (mm/s … mm/s⁴) at its begin. A duration that
  /// is lost in the rounding of time() adds nothing.
  void add(double duration, Vec v, Vec a, Vec j, Vec snap);
  /// Adds the piece Σ c_i τⁱ, i ≤ 8, whose c_0 is replaced by position().
  void add(double duration, std::span<const Vec> coefficients, PieceJoint joint = PieceJoint::exact);
  /// Sets the position to `position` along each axis on which they differ by rounding (8 ε) alone.
  void aim(Vec position);
  /// Passes the next point at `t` s.
  void pass(double t) { out_.times.push_back(t); }
  void phase(ProbePhaseKind kind, double begin, double end, std::size_t point) {
    out_.phases.push_back({kind, begin, end, point});
  }
  /// Rests at point `number`, where the motion is, for a moment: the point is passed.
  void rest(std::size_t number) {
    pass(time_);
    phase(ProbePhaseKind::rest, time_, time_, number);
  }
  /// Passes the last point and returns the motion.
  ProbeMotion finish();

 private:
  const ProbeProblem& problem_;
  ProbeMotion out_;
  std::vector<SplineMotion::Piece> pieces_;
  TimeSum sum_;
  double time_ = 0;
  Vec position_;
};

}  // namespace bahnwerk::probe
