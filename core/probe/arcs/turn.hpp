#pragma once
/// A turn at a point [Thielemann, "Durchfahren der Stützstellen", corrected]. At constant speed along the tightest arc
/// the acceleration would jump where the arc begins; here the velocity goes from v d_in to v d_out by
///
///     v(t) = v [d_in + (d_out − d_in) σ(t)],
///
/// where σ is the quickest change from 0 to 1 (core/motion/profile/profile_change.hpp) under min_k L_k / (v |Δd_k|) for
/// L = acceleration, jerk, snap: every axis keeps its limits, |v(t)| ≤ v, all pieces are quartic in time, a = j = 0 at
/// both ends, in any dimension. The point is passed at half the time T. With ℓ = v T/2 and M = v ∫_0^(T/2) σ dt the
/// tangents of entry and exit meet at the apex C = P − M (d_out − d_in), ℓ before the exit and behind the entry.
/// Where d_out = −d_in the head reverses at the point itself.
#include "core/motion/profile/profile_change.hpp"
#include "core/probe/bezier.hpp"
#include "core/probe/problem.hpp"
#include "core/probe/straight/motion_writer.hpp"

namespace bahnwerk::probe {

struct TurnSize {
  double duration = 0;  ///< T, s
  double length = 0;    ///< ℓ, mm
  double moment = 0;    ///< M, mm
};

class Turn {
 public:
  /// The turn from direction `in` to `out`, unit vectors. Directions that differ by rounding alone make no turn: T = 0.
  Turn(const ProbeProblem& problem, Vec in, Vec out);

  bool any() const { return !(change_ == Vec{}); }  ///< whether directions change
  TurnSize size(double speed) const;                ///< size of the turn at `speed`, mm/s
  /// Returns the apex C of a turn at `point`.
  Vec apex(Vec point, const TurnSize& size) const { return point - size.moment * change_; }
  /// The edges from `before` to `point` and from there to `after`, and the radius of the tube about them, mm.
  struct Edges {
    Vec before, point, after;
    double tube;
  };
  /// Returns the largest distance of the first half from the first edge and of the second half from the second one,
  /// relative to the tube's radius, enclosed to 1e-6; `enough` if that is larger.
  double deviation(double speed, const Edges& edges, double enough) const;
  /// Appends the turn, which passes `point`, the problem's point of that number.
  void append(MotionWriter& writer, double speed, Vec point, std::size_t number) const;

 private:
  struct Phase {
    double duration;
    double gain, a, j, snap;  // speed at the begin: its change so far, and its derivatives
    double way;               // ∫ of the gain until its begin, mm
  };
  /// Writes the first half: up to four phases, the last of which may be half of one that the second half goes on with.
  std::size_t rise(double speed, std::array<Phase, 4>& phases) const;

  Vec in_, out_, change_;
  SpeedChangeLaw law_;
};

}  // namespace bahnwerk::probe
