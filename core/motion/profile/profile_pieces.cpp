#include "core/motion/profile/profile_pieces.hpp"

#include <algorithm>

namespace bahnwerk {
namespace {

/// A change upwards from its lower speed, s and t from 0.
struct Rise {
  std::array<ProfilePiece, 7> piece;
  std::array<ProfileState, 7> end;  // state at the end of each piece
  std::size_t count = 0;
  double duration = 0, distance = 0;
};

Rise rise_from(double speed, const SpeedChange& c, double snap) {
  Rise rise;
  ProfileState at{0, speed, 0, 0, 0};
  // Acceleration and jerk where phases meet are known: taken as such instead of integrated.
  auto add = [&](double duration, double a, double a_end, double j, double j_end, double s4) {
    if (!(duration > 0)) return;
    const ProfilePiece p{rise.duration, duration, at.s, at.v, a, j, s4};
    at = p.at(duration);
    at.a = a_end;
    at.j = j_end;
    rise.piece[rise.count] = p;
    rise.end[rise.count++] = at;
    rise.duration += duration;
  };
  const double a = c.acceleration, j = c.jerk, ramp_gain = c.ramp * j / 2;  // bend: what a ramp of the jerk gains
  if (c.ramp > 0) {
    add(c.ramp, 0, ramp_gain, 0, j, snap);
    add(c.jerk_hold, ramp_gain, a - ramp_gain, j, j, 0);
    add(c.ramp, a - ramp_gain, a, j, 0, -snap);
    add(c.hold, a, a, 0, 0, 0);
    add(c.ramp, a, a - ramp_gain, 0, -j, -snap);
    add(c.jerk_hold, a - ramp_gain, ramp_gain, -j, -j, 0);
    add(c.ramp, ramp_gain, 0, -j, 0, snap);
  } else {
    add(c.jerk_hold, 0, a, j, j, 0);
    add(c.hold, a, a, 0, 0, 0);
    add(c.jerk_hold, a, 0, -j, -j, 0);
  }
  rise.distance = at.s;
  return rise;
}

void put(Profile& profile, ProfilePiece p) {
  p.t0 = profile.duration;
  profile.duration += p.duration;
  profile.piece[profile.count++] = p;
}

void put_up(Profile& profile, const Rise& rise, double begin) {
  for (std::size_t i = 0; i < rise.count; ++i) {
    ProfilePiece p = rise.piece[i];
    p.s += begin;
    put(profile, p);
  }
}

/// The rise run backwards: odd derivatives of the speed change sign.
void put_down(Profile& profile, const Rise& rise, double end) {
  for (std::size_t i = rise.count; i-- > 0;) {
    const ProfilePiece& p = rise.piece[i];
    const ProfileState& last = rise.end[i];
    put(profile, {0, p.duration, end - last.s, last.v, 0 - last.a, last.j, 0 - p.snap});
  }
}

}  // namespace

void lay_pieces(Profile& profile, const SpeedChange& first, const SpeedChange& second, const Limits& limits) {
  const double w = profile.turning_speed, v0 = profile.start_speed, v1 = profile.end_speed, length = profile.distance;
  profile.count = 0;
  profile.duration = 0;
  const Rise a = rise_from(std::min(v0, w), first, limits.snap), b = rise_from(std::min(w, v1), second, limits.snap);

  v0 <= w ? put_up(profile, a, 0) : put_down(profile, a, a.distance);
  const double left = length - a.distance - b.distance;
  // A hold shorter than the rounding of the distance is none.
  if (w == limits.velocity && left > 4e-16 * length) put(profile, {0, left / w, a.distance, w, 0, 0, 0});
  const std::size_t turn = profile.count;
  w <= v1 ? put_up(profile, b, length - b.distance) : put_down(profile, b, length);

  // States at the ends and at the turn are known exactly.
  if (profile.count > 0) {
    profile.piece[0].s = 0;
    profile.piece[0].v = v0;
  }
  if (turn > 0 && turn < profile.count) profile.piece[turn].v = w;
  profile.peak_speed = std::max({v0, w, v1});
  profile.peak_acceleration = std::max(first.acceleration, second.acceleration);
  profile.peak_jerk = std::max(first.jerk, second.jerk);
}

}  // namespace bahnwerk
