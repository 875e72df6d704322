#pragma once
/// Arithmetic of points and directions in the part's coordinates, mm.
#include <cmath>

#include "core/winding/laying/laying_regions.hpp"

namespace bahnwerk::winding {

inline Space operator+(Space a, Space b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Space operator-(Space a, Space b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Space operator*(double k, Space a) { return {k * a.x, k * a.y, k * a.z}; }
inline double dot(Space a, Space b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Space cross(Space a, Space b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(Space a) { return std::sqrt(dot(a, a)); }
/// Turned about the part's axis, counterclockwise seen from above.
inline Space turned(Space a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * a.x - s * a.y, s * a.x + c * a.y, a.z};
}
inline double azimuth(Space a) { return std::atan2(a.y, a.x); }
/// Horizontally away from the part's axis, of unit length.
inline Space radial(double azimuth) { return {std::cos(azimuth), std::sin(azimuth), 0}; }

}  // namespace bahnwerk::winding
