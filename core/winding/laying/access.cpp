#include "core/winding/laying/access.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/winding/margin.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Converts to coordinates with the origin in the opening's middle and y out of the slot.
struct Upright {
  Point middle, x, y;
  explicit Upright(const Opening& opening) : middle(opening.middle), x(left_of(opening.into)), y(-opening.into) {}
  Point operator()(Point p) const { return {dot(p - middle, x), dot(p - middle, y)}; }
};

struct Interval {
  double low = endless, high = -endless;
  void widen(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Returns the heights of the mouth on the upright line at `x` from which a disc of radius `reach` about `disc` lies
/// across the straight wire; all relative to the wire's place, which lies outside the disc. The hidden region is convex
/// and bounded by two tangents, from their points of contact on, and by the near side of the disc.
Interval hidden(Point disc, double reach, double x) {
  Interval at;
  const double away = norm(disc), touching = std::sqrt(away * away - reach * reach);
  const double c = touching / away, s = reach / away;
  const Point d = (1 / away) * disc;
  for (const double side : {-1.0, 1.0}) {
    const Point tangent{c * d.x - side * s * d.y, side * s * d.x + c * d.y};
    if (tangent.x * x > 0 && x / tangent.x >= touching) at.widen(x / tangent.x * tangent.y);
  }
  const double inside = reach * reach - (x - disc.x) * (x - disc.x);
  if (inside > 0) {
    at.widen(disc.y - std::sqrt(inside));
    at.widen(disc.y + std::sqrt(inside));
  }
  // Points far up or down the upright are seen along y.
  if (d.y > c) at.widen(endless);
  if (-d.y > c) at.widen(-endless);
  return at;
}

/// Tells whether any finite height from `low` to `high` is in none of the open intervals.
bool left_open(std::vector<Interval>& taken, double low, double high) {
  std::sort(taken.begin(), taken.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  for (const Interval& each : taken) {
    if (each.low >= low) break;
    low = std::max(low, each.high);
  }
  return low <= high && low < endless;
}

/// Returns the largest height of walls that face the opening, between two uprights and below the opening.
double floor_of(const Region& usable_area, const Upright& upright, const Opening& opening, double left, double right) {
  double highest = -endless;
  const double size = 1 + norm(usable_area.box().high - usable_area.box().low);
  const auto side = [&](double x) {
    const Point from = opening.middle + x * upright.x;
    return line(from - 2 * size * upright.y, from + size * upright.y);
  };
  const Edge sides[] = {side(left), side(right)};
  for (const Edge& edge : usable_area.edges()) {
    const auto consider = [&](double f) {
      const Point at = upright(edge.at(f));
      if (at.x >= left && at.x <= right && at.y < -fit_margin && dot(edge.direction(f), upright.x) > 1e-9)
        highest = std::max(highest, at.y);
    };
    consider(0);
    consider(1);
    if (!edge.straight()) consider(edge.nearest(edge.centre + edge.radius * upright.y));
    for (const Edge& wall : sides)
      for (const Meeting& m : meetings(wall, edge)) {
        const Point at = upright(edge.at(m.second));
        if (at.y < -fit_margin && dot(edge.direction(m.second), upright.x) > 1e-9) highest = std::max(highest, at.y);
      }
  }
  return highest;
}

}  // namespace

double bundle_diameter(std::size_t wires, double diameter) {
  using std::numbers::pi, std::numbers::sqrt2, std::numbers::sqrt3;
  const double five = std::sqrt(2 + 2 / std::sqrt(5.0));
  const double exact[] = {0, 1, 2, 1 + 2 / sqrt3, 1 + sqrt2, 1 + five, 3, 3};
  if (wires < std::size(exact)) return exact[wires] * diameter;
  // Centres lie in a circle of radius x diameters: n ≤ 2 π x²/√3 + π x + 1.
  const double a = 2 * pi / sqrt3, x = (std::sqrt(pi * pi + 4 * a * (static_cast<double>(wires) - 1)) - pi) / (2 * a);
  return std::max(3.0, 1 + 2 * x) * diameter;
}

std::vector<Obstruction> opening_obstructions(const Opening& opening, double radius,
                                              const std::optional<Needle>& needle) {
  std::vector<Obstruction> found;
  if (2 * radius > opening.clear + verify_margin)
    found.push_back({Obstruction::Part::wire, 2 * radius, opening.clear, 0});
  if (!needle) return found;
  const double clear = needle->stand == Needle::Stand::middle ? opening.clear : opening.clear / 2;
  if (needle->width > clear + verify_margin) found.push_back({Obstruction::Part::needle, needle->width, clear, 0});
  const double bundle = bundle_diameter(needle->wires, 2 * radius);
  if (bundle > needle->width - verify_margin) found.push_back({Obstruction::Part::bore, bundle, needle->width, 0});
  return found;
}

std::optional<std::size_t> first_out_of_reach(const Region& usable_area, const Opening& opening, const Needle& needle,
                                              const WiresToLay& wires, Progress progress) {
  const double radius = wires.radius;
  const Upright upright(opening);
  const double half = needle.width / 2;
  const double x = needle.stand == Needle::Stand::middle ? 0 : needle.stand == Needle::Stand::left ? -half : half;
  const double through =
      opening.clear / 2 - radius;               // largest distance from the middle at which a wire passes the opening
  const double face = -opening.cover - radius;  // height below which the tooth tips do not obstruct
  double tip = floor_of(usable_area, upright, opening, x - half + verify_margin, x + half - verify_margin);
  std::vector<Point> laid;
  std::vector<Interval> taken;
  for (const Point& wire : wires.places) {
    if (laid.size() % 64 == 0)
      progress.report("needle access", static_cast<double>(laid.size()) / static_cast<double>(wires.places.size()));
    const Point place = upright(wire);
    double highest = endless;
    if (std::abs(place.x) > through) {
      // Where the wire leaves the region under the tooth tips it must be within the clear opening.
      const double border = place.x > 0 ? through : -through;
      highest = face;
      if (through > 0 && (place.x > 0 ? x < border : x > border) && place.y < face)
        highest = place.y + (face - place.y) * (place.x - x) / (place.x - border);
    }
    taken.clear();
    for (const Point& other : laid) {
      const double reach = std::min(2 * radius * (1 - wires.touch), (1 - 1e-9) * distance(other, place));
      const Interval at = hidden(other - place, reach, x - place.x);
      if (at.low < at.high) taken.push_back({at.low + place.y, at.high + place.y});
    }
    if (!left_open(taken, tip, highest)) return laid.size();
    const double beside = std::abs(place.x - x) - half;
    if (beside < radius - verify_margin)
      tip = std::max(tip, place.y + (beside <= 0 ? radius : std::sqrt(radius * radius - beside * beside)));
    laid.push_back(place);
  }
  return std::nullopt;
}

}  // namespace bahnwerk::winding
