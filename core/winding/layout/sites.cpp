#include "core/winding/layout/sites.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/winding/centre_borders.hpp"
#include "core/winding/margin.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double slack = fit_margin;
constexpr double on_edge = 1e-10;  // mm by which a point may miss the edge it belongs to
constexpr double equal = 1e-9;     // mm; smaller differences of cost are ties

/// Returns the points of `edge` at distance `reach` from `centre`, at most two.
template <class Found>
void at_reach(const Edge& edge, Point centre, double reach, Found found) {
  Point foot, along;
  double inside = 0;
  if (edge.straight()) {
    along = unit(edge.to - edge.from);
    foot = edge.from + dot(centre - edge.from, along) * along;
    inside = reach * reach - square_distance(foot, centre);
  } else {
    const Point d = edge.centre - centre;
    const double span = norm(d);
    if (span < 1e-12) return;
    const double k = (span * span + reach * reach - edge.radius * edge.radius) / (2 * span);
    foot = centre + (k / span) * d;
    along = left_of((1 / span) * d);
    inside = reach * reach - k * k;
  }
  if (inside < 0) return;
  const double half = std::sqrt(inside);
  for (const Point p : {foot - half * along, foot + half * along})
    if (distance(edge.at(edge.nearest(p)), p) <= on_edge) found(p);
}

}  // namespace

Sites::Sites(const Region& usable_area, double radius, Progress progress)
    : usable_area_(usable_area), radius_(radius), apart_(2 * radius) {
  CentreBorders found = centre_borders(usable_area, radius, progress);
  borders_ = std::move(found.pieces);
  corners_ = std::move(found.corners);
  const Point size = usable_area.box().high - usable_area.box().low;
  cell_ = std::max(apart_ + 2 * slack, std::max(size.x, size.y) / 2000);
  columns_ = 1 + static_cast<int>(size.x / cell_);
  rows_ = 1 + static_cast<int>(size.y / cell_);
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
}

namespace {

/// Indices are clamped, so that a point outside the usable area's box belongs to a cell at its rim.
int cell_at(double offset, double size, int cells) {
  return static_cast<int>(std::clamp(std::floor(offset / size), 0.0, static_cast<double>(cells - 1)));
}

}  // namespace

template <class Visit>
bool Sites::around(Point p, int reach, Visit visit) const {
  const int x = cell_at(p.x - usable_area_.box().low.x, cell_, columns_),
            y = cell_at(p.y - usable_area_.box().low.y, cell_, rows_);
  for (int row = std::max(0, y - reach); row <= std::min(rows_ - 1, y + reach); ++row)
    for (int column = std::max(0, x - reach); column <= std::min(columns_ - 1, x + reach); ++column)
      for (int i = first_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column)];
           i >= 0; i = next_[static_cast<std::size_t>(i)])
        if (!visit(wires_[static_cast<std::size_t>(i)])) return false;
  return true;
}

bool Sites::clear_of_wires(Point p) const {
  const double least = (apart_ - slack) * (apart_ - slack);
  return around(p, 1, [&](Point wire) { return square_distance(wire, p) >= least; });
}

bool Sites::in_room(Point centre) const {
  return !usable_area_.empty() && usable_area_.distance(centre) >= radius_ - slack;
}
bool Sites::free(Point centre) const { return clear_of_wires(centre) && in_room(centre); }

void Sites::open(Point corner) {
  if (clear_of_wires(corner)) corners_.push_back(corner);
}

void Sites::lay(Point centre) {
  const double least = (apart_ - slack) * (apart_ - slack);
  std::erase_if(corners_, [&](Point corner) { return square_distance(corner, centre) < least; });
  for (const Edge& border : borders_) at_reach(border, centre, apart_, [&](Point p) { open(p); });
  // Two circles of radius 2 r cross where a wire touches both of their wires.
  around(centre, 2, [&](Point wire) {
    const Point half = 0.5 * (wire - centre);
    const double offset = norm(half);
    if (offset > apart_ || offset == 0) return true;
    const double height = std::sqrt(apart_ * apart_ - offset * offset);
    const Point up = (height / offset) * left_of(half);
    for (const Point p : {centre + half + up, centre + half - up})
      if (clear_of_wires(p) && in_room(p)) corners_.push_back(p);
    return true;
  });
  const int x = cell_at(centre.x - usable_area_.box().low.x, cell_, columns_);
  const int y = cell_at(centre.y - usable_area_.box().low.y, cell_, rows_);
  int& head = first_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)];
  next_.push_back(head);
  head = static_cast<int>(wires_.size());
  wires_.push_back(centre);
}

template <class Cost>
std::optional<Point> Sites::best(Cost cost) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto* places : {&corners_, &feet_})
    for (const Point p : *places) least = std::min(least, cost(p));
  std::optional<Point> chosen;
  for (const auto* places : {&corners_, &feet_})
    for (const Point p : *places)
      if (cost(p) <= least + equal && (!chosen || p.x < chosen->x || (p.x == chosen->x && p.y < chosen->y))) chosen = p;
  return chosen;
}

std::optional<Point> Sites::nearest(Point p) {
  if (free(p)) return p;
  feet_.clear();
  for (const Edge& border : borders_) {
    const Point foot = border.at(border.nearest(p));
    if (clear_of_wires(foot)) feet_.push_back(foot);
  }
  // The circle's nearest point is a resting place only if `p` lies inside the circle around a wire.
  around(p, 1, [&](Point wire) {
    const Point d = p - wire;
    if (dot(d, d) >= apart_ * apart_) return true;
    const Point foot = wire + apart_ * unit(d);
    if (free(foot)) feet_.push_back(foot);
    return true;
  });
  return best([&](Point q) { return distance(q, p); });
}

std::optional<Point> Sites::least(Point direction) {
  feet_.clear();
  for (const Edge& border : borders_) {
    if (border.straight()) continue;
    const Point foot = border.at(border.nearest(border.centre - border.radius * direction));
    if (clear_of_wires(foot)) feet_.push_back(foot);
  }
  return best([&](Point q) { return dot(q, direction); });
}

}  // namespace bahnwerk::winding
