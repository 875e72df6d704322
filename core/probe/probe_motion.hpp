#pragma once
/// Motion that every method of kind `probe_path` plans: polynomials in time with the times at which the points are
/// passed.
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/named.hpp"
#include "core/base/progress_scope.hpp"
#include "core/geometry/curve/vec.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk {

/// The head's motion in a phase. `rest`: it stands still at a point for a moment (begin = end). `interval`: it goes
/// from one point to the next one in a single phase.
enum class ProbePhaseKind { accelerate, hold, brake, turn, rest, interval };
inline constexpr Named<ProbePhaseKind> probe_phase_kinds[] = {{ProbePhaseKind::accelerate, "accelerate"},
                                                              {ProbePhaseKind::hold, "hold"},
                                                              {ProbePhaseKind::brake, "brake"},
                                                              {ProbePhaseKind::turn, "turn"},
                                                              {ProbePhaseKind::rest, "rest"},
                                                              {ProbePhaseKind::interval, "interval"}};

struct ProbePhase {
  ProbePhaseKind kind = ProbePhaseKind::interval;
  double begin = 0, end = 0;  ///< s
  std::size_t point =
      0;  ///< index in ProbeProblem::points of the point where it turns or rests, else of the point passed before
};

/// Change of a piece in a motion whose times are rounded differently from the planned ones.
enum class PieceJoint : char {
  exact,     ///< the piece stays as it is: acceleration and jerk are (nearly) 0 at both ends
  carried,   ///< the piece begins in the state in which the one before ends
  landing,   ///< the piece is carried; it ends in the planned state by a polynomial of its own (core/probe/landing.hpp)
  settling,  ///< landing, with a free position at its end: it is short and ends at rest
};

struct ProbeMotion {
  std::shared_ptr<const SplineMotion> motion;  ///< motion of as many axes as the problem has
  std::vector<double> times;  ///< s, per point of ProbeProblem::points, ascending, first 0, last duration
  /// s, per piece, as planned: the ends of pieces are their rounded sums. Empty: differences of ends. slowed() starts
  /// from them; differences of ends would be rounded once more than the verifier grants.
  std::vector<double> durations;
  std::vector<PieceJoint> joints;  ///< joint of each piece; empty: all are exact
  /// The place at which a motion with carried positions has to end: the longest piece takes out what rounding adds up
  /// to in minutes at full speed.
  std::optional<Vec> end;
  std::vector<ProbePhase> phases;  ///< phases in order of time
  double duration() const { return motion->duration(); }
};

/// Returns value and first three derivatives of a polynomial at t, s, rounded as SplineMotion rounds them.
std::array<double, 4> state_at(const Polynomial& p, double t);

/// Sets coefficients below 1e-200 to 0. An axis that stands still may have coefficients so small that they lose digits;
/// it would then end nearly at rest instead of at rest.
void drop_vanishing(Polynomial& p);

/// A sum of times in two numbers (Kahan and Babuška), which is rounded only where it is read.
class TimeSum {
 public:
  void add(double duration) {
    const double sum = high_ + duration, back = sum - high_;
    low_ += (high_ - (sum - back)) + (duration - back);
    high_ = sum;
  }
  double value() const { return high_ + low_; }

 private:
  double high_ = 0, low_ = 0;
};

/// Returns the motion on its path, `factor` > 0 times as slow: times are multiplied by factor, coefficient i is divided
/// by factorⁱ, hence derivative r of every axis by factorʳ. The slowed motion ends at `duration` exactly, s; without it
/// at factor · motion.duration().
ProbeMotion slowed(const ProbeMotion& motion, double factor);
ProbeMotion slowed(const ProbeMotion& motion, double factor, double duration, ProgressScope* progress = nullptr);

}  // namespace bahnwerk
