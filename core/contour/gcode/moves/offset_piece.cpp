#include "core/contour/gcode/moves/offset_piece.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bahnwerk::gcode {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double rounding = 1e-9;  // mm, rad: what is that little before an end is the end

/// Reduces to [0, 2π); a value below 2π by rounding counts as 0.
double wrapped(double angle) {
  angle = std::fmod(angle, turn);
  if (angle < 0) angle += turn;
  return angle > turn - rounding ? 0 : angle;
}

double angle_of(Vec v) { return std::atan2(v.y, v.x); }

struct Crossings {
  std::array<Vec, 2> at;
  std::size_t count = 0;
  void add(Vec p) { at[count++] = p; }
};

Crossings line_line(const OffsetPiece& a, const OffsetPiece& b) {
  Crossings result;
  const Vec u = a.direction_to, v = b.direction_from, gap = b.from - a.to;
  const double area = u.x * v.y - u.y * v.x;
  if (area != 0) result.add(a.to + ((gap.x * v.y - gap.y * v.x) / area) * u);
  return result;
}

Crossings line_circle(Vec point, Vec direction, Vec centre, double radius) {
  Crossings result;
  const double foot = dot(centre - point, direction);
  const Vec nearest = point + foot * direction;
  const double distance = norm(centre - nearest), room = (radius - distance) * (radius + distance);
  if (room < 0) return result;
  const double half = std::sqrt(room);
  result.add(nearest + half * direction);
  result.add(nearest - half * direction);
  return result;
}

Crossings circle_circle(Vec p, double r, Vec q, double s) {
  Crossings result;
  const Vec way = q - p;
  const double apart = norm(way);
  if (!(apart > 0)) return result;
  const double along = 0.5 * (apart + (r - s) * (r + s) / apart), room = (r - along) * (r + along);
  if (room < 0) return result;
  const Vec u = way / apart, foot = p + along * u, aside = std::sqrt(room) * left_of(u);
  result.add(foot + aside);
  result.add(foot - aside);
  return result;
}

/// Returns the length of the piece behind a point of it, mm.
double behind(const OffsetPiece& piece, Vec at) {
  if (!piece.arc) return dot(piece.to - at, piece.direction_to);
  return piece.radius * wrapped(piece.sense * (angle_of(piece.to - piece.centre) - angle_of(at - piece.centre)));
}
double before(const OffsetPiece& piece, Vec at) {
  if (!piece.arc) return dot(at - piece.from, piece.direction_from);
  return piece.radius * wrapped(piece.sense * (angle_of(at - piece.centre) - angle_of(piece.from - piece.centre)));
}

}  // namespace

Vec turned(Vec v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y, 0};
}

void OffsetPiece::trim_begin(double by, Vec at) {
  length = std::max(0.0, length - by);
  if (arc) sweep = radius > 0 ? length / radius : 0;
  from = at;
}

void OffsetPiece::trim_end(double by, Vec at) {
  length = std::max(0.0, length - by);
  if (arc) sweep = radius > 0 ? length / radius : 0;
  to = at;
}

OffsetPiece offset_line(Vec from, Vec to, double aside) {
  from.z = to.z = 0;
  OffsetPiece piece;
  piece.corner_from = from;
  piece.corner_to = to;
  piece.length = norm(to - from);
  piece.direction_from = piece.direction_to = (to - from) / piece.length;
  piece.from = from + aside * left_of(piece.direction_from);
  piece.to = to + aside * left_of(piece.direction_to);
  return piece;
}

std::optional<OffsetPiece> offset_arc(const PlaneArc& arc, double aside, double slack) {
  auto [from, to, centre, sense, sweep] = arc;
  from.z = to.z = centre.z = 0;
  OffsetPiece piece;
  const double radius = norm(from - centre), left = radius - sense * aside;
  if (!(left >= -slack)) return std::nullopt;
  piece.arc = true;
  piece.corner_from = from;
  piece.corner_to = to;
  piece.centre = centre;
  piece.radius = left > slack ? left : 0;
  piece.sense = sense;
  piece.sweep = sweep;
  piece.length = piece.radius * sweep;
  const Vec spoke_from = (from - centre) / radius, spoke_to = (to - centre) / norm(to - centre);
  piece.direction_from = sense * left_of(spoke_from);
  piece.direction_to = sense * left_of(spoke_to);
  piece.from = centre + piece.radius * spoke_from;
  piece.to = centre + piece.radius * spoke_to;
  return piece;
}

std::optional<Meeting> meeting(const OffsetPiece& first, const OffsetPiece& second, double slack) {
  const Crossings crossings = !first.arc && !second.arc ? line_line(first, second)
                              : !first.arc ? line_circle(first.to, first.direction_to, second.centre, second.radius)
                              : !second.arc
                                  ? line_circle(second.from, second.direction_from, first.centre, first.radius)
                                  : circle_circle(first.centre, first.radius, second.centre, second.radius);
  std::optional<Meeting> best;
  for (std::size_t i = 0; i < crossings.count; ++i) {
    const Vec at = crossings.at[i];
    const Meeting here{at, behind(first, at), before(second, at)};
    if (here.before < -rounding || here.before > first.length + slack) continue;
    if (here.behind < -rounding || here.behind > second.length + slack) continue;
    if (!best || here.before + here.behind < best->before + best->behind) best = here;
  }
  return best;
}

}  // namespace bahnwerk::gcode
