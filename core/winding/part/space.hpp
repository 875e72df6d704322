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
/// About the part's axis, counterclockwise seen from above. Many points are turned by the same angle.
struct Rotation {
  double cosine = 1, sine = 0;
  explicit Rotation(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}
};
inline Space turned(Space a, const Rotation& by) {
  return {by.cosine * a.x - by.sine * a.y, by.sine * a.x + by.cosine * a.y, a.z};
}
inline Space turned(Space a, double angle) { return turned(a, Rotation(angle)); }
inline double azimuth(Space a) { return std::atan2(a.y, a.x); }
/// Horizontally away from the part's axis, of unit length.
inline Space radial(double azimuth) { return {std::cos(azimuth), std::sin(azimuth), 0}; }

}  // namespace bahnwerk::winding
