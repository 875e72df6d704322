#pragma once
/// Rotations about the axis of a part, in the part's coordinates, mm.
#include <cmath>

#include "core/winding/laying/laying_regions.hpp"

namespace bahnwerk::winding {

/// Rotation about the part's axis, counterclockwise seen from above; sine and cosine serve many points.
struct Rotation {
  double cosine = 1, sine = 0;
  explicit Rotation(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}
};
inline Vec3 turned(Vec3 a, const Rotation& by) {
  return {by.cosine * a.x - by.sine * a.y, by.sine * a.x + by.cosine * a.y, a.z};
}
inline Vec3 turned(Vec3 a, double angle) { return turned(a, Rotation(angle)); }
inline double azimuth(Vec3 a) { return std::atan2(a.y, a.x); }
/// Returns the horizontal unit vector away from the part's axis.
inline Vec3 radial(double azimuth) { return {std::cos(azimuth), std::sin(azimuth), 0}; }

}  // namespace bahnwerk::winding
