#include <algorithm>
#include <array>

#include "core/winding/drawing.hpp"
#include "core/winding/svg.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double margin = 24, title_height = 34;  // px
constexpr std::array layer_colours{"#e9c46a", "#8ab17d", "#7fb3d5", "#e8a07c", "#b39ddb", "#9fd3c7"};

/// Millimetres to pixels, y upwards.
struct Frame {
  Box box;
  double scale;
  Point operator()(Point p) const {
    return {margin + scale * (p.x - box.low.x), margin + title_height + scale * (box.high.y - p.y)};
  }
};

std::string outline(const Region& region, const Frame& frame) {
  std::string d;
  for (std::size_t i = 0; i < region.edges().size(); ++i) {
    const Edge& edge = region.edges()[i];
    const auto to = [&](const char* command, Point p) {
      const Point q = frame(p);
      return command + svg::number(q.x) + " " + svg::number(q.y);
    };
    if (region.begins_loop(i)) d += to("M", edge.from);
    // A path's arc must not be a whole circle: in two halves.
    for (const double f : edge.straight() ? std::vector{1.0} : std::vector{0.5, 1.0})
      d += edge.straight() ? to("L", edge.to)
                           : to(("A" + svg::number(frame.scale * edge.radius) + " " +
                                 svg::number(frame.scale * edge.radius) + " 0 0 " + (edge.turn > 0 ? "0 " : "1 "))
                                    .c_str(),
                                edge.at(f));
    const bool last = i + 1 == region.edges().size() || region.begins_loop(i + 1);
    if (last) d += "Z";
  }
  return d;
}

}  // namespace

std::vector<int> layers(const Region& room, double radius, std::span<const Point> wires) {
  // The base layer: what stands on a wall that looks up.
  std::vector<int> layer(wires.size(), -1);
  std::vector<std::size_t> queue;
  const double touch = 0.05 * radius;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    for (const Edge& edge : room.edges()) {
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

std::string slot_drawing(const Slot& slot, const DrawnWires& drawn) {
  const Box& box = slot.iron.box();
  const double wide = box.high.x - box.low.x, high = box.high.y - box.low.y;
  const Frame frame{box, std::min(640 / wide, 760 / high)};
  const double width = std::max(2 * margin + frame.scale * wide, 420.0);
  std::string out = svg::open(width, 2 * margin + title_height + frame.scale * high);
  out += svg::text({margin, margin + 4}, drawn.title, "fill=\"#20242a\"");
  out += "<path d=\"" + outline(slot.iron, frame) + "\" fill=\"#e6e9ed\" stroke=\"#4a525c\" stroke-width=\"1.6\"/>\n";
  out += "<path d=\"" + outline(slot.room, frame) + "\" fill=\"#ffffff\" stroke=\"#8a919b\" stroke-width=\"1\"/>\n";
  const std::vector<int> layer = layers(slot.room, drawn.radius, drawn.wires);
  const double size = std::min(0.75 * frame.scale * drawn.radius, 13.0);
  for (std::size_t i = 0; i < drawn.wires.size(); ++i) {
    const Point at = frame(drawn.wires[i]);
    const std::string colour =
        layer[i] < 0 ? "#d5d9de" : layer_colours[static_cast<std::size_t>(layer[i]) % layer_colours.size()];
    out += svg::circle(at, frame.scale * drawn.radius, "fill=\"#7a4a21\" fill-opacity=\"0.35\"");
    out += svg::circle(at, frame.scale * drawn.copper / 2,
                       "fill=\"" + colour + "\" stroke=\"#7a4a21\" stroke-width=\"0.6\"");
    if (size > 5)
      out += svg::text({at.x, at.y + 0.36 * size}, std::to_string(i + 1),
                       "text-anchor=\"middle\" fill=\"#20242a\" font-size=\"" + svg::number(size) + "\"");
  }
  for (const std::size_t i : drawn.slipping) {
    const Point at = frame(drawn.wires[i]);
    const double r = 0.62 * frame.scale * drawn.radius;
    const std::string red = "stroke=\"#c1121f\" stroke-width=\"2\" fill=\"none\"";
    out += svg::circle(at, frame.scale * drawn.radius - 1, red);
    out +=
        svg::segment(at - Point{r, r}, at + Point{r, r}, red) + svg::segment(at + Point{-r, r}, at + Point{r, -r}, red);
  }
  return out + "</svg>\n";
}

}  // namespace bahnwerk::winding
