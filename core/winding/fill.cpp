#include "core/winding/fill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace bahnwerk::winding {
namespace {

double circle(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

}  // namespace

double electrical_fill(std::size_t count, const Wire& wire, double slot_area) {
  return static_cast<double>(count) * circle(wire.copper) / slot_area;
}

double mechanical_fill(std::size_t count, const Wire& wire, double room_area) {
  return static_cast<double>(count) * circle(wire.outer) / room_area;
}

double shared_area(double radius, double distance) {
  if (distance >= 2 * radius) return 0;
  const double beta = std::acos(distance / (2 * radius));
  return 2 * (beta * radius * radius - distance / 2 * radius * std::sin(beta));
}

Overlaps overlaps(std::span<const Point> wires, double radius) {
  std::vector<Point> sorted(wires.begin(), wires.end());
  std::sort(sorted.begin(), sorted.end(), [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  Overlaps found;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t k = i + 1; k < sorted.size() && sorted[k].x - sorted[i].x < 2 * radius; ++k) {
      const double gap = distance(sorted[i], sorted[k]);
      if (gap >= 2 * radius) continue;
      found.deepest = std::max(found.deepest, 2 * radius - gap);
      found.area += shared_area(radius, gap);
    }
  return found;
}

Turns turns(std::size_t count, std::optional<std::size_t> serial, std::optional<std::size_t> parallel) {
  Turns t;
  if (serial && parallel) {
    t = {*serial, *parallel};
  } else if (serial) {
    t = {*serial, count / *serial};
  } else {
    t = {count / parallel.value_or(1), parallel.value_or(1)};
  }
  t.wires = t.serial * t.parallel;
  t.fits = t.wires > 0 && t.wires <= count;
  if (!t.fits) t.wires = 0;
  t.loss = t.fits ? 1 - static_cast<double>(t.wires) / static_cast<double>(count) : 0;
  return t;
}

double resistance_per_metre(const Wire& wire, std::size_t parallel, double temperature) {
  return (1 + 0.00393 * (temperature - 20)) / 58 / (static_cast<double>(parallel) * circle(wire.copper));
}

}  // namespace bahnwerk::winding
