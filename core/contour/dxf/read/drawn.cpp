#include "core/contour/dxf/read/drawn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/geometry/curve/nurbs.hpp"

namespace bahnwerk {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

Vec unit(Vec v) {
  const double length = norm(v);
  return length > 0 ? v / length : Vec{};
}

/// Returns d p/dφ in the direction of travel.
Vec tangent(const DrawnArc& arc, double angle) {
  const Vec d = std::cos(angle) * arc.b - std::sin(angle) * arc.a;
  return unit(arc.sweep < 0 ? -d : d);
}

/// Returns the end direction of a spline: its derivative, or where that vanishes the direction to the first point that
/// differs.
Vec end_direction(const std::vector<Vec>& points, Vec derivative, double scale, bool at_end) {
  if (norm(derivative) > 1e-9 * scale) return unit(derivative);
  const Vec end = at_end ? points.back() : points.front();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec way = at_end ? end - points[points.size() - 1 - i] : points[i] - end;
    if (norm(way) > 1e-9 * scale) return unit(way);
  }
  return {};
}

double polygon(const std::vector<Vec>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += norm(points[i] - points[i - 1]);
  return sum;
}

bool usable(Vec v) {
  constexpr double largest = 1e9;  // false for NaN too
  return std::abs(v.x) <= largest && std::abs(v.y) <= largest && std::abs(v.z) <= largest;
}

}  // namespace

bool DrawnArc::circular() const {
  const double m = norm(a), n = norm(b);
  return std::abs(m - n) <= 1e-9 * m && std::abs(dot(a, b)) <= 1e-9 * m * n;
}

DrawnSpline drawn_spline(std::size_t degree, std::vector<Vec> points, std::vector<double> weights,
                         std::vector<double> knots) {
  DrawnSpline s{degree, std::move(points), std::move(weights), std::move(knots), {}, {}, {}, {}};
  const Nurbs curve(s.degree, s.points, s.weights, s.knots);
  const Jet first = curve.at(curve.begin()), last = curve.at(curve.end());
  const double range = curve.end() - curve.begin(), scale = polygon(s.points);
  s.from = first.value;
  s.to = last.value;
  s.from_direction = end_direction(s.points, range * first.d1, scale, false);
  s.to_direction = end_direction(s.points, range * last.d1, scale, true);
  return s;
}

DrawnSpline drawn_spline(const DrawnArc& arc) {
  const double quarter = std::numbers::pi / 2;
  const auto n = static_cast<std::size_t>(std::clamp(std::ceil(std::abs(arc.sweep) / quarter - 1e-9), 1.0, 4.0));
  const double step = arc.sweep / static_cast<double>(n), weight = std::cos(step / 2);
  DrawnSpline s;
  s.degree = 2;
  s.points.push_back(arc.at(arc.start));
  s.weights.push_back(1);
  s.knots = {0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const double middle = arc.start + (static_cast<double>(i) + 0.5) * step;
    const double end = arc.start + static_cast<double>(i + 1) * step, u = static_cast<double>(i + 1);
    s.points.push_back(arc.centre + (std::cos(middle) * arc.a + std::sin(middle) * arc.b) / weight);
    s.points.push_back(arc.at(end));
    s.weights.insert(s.weights.end(), {weight, 1});
    s.knots.insert(s.knots.end(), {u, u});
  }
  s.knots.push_back(static_cast<double>(n));
  s.from = s.points.front();
  s.to = s.points.back();
  s.from_direction = tangent(arc, arc.start);
  s.to_direction = tangent(arc, arc.start + arc.sweep);
  return s;
}

Vec first_point(const Drawn& curve) {
  return std::visit(Overloaded{[](const DrawnArc& c) { return c.at(c.start); }, [](const auto& c) { return c.from; }},
                    curve);
}

Vec last_point(const Drawn& curve) {
  return std::visit(
      Overloaded{[](const DrawnArc& c) { return c.at(c.start + c.sweep); }, [](const auto& c) { return c.to; }}, curve);
}

