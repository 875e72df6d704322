#pragma once
/// Straight moves in closed form: a distance under limits on speed, acceleration, jerk and snap, from any start speed
/// to any end speed; acceleration (and jerk, if snap is limited) is zero at both ends.
///
/// - trapezoid: acceleration is limited; at most 3 pieces of constant acceleration;
/// - double-S: jerk is limited, too; at most 7 pieces of constant jerk;
/// - with a limit of snap: at most 15 pieces of constant snap.
///
/// Sources: [Herrmann 3.3.1] for the phases (formulas re-derived), [Thielemann] for the limit on snap.
///
/// The move changes speed from v0 to a turning speed w, holds w, and changes to v1. A change takes the distance D(x,y)
/// = T(|x−y|)(x+y)/2 (core/motion/profile/profile_change.hpp). The distance without hold, D(v0,w) + D(w,v1), grows with
/// w ≥ max(v0,v1), so w is the speed limit or the root. A distance below that of the direct change, D(v0,v1), requires
/// a *dip*, w < min(v0,v1). The distance is concave in w there (between the points at which the formula of T changes),
/// hence the least one is that of w = 0 or of the direct change, and the root can be enclosed.
///
/// Trapezoid and double-S are the fastest of all motions with 0 ≤ v ≤ V under their limits: for given T the distance is
/// a linear function under linear constraints, and the switching parabola of the phases is feasible in the dual problem
/// with an equal value. Snap-limited moves are the fastest of this form, in which jerk vanishes at the turning speed.
/// Where the speed limit is not reached, another form is up to 7.5 % faster, from rest to rest with snap alone limited
/// (384^¼ against 512^¼ (L/S)^¼).
///
/// Cost: no allocation; ≈ 0.1 µs trapezoid, 0.3 µs double-S, 0.5 µs snap-limited. Accuracy: a few roundings of the
/// distance and speeds.
#include <array>
#include <cstddef>
#include <span>

#include "core/machine/machine.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// State of a move: mm, mm/s, mm/s², mm/s³, mm/s⁴.
struct ProfileState {
  double s = 0, v = 0, a = 0, j = 0, snap = 0;
};

/// A piece of constant snap over τ = t − t0 ∈ [0, duration], from the given state.
struct ProfilePiece {
  double t0 = 0, duration = 0;
  double s = 0, v = 0, a = 0, j = 0, snap = 0;

  ProfileState at(double tau) const {
    return {s + tau * (v + tau * (a / 2 + tau * (j / 6 + tau * snap / 24))),
            v + tau * (a + tau * (j / 2 + tau * snap / 6)), a + tau * (j + tau * snap / 2), j + tau * snap, snap};
  }
};

/// A straight move.
struct Profile {
  std::array<ProfilePiece, 15> piece{};
  std::size_t count = 0;
  double distance = 0, duration = 0;      ///< mm, s
  double start_speed = 0, end_speed = 0;  ///< mm/s
  double turning_speed = 0;               ///< w, mm/s
  double peak_speed = 0;                  ///< mm/s
  double peak_acceleration = 0;           ///< largest |a|, mm/s²
  double peak_jerk = 0;                   ///< largest |j|, mm/s³; infinite where the acceleration jumps

  std::span<const ProfilePiece> pieces() const { return {piece.data(), count}; }
  /// Returns the state just after t, clamped to the move; from `duration` on exactly {distance, end_speed, 0, 0, 0}.
  ProfileState sample(double t) const;
};

/// Returns the fastest move over `distance` (mm, ≥ 0) within limits, each of them positive or infinite, and one of
/// acceleration, jerk and snap finite. Throws InvalidInput for invalid limits, distances or speeds,
/// Infeasible when the distance is shorter than min_distance() (by more than 1e-12 of it); its text has the numbers.
/// The duration is continuous in all arguments as long as distance ≥ direct_distance(), and jumps up below.
Profile straight_profile(double distance, double start_speed, double end_speed, const Limits& limits);

/// Returns the distance of the fastest change of speed, mm. Throws InvalidInput.
double direct_distance(double start_speed, double end_speed, const Limits& limits);
/// Returns the shortest distance of a straight_profile, mm: at most the direct one. Throws InvalidInput.
double min_distance(double start_speed, double end_speed, const Limits& limits);

/// Appends the move as pieces of path segment `segment`, starting at path length `begin` (mm).
void append(TimeLaw& law, const Profile& profile, double begin, std::size_t segment);

}  // namespace bahnwerk
