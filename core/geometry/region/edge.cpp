#include "core/geometry/region/edge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bahnwerk {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

double angle_of(Point d) { return std::atan2(d.y, d.x); }

/// Fraction of an arc's turn at which it has the direction `d` from its centre; beyond 1 where it has not.
double arc_fraction(const Edge& arc, Point d) {
  double beyond = (arc.turn > 0 ? 1 : -1) * (angle_of(d) - angle_of(arc.from - arc.centre));
  while (beyond < 0) beyond += whole_turn;
  while (beyond >= whole_turn) beyond -= whole_turn;
  return beyond / std::abs(arc.turn);
}

/// Fraction of `edge` at a point that lies on its line or circle; −1 where the edge has ended.
double fraction_on(const Edge& edge, Point p) {
  const double slack = 1e-11 / std::max(edge.length(), 1e-11);
  if (edge.straight()) {
    const Point d = edge.to - edge.from;
    const double f = dot(p - edge.from, d) / dot(d, d);
    return f < -slack || f > 1 + slack ? -1 : std::clamp(f, 0.0, 1.0);
  }
  const double f = arc_fraction(edge, p - edge.centre);
  if (f <= 1 + slack) return std::min(f, 1.0);
  return whole_turn / std::abs(edge.turn) - f <= slack ? 0.0 : -1;  // the place is just before the begin
}

/// Points common to the lines and circles that carry two edges.
std::vector<Point> carriers_meet(const Edge& a, const Edge& b) {
  if (a.straight() && b.straight()) {
    const Point d = a.to - a.from, e = b.to - b.from;
    const double det = cross(d, e);
    if (std::abs(det) <= 1e-14 * norm(d) * norm(e)) return {};
    return {a.from + (cross(b.from - a.from, e) / det) * d};
  }
  if (a.straight()) {
    const Point u = unit(a.to - a.from), foot = a.from + dot(b.centre - a.from, u) * u;
    const double h = distance(foot, b.centre), inside = b.radius * b.radius - h * h;
    if (inside < 0) return {};
    const double half = std::sqrt(inside);
    return {foot - half * u, foot + half * u};
  }
  if (b.straight()) return carriers_meet(b, a);
  const Point d = b.centre - a.centre;
  const double span = norm(d);
  if (span <= 1e-14 * (a.radius + b.radius)) return {};
  const double along = (span * span + a.radius * a.radius - b.radius * b.radius) / (2 * span);
  const double inside = a.radius * a.radius - along * along;
  if (inside < 0) return {};
  const Point u = (1 / span) * d, foot = a.centre + along * u;
  const double half = std::sqrt(inside);
  return {foot - half * left_of(u), foot + half * left_of(u)};
}

}  // namespace

double Edge::length() const { return straight() ? distance(from, to) : radius * std::abs(turn); }

Point Edge::at(double fraction) const {
  if (fraction == 0) return from;
  if (fraction == 1) return to;
  if (straight()) return from + fraction * (to - from);
  const Point d = from - centre;
  const double c = std::cos(fraction * turn), s = std::sin(fraction * turn);
  return centre + Point{c * d.x - s * d.y, s * d.x + c * d.y};
}

Point Edge::direction(double fraction) const {
  if (straight()) return unit(to - from);
  const Point d = unit(at(fraction) - centre);
  return turn > 0 ? left_of(d) : -left_of(d);
}

double Edge::nearest(Point p) const {
  if (straight()) {
    const Point d = to - from;
    return std::clamp(dot(p - from, d) / dot(d, d), 0.0, 1.0);
  }
  const Point d = p - centre;
  if (d == Point{}) return 0;
  const double f = arc_fraction(*this, d);
  if (f <= 1) return f;
  return square_distance(p, from) <= square_distance(p, to) ? 0 : 1;
}

Edge Edge::part(double first, double last) const {
  Edge piece = *this;
  piece.from = at(first);
  piece.to = at(last);
  piece.turn = turn * (last - first);
  return piece;
}

Edge Edge::reversed() const {
  Edge back = *this;
  std::swap(back.from, back.to);
  back.turn = -turn;
  return back;
}

double Edge::doubled_area() const {
  const double chord = cross(from, to);
  return straight() ? chord : chord + radius * radius * (turn - std::sin(turn));
}

Edge line(Point from, Point to) { return {from, to, {}, 0, 0}; }

Edge arc(Point centre, double radius, double start, double turn) {
  const auto point = [&](double angle) { return centre + radius * Point{std::cos(angle), std::sin(angle)}; };
  return {point(start), point(start + turn), centre, radius, turn};
}

Edge arc_between(Point centre, Point from, Point to, bool counterclockwise) {
  double turn = angle_of(to - centre) - angle_of(from - centre);
  if (counterclockwise && turn < 0) turn += whole_turn;
  if (!counterclockwise && turn > 0) turn -= whole_turn;
  return {from, to, centre, distance(centre, from), turn};
}

Box extent(const Edge& edge, double more) {
  // An arc reaches over its chord by its rise at most, or is part of its circle.
  const bool wide = std::abs(edge.turn) > std::numbers::pi;
  const double rise = edge.straight() ? 0 : wide ? 2 * edge.radius : edge.radius * (1 - std::cos(edge.turn / 2));
  const Point a = edge.from, b = edge.to, around{rise + more, rise + more};
  return {Point{std::min(a.x, b.x), std::min(a.y, b.y)} - around,
          Point{std::max(a.x, b.x), std::max(a.y, b.y)} + around};
}

std::vector<Meeting> meetings(const Edge& a, const Edge& b) {
  std::vector<Meeting> found;
  for (const Point& p : carriers_meet(a, b)) {
    const double first = fraction_on(a, p), second = fraction_on(b, p);
    if (first >= 0 && second >= 0) found.push_back({first, second});
  }
  return found;
}

}  // namespace bahnwerk
