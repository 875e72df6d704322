#pragma once
/// Arithmetic of points and directions in the part's coordinates, mm.
#include <cmath>

#include "core/winding/laying/laying_regions.hpp"

namespace bahnwerk::winding {

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
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
