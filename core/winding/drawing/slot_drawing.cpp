#include <algorithm>
#include <cmath>

#include "core/drawing/svg.hpp"
#include "core/winding/drawing/drawing.hpp"
#include "core/winding/drawing/legend.hpp"
#include "core/winding/drawing/region_path.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double margin = 24, title_height = 34;  // px

/// Converts millimetres to pixels, y upwards.
struct Frame {
  Box box;
  double scale;
  Point operator()(Point p) const {
    return {margin + scale * (p.x - box.low.x), margin + title_height + scale * (box.high.y - p.y)};
  }
};

}  // namespace

std::vector<int> layers(const Region& usable_area, double radius, std::span<const Point> wires) {
  // The base layer consists of the wires on a wall that faces up.
  std::vector<int> layer(wires.size(), -1);
  std::vector<std::size_t> queue;
  const double touch = 0.05 * radius;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    for (const Edge& edge : usable_area.edges()) {
      const Point up = wires[i] - edge.at(edge.nearest(wires[i]));
      if (norm(up) > radius + touch || up.y < 0.8 * norm(up)) continue;
      layer[i] = 0;
      queue.push_back(i);
      break;
    }
  }
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (std::size_t i = 0; i < wires.size(); ++i)
      if (layer[i] < 0 && distance(wires[i], wires[queue[k]]) < 2 * radius + touch) {
        layer[i] = layer[queue[k]] + 1;
        queue.push_back(i);
      }
  return layer;
}

std::vector<int> lattice_layers(double radius, double rows, std::span<const Point> wires) {
  const Point across{-std::sin(rows), std::cos(rows)};
  std::vector<int> layer;
  // Neighbouring rows of a triangular lattice lie √3 radii apart.
  for (const Point& wire : wires)
    layer.push_back(static_cast<int>(std::lround(dot(wire - wires.front(), across) / (std::sqrt(3.0) * radius))));
  const auto below = std::count_if(layer.begin(), layer.end(), [](int k) { return k < 0; });
  const bool turned = 2 * static_cast<std::size_t>(below) > wires.size();
  int least = 0;
  for (int& k : layer) least = std::min(least, k = turned ? -k : k);
  for (int& k : layer) k -= least;
  return layer;
}

namespace {

std::string filled(const Region& region, const Frame& frame, const char* fill, const char* stroke, const char* width) {
  if (region.empty()) return {};
  return "<path" + svg::attribute("d", region_path(region, frame, frame.scale)) + svg::attribute("fill", fill) +
         svg::attribute("stroke", stroke) + svg::attribute("stroke-width", width) + "/>\n";
}

/// Returns the strip of the opening between the slot's outline and its usable area, in which there is no liner. Where
/// the slot is no wider than its opening, the liner of the walls ends beside it.
Region mouth(const Slot& slot) {
  if (!slot.opening || !(slot.opening->cover > 0)) return {};
  const Opening& o = *slot.opening;
  const Point along = left_of(o.into), deep = o.cover * o.into;
  const auto end = [&](double side) {
    const bool wider = slot.iron.distance(o.middle + 0.5 * deep + side * (o.clear / 2 + 0.1 * o.cover) * along) > 0;
    return o.middle + side * std::max(0.1 * o.clear, o.clear / 2 - (wider ? 0 : o.cover)) * along;
  };
  const Point a = end(-1), b = end(1);
  return Region({line(a, a + deep), line(a + deep, b + deep), line(b + deep, b), line(b, a)});
}

/// Draws the opening between the tooth tips, and the tips.
std::string opening(const Slot& slot, const Frame& frame) {
  if (!slot.opening) return {};
  const Opening& o = *slot.opening;
  const Point along = left_of(o.into), half = 0.5 * o.clear * along;
  std::string out =
      svg::segment(frame(o.middle - half), frame(o.middle + half),
                   std::string("stroke=\"") + look::opening + "\" stroke-width=\"2\" stroke-dasharray=\"5 3\"");
  if (slot.type != Slot::Type::stator) return out;
  double wide = 0;  // width of the slot at its tooth tips
  for (const Edge& edge : slot.iron.edges())
    for (const Point p : {edge.from, edge.to})
      if (std::abs(dot(p - o.middle, o.into)) < 1e-6) wide = std::max(wide, std::abs(dot(p - o.middle, along)));
  const std::string thick = std::string("stroke=\"") + look::outline + "\" stroke-width=\"5\"";
  for (const double side : {-1.0, 1.0})
    if (wide > o.clear / 2)
      out += svg::segment(frame(o.middle + side * half), frame(o.middle + (side * wide) * along), thick);
  return out;
}

std::string ring(Point at, double radius, const char* colour) {
  return svg::circle(at, radius, std::string("stroke=\"") + colour + "\" stroke-width=\"2\" fill=\"none\"");
}

}  // namespace

