#include "core/winding/drawing/clearance_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/drawing/svg.hpp"
#include "core/winding/drawing/legend.hpp"
#include "core/winding/drawing/region_path.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double margin = 24, title_height = 64, scale = 34, key_width = 190;  // px, px per mm
constexpr const char* touches = "#c1121f";
constexpr std::array<const char*, 6> steps{"#f6d55c", "#cddc6a", "#9ccc65", "#5fb870", "#2f9c7a", "#1f7a8c"};

/// Converts millimetres to pixels, y upwards.
struct Window {
  Box box;
  Point corner;
  Point operator()(Point p) const {
    return {corner.x + scale * (p.x - box.low.x), corner.y + scale * (box.high.y - p.y)};
  }
};

std::string rectangle(Point at, double width, double height, const std::string& more) {
  using svg::attribute;
  using svg::number;
  return "<rect" + attribute("x", number(at.x)) + attribute("y", number(at.y)) + attribute("width", number(width)) +
         attribute("height", number(height)) + " " + more + "/>\n";
}

std::string fill(const char* colour) { return std::string("fill=\"") + colour + "\""; }

const char* colour(double clearance, double most) {
  if (clearance < 0) return touches;
  const auto step = static_cast<std::size_t>(clearance / most * static_cast<double>(steps.size()));
  return steps[std::min(step, steps.size() - 1)];
}

/// Draws adjacent cells of one row and colour as one rectangle. The first and last rectangle of a row extend by one
/// cell, where the slot's outline clips them.
std::string cells(const ClearanceMap& map, const Window& window, double most) {
  std::string out;
  const auto inside = [&](std::size_t column, std::size_t row) {
    return column < map.columns && !std::isnan(map.at(column, row));
  };
  for (std::size_t row = 0; row < map.rows; ++row)
    for (std::size_t column = 0; column < map.columns;) {
      if (std::isnan(map.at(column, row))) {
        ++column;
        continue;
      }
      const char* const shade = colour(map.at(column, row), most);
      std::size_t end = column + 1;
      while (end < map.columns && !std::isnan(map.at(end, row)) && colour(map.at(end, row), most) == shade) ++end;
      const bool first = column == 0 || !inside(column - 1, row), last = !inside(end, row);
      const Point corner =
          window(map.middle(column, row) + Point{first ? -1.5 * map.step : -map.step / 2, map.step / 2});
      const double cells = static_cast<double>(end - column + (first ? 1 : 0) + (last ? 1 : 0));
      out += rectangle(corner, scale * map.step * cells, scale * map.step * (row == 0 ? 2 : 1), fill(shade));
      column = end;
    }
  return out;
}

std::string format(const char* text, double a, double b = 0) {
  char out[80];
  std::snprintf(out, sizeof out, text, a, b);
  return out;
}

std::string key(Point at, double most) {
  std::string out;
  const auto entry = [&](const char* shade, const std::string& words) {
    out += rectangle({at.x, at.y - 11}, 22, 14, fill(shade) + " stroke=\"#4a525c\" stroke-width=\"0.6\"");
    out += svg::text({at.x + 30, at.y + 1}, words, "font-size=\"12\" fill=\"#20242a\"");
    at.y += 22;
  };
  out += svg::text(at, "clearance in mm", "font-size=\"12\" fill=\"#20242a\"");
  at.y += 24;
  const double step = most / static_cast<double>(steps.size());
  for (std::size_t i = steps.size(); i-- > 0;)
    entry(steps[i], format("%.2f to %.2f", step * static_cast<double>(i), step * static_cast<double>(i + 1)));
  entry(touches, "does not fit");
  entry(look::liner, "stack");
  return out;
}

}  // namespace

std::string clearance_drawing(const StatorIron& iron, std::span<const DrawnClearance> maps, const std::string& title) {
  double most = 1e-3, left = 0, right = 1, high = 1;
  for (const DrawnClearance& drawn : maps) {
    for (const double value : drawn.map.values)
      if (value > most) most = value;
    left = std::min(left, drawn.map.low.x);
    right = std::max(right, drawn.map.low.x + drawn.map.step * static_cast<double>(drawn.map.columns));
    high = std::max(high, drawn.map.low.y + drawn.map.step * static_cast<double>(drawn.map.rows));
  }
  const Box box{{left - 0.7, -0.7}, {right + 0.7, high + 1.4}};
  const double wide = scale * (box.high.x - box.low.x), tall = scale * (box.high.y - box.low.y);
  const double width = 2 * margin + static_cast<double>(maps.size()) * (wide + margin) + key_width;
  std::string out = svg::open(width, 2 * margin + title_height + tall);
  out += svg::text({margin, margin + 6}, title, "font-size=\"16\" fill=\"#20242a\"");
  double x = margin;
  std::size_t number = 0;
  for (const DrawnClearance& drawn : maps) {
    const Window window{box, {x, margin + title_height}};
    const std::string id = "slot" + std::to_string(number++);
    out += svg::text({x, margin + 34}, drawn.title, "fill=\"#20242a\"");
    out += svg::text({x, margin + 53}, format("%.0f %% of the slot accessible", 100 * drawn.map.share(0)),
                     "font-size=\"12\" fill=\"#4a525c\"");
    const std::string slot = "<path" + svg::attribute("d", region_path(iron.air(), window, scale));
    out += "<clipPath id=\"" + id + "\">" + rectangle(window.corner, wide, tall, "") + "</clipPath>\n";
    out += "<clipPath id=\"" + id + "_outline\">" + slot + "/></clipPath>\n";
    out += rectangle(window.corner, wide, tall, fill(look::liner));
    out += "<g clip-path=\"url(#" + id + ")\">\n";
    out += slot + " fill=\"#ffffff\"/>\n" + "<g clip-path=\"url(#" + id +
           "_outline)\" shape-rendering=\"crispEdges\">\n" + cells(drawn.map, window, most) + "</g>\n";
    out += slot + " fill=\"none\" stroke=\"" + look::outline + "\" stroke-width=\"1.6\"/>\n</g>\n";
    x += wide + margin;
  }
  return out + key({x, margin + title_height + 12}, most) + "</svg>\n";
}

}  // namespace bahnwerk::winding
