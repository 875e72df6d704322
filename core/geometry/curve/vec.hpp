#pragma once
/// Points and directions of space, mm. Planar curves have z = 0. Eigen's Vector3d is not used: its header alone adds 36
/// % to the compile time of every file that includes this one, and with its operators points of planar cubics take 1.5
/// times as long, setpoints of lines 1.1 times in the verifier.
#include <cmath>
#include <cstddef>

namespace bahnwerk {

/// A vector of space.
struct Vec {
  double x = 0, y = 0, z = 0;
  double& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  double operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
  friend bool operator==(const Vec&, const Vec&) = default;
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(Vec a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(double k, Vec a) { return {k * a.x, k * a.y, k * a.z}; }
inline Vec operator*(Vec a, double k) { return k * a; }
inline Vec operator/(Vec a, double k) { return {a.x / k, a.y / k, a.z / k}; }
inline Vec& operator+=(Vec& a, Vec b) { return a = a + b; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(Vec a) { return std::sqrt(dot(a, a)); }
/// Returns the angle between two directions, rad, accurate also for tiny angles.
inline double angle_between(Vec a, Vec b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

}  // namespace bahnwerk
