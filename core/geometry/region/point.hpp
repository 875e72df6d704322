#pragma once
/// Points of a slot's cross-section, mm: x along the slot's base, y from the base to the opening. Eigen's Vector2d is
/// not used: its header alone adds 63 % to the compile time of every file that includes this one.
#include <cmath>

namespace bahnwerk {

/// A point or a vector of the plane.
struct Point {
  double x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator-(Point a) { return {-a.x, -a.y}; }
inline Point operator*(double k, Point a) { return {k * a.x, k * a.y}; }
inline Point& operator+=(Point& a, Point b) { return a = a + b; }
inline Point& operator-=(Point& a, Point b) { return a = a - b; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double norm(Point a) { return std::sqrt(dot(a, a)); }
inline double square_distance(Point a, Point b) { return dot(a - b, a - b); }
inline double distance(Point a, Point b) { return norm(a - b); }
/// Returns the vector turned by a quarter turn to the left.
inline Point left_of(Point a) { return {-a.y, a.x}; }
/// Returns `a` scaled to length 1; (0, 1) if it has none.
inline Point unit(Point a) {
  const double length = norm(a);
  return length > 0 ? (1 / length) * a : Point{0, 1};
}

}  // namespace bahnwerk
