#pragma once
/// The profiles with which a feed changes from one constant speed to another [Herrmann 3.3.1], one row of a table each.
/// A new profile is a new row.
///
/// A rise increases the speed by a height h from acceleration 0 to acceleration 0; a fall is its mirror image in time.
/// All profiles are symmetric about their middle, so the distance is duration · (mean of both speeds), and they scale:
/// λ times the acceleration with λ² times the jerk limit gives the change in 1/λ of the time.
///
/// - double_s: jerk J, 0, −J, without a phase of constant acceleration where h < A²/J [(3.96)–(3.101); the printed
///   branches for slowing down and the reduced cases are wrong].
/// - trapezoid: constant acceleration A, which jumps at both ends; jerk is not limited [(3.93), (3.94)].
/// - trigonometric: half a cosine wave, long enough for both A and J; the source uses one of them [(3.102)–(3.105)]. A
///   law is made of polynomials, so it consists of 16 cubics of the speed that have speed and acceleration in common
///   with the wave at their ends: they are 2e-6 h off, their acceleration is no larger, and they hold J themselves.
#include <array>
#include <cstddef>
#include <span>

#include "core/base/named.hpp"

namespace bahnwerk {

/// The profiles by name.
enum class SpeedProfile { double_s, trapezoid, trigonometric };
inline constexpr Named<SpeedProfile> speed_profiles[] = {{SpeedProfile::double_s, "double_s"},
                                                         {SpeedProfile::trapezoid, "trapezoid"},
                                                         {SpeedProfile::trigonometric, "trigonometric"}};

/// A piece of a rise: v(τ) = v + a τ + j τ²/2 + snap τ³/6 above the lower speed, mm/s, over τ ∈ [0, duration].
struct RisePiece {
  double duration = 0, v = 0, a = 0, j = 0, snap = 0;
};

/// A rise as consecutive pieces.
struct Rise {
  std::array<RisePiece, 16> piece{};
  std::size_t count = 0;
  double height = 0, duration = 0;  ///< mm/s, s
  double acceleration = 0;          ///< peak acceleration, mm/s²
  std::span<const RisePiece> pieces() const { return {piece.data(), count}; }
  /// Returns the distance of the rise from speed `low`, or of the fall down to it, mm.
  double distance(double low) const { return duration * (low + height / 2); }
};

/// A row of the table of profiles.
struct SpeedProfileRow {
  SpeedProfile profile;
  int order;  ///< highest derivative that stays within its limit: 2, or 3, where acceleration is continuous
  /// Returns the fastest rise of this profile by `height` ≥ 0 within acceleration (mm/s²) and jerk (mm/s³), both
  /// positive, one of them finite; acceleration has to be finite for a profile of order 2.
  Rise (*rise)(double height, double acceleration, double jerk);
};

/// Returns the row of a profile. Throws std::logic_error for a profile without one.
const SpeedProfileRow& speed_profile_row(SpeedProfile profile);

}  // namespace bahnwerk
