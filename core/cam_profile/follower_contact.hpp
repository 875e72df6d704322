#pragma once
/// Contact of cam and follower, written once for numbers, for derivatives and for enclosures.
///
/// f is the roller's centre (a flat follower: the point of contact) in the frame of the machine, p = R(−σφ) f in that
/// of the cam, σ = 1 for a cam that turns counterclockwise. Derivatives of p by φ are R(−σφ) D f, R(−σφ) D² f … with D
/// f = f′ − σ J f, J the quarter turn to the left. Curvatures are positive where the cam is convex.
///
///   translating   f = (e, √(r² − e²) + y)                tan α = (y′ − σe)/(√(r² − e²) + y)
///   oscillating   f = (d − l cos β, l sin β), β = β₀ + y  tan α = (l y′ − σ(d cos β − l))/(d sin β)
///   flat          f = (σy′, r + y)                        α = 0, radius of curvature r + y + y″
///   barrel        p = (r φ, y) in the unrolled plane      tan α = y′/r
///
/// r is the radius of the pitch curve at the lowest position: base radius + roller radius, for a flat follower the base
/// radius, for a barrel the cylinder's. [VDI 2142; Norton, 7; Rothbart, "Cam Design Handbook", 3]
#include <cmath>

#include "core/cam_profile/cam_geometry.hpp"
#include "core/cam_profile/follower_law.hpp"

namespace bahnwerk::cam {

template <class T>
struct Plane {
  T x, y;
};
template <class T>
Plane<T> operator+(const Plane<T>& a, const Plane<T>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class T>
Plane<T> operator*(const T& k, const Plane<T>& a) {
  return {k * a.x, k * a.y};
}

/// A radius of the pitch curve and what follows from it.
template <class S>
struct PitchSeat {
  const CamGeometry* geometry;
  S radius;
  S start;  ///< height of a translating follower, β₀ of an oscillating one; unused else
};
/// Undefined (not a number, or discs without a radius) where the follower does not reach the pitch circle.
template <class S>
PitchSeat<S> pitch_seat(const CamGeometry& g, const S& radius) {
  using std::acos, std::sqrt;
  PitchSeat<S> seat{&g, radius, radius};
  if (g.type == CamType::barrel) return seat;
  if (g.follower == FollowerType::translating) seat.start = sqrt(radius * radius - S(g.offset * g.offset));
  if (g.follower == FollowerType::oscillating)
    seat.start = acos((S(g.arm * g.arm + g.distance * g.distance) - radius * radius) / S(2 * g.arm * g.distance));
  return seat;
}

/// Series in φ. `first`, `second`: D f and D² f, known to order 2 and 1 (flat: 1 and 0).
template <class S>
struct PitchPoint {
  using T = LawSeries<S>;
  Plane<T> place, first, second;
  T along, across;  ///< tan α = along/across, across > 0
};

template <class S>
LawSeries<S> constant_series(const S& value) {
  LawSeries<S> out;
  out.c[0] = value;
  return out;
}

/// Returns D v.
template <class S>
Plane<LawSeries<S>> seen_from_cam(const Plane<LawSeries<S>>& v, double turn) {
  return {derived(v.x) + turn * v.y, derived(v.y) - turn * v.x};
}

/// A barrel's place.x is 0: r φ is added by who knows φ.
template <class S>
PitchPoint<S> pitch_point(const PitchSeat<S>& seat, const LawSeries<S>& y) {
  using T = LawSeries<S>;
  const CamGeometry& g = *seat.geometry;
  const double turn = g.turn();
  PitchPoint<S> out;
  if (g.type == CamType::barrel) {
    const T radius = constant_series(seat.radius);
    out.place = {T(0), y};
    out.first = {radius, derived(y)};
    out.second = {T(0), derived(derived(y))};
    out.along = derived(y), out.across = radius;
    return out;
  }
  switch (g.follower) {
    case FollowerType::translating:
      out.place = {T(g.offset), constant_series(seat.start) + y};
      break;
    case FollowerType::oscillating: {
      const auto [sine, cosine] = sine_cosine(constant_series(seat.start) + y);
      out.place = {T(g.distance) - g.arm * cosine, g.arm * sine};
      out.along = g.arm * derived(y) - turn * (g.distance * cosine - T(g.arm)), out.across = g.distance * sine;
      break;
    }
    case FollowerType::flat:
      out.place = {turn * derived(y), constant_series(seat.radius) + y};
      break;
  }
  out.first = seen_from_cam(out.place, turn), out.second = seen_from_cam(out.first, turn);
  if (g.follower == FollowerType::translating) out.along = out.first.y, out.across = turn * out.first.x;
  if (g.follower == FollowerType::flat) out.along = T(0), out.across = T(1);
  return out;
}

/// Returns the curvature of the pitch curve, 1/mm, known to order 1; a flat follower has none: use profile_radius().
/// A barrel's is positive where the groove turns towards +y.
template <class S>
LawSeries<S> pitch_curvature(const PitchSeat<S>& seat, const PitchPoint<S>& p) {
  const LawSeries<S> square = p.first.x * p.first.x + p.first.y * p.first.y;
  const LawSeries<S> turned = p.first.x * p.second.y - p.first.y * p.second.x;
  const double sign = seat.geometry->type == CamType::barrel ? 1 : -seat.geometry->turn();
  return (sign * turned) / (square * sqrt(square));
}

/// Returns the radius of curvature r + y + y″ of the profile under a flat follower, mm.
template <class S>
LawSeries<S> flat_profile_radius(const PitchSeat<S>& seat, const LawSeries<S>& y) {
  return constant_series(seat.radius) + y + derived(derived(y));
}

}  // namespace bahnwerk::cam
