#pragma once
/// Writes a motion piece by piece: what is known where pieces meet (velocity, acceleration, jerk) is taken as such,
/// positions go on where the piece before ends, so that rounding opens no gaps.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

class MotionWriter {
 public:
  /// At rest at the first point, which is passed.
  explicit MotionWriter(const ProbeProblem& problem);

  struct State {
    Vec x, v, a, j;  ///< mm, mm/s, mm/s², mm/s³
  };
  /// What the last piece evaluates to at its end, as SplineMotion evaluates it: for a next piece that goes on from
  /// there. Its duration is then that of its rounded times.
  State carry();

  double time() const { return time_; }       ///< s
  Vec position() const { return position_; }  ///< where the last piece ends, mm
  /// Nothing is added where `duration` is lost in the rounding of the time.
  void add(double duration, Vec v, Vec a, Vec j, Vec snap);
  /// Σ c_i τⁱ, of which c_0 is replaced by position(); degree 8 at most.
  void add(double duration, std::span<const Vec> coefficients, PieceJoint joint = PieceJoint::exact);
  /// Puts right what rounding has moved the position by, if it is no more than that.
  void aim(Vec position);
  /// The next point is passed at `t` s.
  void pass(double t) { out_.times.push_back(t); }
  void phase(ProbePhaseKind kind, double begin, double end, std::size_t point) {
    out_.phases.push_back({kind, begin, end, point});
  }
  /// Passes the last point.
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