std::string slot_drawing(const Slot& slot, const DrawnWires& wires) {
  DrawnWires drawn = wires;
  const Box& box = slot.iron.box();
  const double wide = box.high.x - box.low.x, high = box.high.y - box.low.y;
  const Frame frame{box, std::min(640 / wide, 760 / high)};
  const std::vector<int> layer = drawn.rows && !drawn.wires.empty()
                                     ? lattice_layers(drawn.radius, *drawn.rows, drawn.wires)
                                     : layers(slot.usable_area, drawn.radius, drawn.wires);
  const double size = std::min(0.75 * frame.scale * drawn.radius, 13.0);
  drawn.numbered = size > 5;
  const bool layerless = std::find(layer.begin(), layer.end(), -1) != layer.end();
  const double beside = 2 * margin + frame.scale * wide;
  const Legend key = legend(slot, drawn, layerless, {beside, margin + title_height + 12}, frame.scale);
  std::string out = svg::open(std::max(beside + legend_width, 480.0),
                              2 * margin + title_height + std::max(frame.scale * high, key.height));
  out += svg::text({margin, margin + 4}, drawn.title, "fill=\"#20242a\"");
  out += filled(slot.iron, frame, look::liner, look::outline, "1.6");
  out += filled(mouth(slot), frame, "#ffffff", "none", "0");
  out += filled(slot.taken, frame, look::taken, "#8a919b", "1");
  out += filled(slot.usable_area, frame, "#ffffff", "#8a919b", "1");
  out += filled(slot.wedge, frame, look::wedge, "#8a919b", "1");
  out += opening(slot, frame);
  for (std::size_t i = 0; i < drawn.wires.size(); ++i) {
    const Point at = frame(drawn.wires[i]);
    const std::string colour =
        layer[i] < 0 ? look::nowhere : look::layers[static_cast<std::size_t>(layer[i]) % look::layer_count];
    out +=
        svg::circle(at, frame.scale * drawn.radius, std::string("fill=\"") + look::enamel + "\" fill-opacity=\"0.35\"");
    out += svg::circle(at, frame.scale * drawn.copper / 2,
                       "fill=\"" + colour + "\" stroke=\"" + look::enamel + "\" stroke-width=\"0.6\"");
    if (drawn.numbered)
      out += svg::text({at.x, at.y + 0.36 * size}, std::to_string(i + 1),
                       "text-anchor=\"middle\" fill=\"#20242a\" font-size=\"" + svg::number(size) + "\"");
  }
  for (const std::size_t i : drawn.slipping) {
    const Point at = frame(drawn.wires[i]);
    const double r = 0.62 * frame.scale * drawn.radius;
    const std::string red = std::string("stroke=\"") + look::slips + "\" stroke-width=\"2\" fill=\"none\"";
    out += ring(at, frame.scale * drawn.radius - 1, look::slips);
    out +=
        svg::segment(at - Point{r, r}, at + Point{r, r}, red) + svg::segment(at + Point{-r, r}, at + Point{r, -r}, red);
  }
  if (drawn.unreached)
    out += ring(frame(drawn.wires[*drawn.unreached]), frame.scale * drawn.radius + 1, look::unreached);
  return out + key.svg + "</svg>\n";
}

}  // namespace bahnwerk::winding
