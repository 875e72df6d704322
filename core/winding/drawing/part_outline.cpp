#include "core/winding/drawing/part_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/winding/needle/rotor_obstacles.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

/// Lines of one slot or pole in the section; x runs along its middle from the axis.
using Section = std::vector<std::vector<Point>>;

void append(std::vector<Point>& line, const Edge& edge) {
  const int pieces = edge.straight() ? 1 : std::max(1, static_cast<int>(std::ceil(std::abs(edge.turn) / 0.3)));
  if (line.empty()) line.push_back(edge.from);
  for (int i = 1; i <= pieces; ++i) line.push_back(edge.at(static_cast<double>(i) / pieces));
}

/// Returns the lines of slots or poles `first` to `first` + `count` − 1 at both ends, and between them.
std::vector<Polyline3> repeated(const Section& section, int first, int count, double pitch, double low, double high) {
  std::vector<Polyline3> lines;
  const auto place = [](Point p, double angle, double z) { return turned({p.x, p.y, z}, angle); };
  for (int n = first; n < first + count; ++n)
    for (const double z : {low, high})
      for (const std::vector<Point>& line : section) {
        Polyline3 drawn;
        for (const Point p : line) drawn.push_back(place(p, n * pitch, z));
        lines.push_back(std::move(drawn));
        if (z != low) continue;
        for (const Point p : {line.front(), line.back()})
          lines.push_back({place(p, n * pitch, low), place(p, n * pitch, high)});
      }
  return lines;
}

/// Returns the outline without the circle about the axis, which the neighbours interrupt.
std::vector<Point> open_line(const Region& region, Point axis) {
  std::vector<Point> line;
  for (const Edge& edge : open_edges(region, axis)) append(line, edge);
  return line;
}

/// Returns the arc about the axis from the end of one line to the beginning of the next one, `pitch` further.
std::vector<Point> between(Point from, Point to, double pitch) {
  const double begin = std::atan2(from.y, from.x), way = std::atan2(to.y, to.x) + pitch - begin,
               round = 2 * std::numbers::pi, sweep = way - round * std::floor(way / round);
  std::vector<Point> line;
  const int pieces = std::max(1, static_cast<int>(std::ceil(sweep / 0.1)));
  for (int i = 0; i <= pieces; ++i)
    line.push_back(norm(from) * Point{std::cos(begin + sweep * i / pieces), std::sin(begin + sweep * i / pieces)});
  return line;
}

/// Returns the line of the slot at azimuth 0 and of the bore up to the next one.
Section section_of(const StatorPart& part, const Slot& slot) {
  const double axis = part.heads.base_radius;
  std::vector<Point> line = open_line(StatorIron(part, slot).air(), {0, axis});
  // Converts from slot coordinates and orders the points from negative to positive y.
  for (Point& p : line) p = {axis - p.y, p.x};
  if (line.front().y > line.back().y) std::reverse(line.begin(), line.end());
  return {line, between(line.back(), line.front(), part.pitch())};
}

/// Returns the line of the pole at azimuth 0 and of the hub up to the next one.
Section section_of(const RotorPart& part, const Slot& slot) {
  std::vector<Point> line = open_line(RotorIron(part, slot).iron(), {0, 0});
  if (line.front().y > line.back().y) std::reverse(line.begin(), line.end());
  return {line, between(line.back(), line.front(), part.pitch())};
}

double low(const StatorPart&) { return 0; }
double high(const StatorPart& part) { return part.heads.stack; }
double low(const RotorPart& part) { return -part.heads.cap_base; }
double high(const RotorPart& part) { return part.heads.stack + part.heads.cap_base; }

std::vector<SlotLabel> labels(int slots, double pitch, double first, Vec3 at, const std::vector<Coil>& coils) {
  std::vector<SlotLabel> list;
  for (int n = 0; n < slots; ++n) list.push_back({turned(at, first + n * pitch), n, false});
  for (const Coil& coil : coils)
    for (const int n : {coil.first, coil.first + coil.span})
      list[static_cast<std::size_t>(((n % slots) + slots) % slots)].marked = true;
  return list;
}

constexpr double label_distance = 0.1;  // of a slot's number beyond the part, as a share of the part's radius

}  // namespace

std::vector<Polyline3> part_outline(const StatorPart& part, const Slot& slot) {
  return repeated(section_of(part, slot), 0, part.slots, part.pitch(), low(part), high(part));
}

std::vector<Polyline3> part_outline(const RotorPart& part, const Slot& slot) {
  return repeated(section_of(part, slot), 0, part.poles, part.pitch(), low(part), high(part));
}

std::vector<Polyline3> coil_outline(const StatorPart& part, const Slot& slot, Coil coil) {
  const Section line{section_of(part, slot).front()};
  std::vector<Polyline3> lines = repeated(line, coil.first, 1, part.pitch(), low(part), high(part));
  for (Polyline3& each : repeated(line, coil.first + coil.span, 1, part.pitch(), low(part), high(part)))
    lines.push_back(std::move(each));
  return lines;
}

std::vector<Polyline3> coil_outline(const RotorPart& part, const Slot& slot, Coil coil) {
  const int pole = coil.span > 0 ? coil.first : coil.first - 1;
  return repeated({section_of(part, slot).front()}, pole, 1, part.pitch(), low(part), high(part));
}

std::vector<Polyline3> post_outline(const StatorPart& part, const ToolPost& post, Coil coil) {
  std::vector<Polyline3> lines;
  const double outer = part.heads.tool_radius, inner = outer - post.thickness, half = post.width / 2,
               shift = part.heads.tool_shift * (coil.span > 0 ? 1 : -1);
  for (const bool second : {false, true}) {
    const Rotation place((coil.first + (second ? coil.span : 0)) * part.pitch());
    const double at = second ? -shift : shift;
    const auto round = [&](double z) {
      Polyline3 line;
      for (const Point p : {Point{inner, at - half}, {outer, at - half}, {outer, at + half}, {inner, at + half}})
        line.push_back(turned({p.x, p.y, z}, place));
      line.push_back(line.front());
      return line;
    };
    for (const double low : {-post.height, part.heads.stack}) {
      const Polyline3 foot = round(low), top = round(low + post.height);
      for (std::size_t k = 0; k < 4; ++k) lines.push_back({foot[k], top[k]});
      lines.push_back(foot), lines.push_back(top);
    }
  }
  return lines;
}

std::vector<SlotLabel> slot_labels(const StatorPart& part, const std::vector<Coil>& coils) {
  const double radius = std::max(part.heads.base_radius, part.heads.tool_radius);
  return labels(part.slots, part.pitch(), 0, {(1 + label_distance) * radius, 0, high(part)}, coils);
}

std::vector<SlotLabel> slot_labels(const RotorPart& part, const std::vector<Coil>& coils) {
  const double radius = part.heads.tooth_radius + part.slot.base_width;
  return labels(part.poles, part.pitch(), -part.pitch() / 2, {(1 + label_distance) * radius, 0, high(part)}, coils);
}

}  // namespace bahnwerk::winding