Vec first_direction(const Drawn& curve) {
  return std::visit(Overloaded{[](const DrawnLine& c) { return unit(c.to - c.from); },
                               [](const DrawnArc& c) { return tangent(c, c.start); },
                               [](const DrawnSpline& c) { return c.from_direction; }},
                    curve);
}

Vec last_direction(const Drawn& curve) {
  return std::visit(Overloaded{[](const DrawnLine& c) { return unit(c.to - c.from); },
                               [](const DrawnArc& c) { return tangent(c, c.start + c.sweep); },
                               [](const DrawnSpline& c) { return c.to_direction; }},
                    curve);
}

double extent(const Drawn& curve) {
  return std::visit(Overloaded{[](const DrawnLine& c) { return norm(c.to - c.from); },
                               // |a cos φ + b sin φ| ≤ hypot(|a|, |b|), and |a| for a circle
                               [](const DrawnArc& c) {
                                 return std::abs(c.sweep) *
                                        (c.circular() ? norm(c.a) : std::hypot(norm(c.a), norm(c.b)));
                               },
                               [](const DrawnSpline& c) { return polygon(c.points); }},
                    curve);
}

Vec point_at(const Drawn& curve, double share) {
  return std::visit(Overloaded{[&](const DrawnLine& c) { return c.from + share * (c.to - c.from); },
                               [&](const DrawnArc& c) { return c.at(c.start + share * c.sweep); },
                               [&](const DrawnSpline& c) {
                                 const Nurbs n(c.degree, c.points, c.weights, c.knots);
                                 return n.at(n.begin() + share * (n.end() - n.begin())).value;
                               }},
                    curve);
}

double rise(const Drawn& curve) {
  return std::visit(Overloaded{[](const DrawnLine& c) { return std::abs(c.to.z - c.from.z); },
                               [](const DrawnArc& c) { return 2 * std::hypot(c.a.z, c.b.z); },
                               [](const DrawnSpline& c) {
                                 const auto [low, high] =
                                     std::minmax_element(c.points.begin(), c.points.end(),
                                                         [](const Vec& p, const Vec& q) { return p.z < q.z; });
                                 return high->z - low->z;
                               }},
                    curve);
}

bool within_range(const Drawn& curve) {
  return std::visit(
      Overloaded{[](const DrawnLine& c) { return usable(c.from) && usable(c.to); },
                 [](const DrawnArc& c) {
                   return usable(c.centre) && usable(c.a) && usable(c.b) && usable(c.centre + c.a) &&
                          usable(c.centre + c.b) && usable(c.centre - c.a) && usable(c.centre - c.b);
                 },
                 [](const DrawnSpline& c) { return std::all_of(c.points.begin(), c.points.end(), usable); }},
      curve);
}

Drawn reversed(Drawn curve) {
  std::visit(Overloaded{[](DrawnLine& c) { std::swap(c.from, c.to); },
                        [](DrawnArc& c) {
                          c.start += c.sweep;
                          c.sweep = -c.sweep;
                        },
                        [](DrawnSpline& c) {
                          std::reverse(c.points.begin(), c.points.end());
                          std::reverse(c.weights.begin(), c.weights.end());
                          std::reverse(c.knots.begin(), c.knots.end());
                          for (double& k : c.knots) k = -k;
                          std::swap(c.from, c.to);
                          c.from_direction = -std::exchange(c.to_direction, -c.from_direction);
                        }},
             curve);
  return curve;
}

Drawn mapped(const Affine& map, Drawn curve) {
  std::visit(Overloaded{[&](DrawnLine& c) {
                          c = {map.point(c.from), map.point(c.to)};
                        },
                        [&](DrawnArc& c) {
                          c.centre = map.point(c.centre);
                          c.a = map.direction(c.a);
                          c.b = map.direction(c.b);
                        },
                        [&](DrawnSpline& c) {
                          for (Vec& p : c.points) p = map.point(p);
                          c.from = map.point(c.from);
                          c.to = map.point(c.to);
                          c.from_direction = unit(map.direction(c.from_direction));
                          c.to_direction = unit(map.direction(c.to_direction));
                        }},
             curve);
  return curve;
}

}  // namespace bahnwerk
