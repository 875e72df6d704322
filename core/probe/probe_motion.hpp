#pragma once
/// What every method of kind `probe_path` plans: polynomials in time with the times at which the points are passed.
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

/// What the head does for a while. `rest`: it stands still at a point for a moment (begin = end). `interval`: it goes
/// from one point to the next one, with nothing to say of parts of it.
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
  std::size_t point = 0;      ///< in ProbeProblem::points: that of a turn or rest, else that which was passed before
};

/// What becomes of a piece where times are rounded another way than they were planned with.
enum class PieceJoint : char {
  exact,     ///< it stays what it is: acceleration and jerk are 0 at both ends, or nearly so
  carried,   ///< it begins in the state in which the one before ends
  landing,   ///< that, too, and it takes up what rounding has left open at its end (core/probe/landing.hpp)
  settling,  ///< that, too, but for its position: it is short and ends at rest
};

struct ProbeMotion {
  std::shared_ptr<const SplineMotion> motion;  ///< as many axes as the problem has
  std::vector<double> times;  ///< s, per point of ProbeProblem::points, ascending, first 0, last duration
  /// s, per piece, as planned: the ends of pieces are their sums, rounded. Empty: differences of ends. Slowed motions
  /// are made from them, as times would otherwise be rounded once more than the verifier grants.
  std::vector<double> durations;
  std::vector<PieceJoint> joints;  ///< per piece; empty: all exact
  /// Where the motion has to end, where positions are carried all the way: what rounding makes of minutes at full speed
  /// is taken out in the longest piece.
  std::optional<Vec> end;
  std::vector<ProbePhase> phases;  ///< in order of time
  double duration() const { return motion->duration(); }
};

/// Value and first three derivatives of a polynomial, rounded as SplineMotion rounds them.
std::array<double, 4> state_at(const Polynomial& p, double t);

/// Sets coefficients below 1e-200 to 0: an axis that stands still may be left with numbers so small that they lose
/// digits, and then it ends nearly at rest.
void drop_vanishing(Polynomial& p);

/// A sum of times that is rounded only where it is read.
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

/// The same path `factor` (> 0) times as slow: times by it, coefficient i divided by factorⁱ. Derivative r of every
/// axis is divided by factorʳ. `duration` is what the slowed motion ends at, exactly; factor · duration by default.
ProbeMotion slowed(const ProbeMotion& motion, double factor);
ProbeMotion slowed(const ProbeMotion& motion, double factor, double duration, ProgressScope* progress = nullptr);

}  // namespace bahnwerk
