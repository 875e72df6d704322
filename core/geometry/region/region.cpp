#include "core/geometry/region/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bahnwerk {
namespace {

void widen(Box& box, Point p) {
  box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
  box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
}

/// Extreme points of an arc beside its ends.
void widen(Box& box, const Edge& edge) {
  widen(box, edge.from);
  widen(box, edge.to);
  if (edge.straight()) return;
  for (const Point d : {Point{1, 0}, Point{-1, 0}, Point{0, 1}, Point{0, -1}})
    if (const Point p = edge.centre + edge.radius * d; distance(edge.at(edge.nearest(p)), p) < 1e-9) widen(box, p);
}

/// Tangents do not decide at the tip of a cusp: this returns whether the boundary turns left (+1) or right near it.
int cusp(const Edge& before, const Edge& after) {
  const Point tip = after.from;
  return cross(tip - before.at(0.99), after.at(0.01) - tip) > 0 ? 1 : -1;
}

}  // namespace

Region::Region(std::vector<Edge> edges) : edges_(std::move(edges)) {
  constexpr double far = std::numeric_limits<double>::max();
  box_ = {{far, far}, {-far, -far}};
  const std::size_t n = edges_.size();
  before_.resize(n);
  after_.resize(n);
  corner_.resize(n);
  for (std::size_t first = 0, i = 0; i < n; ++i) {
    widen(box_, edges_[i]);
    const bool closes =
        bahnwerk::distance(edges_[i].to, edges_[first].from) < 1e-6 && (i > first || !edges_[i].straight());
    if (!closes && (i + 1 == n || bahnwerk::distance(edges_[i].to, edges_[i + 1].from) > 1e-6))
      throw std::invalid_argument("a boundary does not close");
    const std::size_t next = closes ? first : i + 1;
    edges_[i].to = edges_[next].from;
    after_[i] = next;
    before_[next] = i;
    if (closes) first = i + 1;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Edge &before = edges_[before_[i]], &after = edges_[i];
    const double turn = cross(before.direction(1), after.direction(0));
    const bool back = dot(before.direction(1), after.direction(0)) < 0;
    corner_[i] = std::abs(turn) > 1e-9 ? (turn > 0 ? 1 : -1) : back ? cusp(before, after) : 0;
  }
  tree_ = EdgeTree(edges_);
  if (n == 0) box_ = {};
}

Region::Nearest Region::nearest(Point p) const {
  double best = std::numeric_limits<double>::max(), where = 0;
  std::size_t which = 0;
  tree_.near(p, best, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Edge& edge = edges_[i];
      // An arc is no nearer than its circle.
      if (!edge.straight()) {
        const double gap = bahnwerk::distance(p, edge.centre) - edge.radius;
        if (gap * gap > best) continue;
      }
      const double f = edge.nearest(p), d = square_distance(edge.at(f), p);
      if (d < best || (d == best && i < which)) {
        best = d;
        where = f;
        which = i;
      }
    }
  });
  const Edge& edge = edges_[which];
  Nearest found{std::sqrt(best), edge.at(where), left_of(edge.direction(where)), which};
  const Point d = p - found.at;
  const std::size_t vertex = where == 0 ? which : after_[which];
  const int corner = where == 0 || where == 1 ? corner_[vertex] : 0;
  // Nearest to a corner: inside where it juts into the region, outside where it does not.
  const bool inside = corner != 0 ? corner < 0 : dot(d, found.normal) >= 0;
  if (found.distance > 1e-12) found.normal = (inside ? 1 / found.distance : -1 / found.distance) * d;
  if (!inside) found.distance = -found.distance;
  return found;
}

double Region::area() const {
  double doubled = 0;
  for (const Edge& edge : edges_) doubled += edge.doubled_area();
  return doubled / 2;
}

double Region::length() const {
  double sum = 0;
  for (const Edge& edge : edges_) sum += edge.length();
  return sum;
}

}  // namespace bahnwerk
