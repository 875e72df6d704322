#include "core/winding/drawing/path_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/drawing/path_lines.hpp"
#include "core/drawing/spline_points.hpp"
#include "core/drawing/svg.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double size = 860, margin = 24, title_height = 56, foot = 40, fine = 0.3;  // px
constexpr const char* curve_colour = "#1f5fbf";

/// Isometric projection: x and y lead down to the left and to the right, 30° below the horizontal; mm on paper, y
/// upwards.
Point isometric(Vec p) {
  const double c = std::sqrt(0.5), s = std::sqrt(1 / 6.0);
  return {c * (p.y - p.x), 2 * s * p.z - s * (p.x + p.y)};
}

struct View {
  Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  double scale = 1;
  void widen(Vec at) {
    const Point p = isometric(at);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void fit() {
    if (!(low.x <= high.x)) low = {0, 0}, high = {1, 1};
    scale = (size - 2 * margin) / std::max({high.x - low.x, high.y - low.y, 1e-6});
  }
  Point operator()(Vec at) const {
    const Point p = isometric(at);
    return {margin + scale * (p.x - low.x), margin + title_height + scale * (high.y - p.y)};
  }
};

std::string format(const char* text, double a) {
  char out[60];
  std::snprintf(out, sizeof out, text, a);
  return out;
}

/// Returns the opacity of turns before the last, so that many of them remain readable.
double faintness(std::size_t turns) {
  return turns <= 2 ? 0.7 : std::max(0.3, 1.6 / std::sqrt(static_cast<double>(turns)));
}

std::string drawn(const drawing::Thinned& lines, const char* colour, double width, double opacity = 1) {
  if (lines.data().empty()) return {};
  return "<path" + svg::attribute("transform", format("scale(%.9g)", lines.lattice())) +
         svg::attribute("d", lines.data()) + svg::attribute("stroke", colour) +
         svg::attribute("stroke-width", svg::number(width / lines.lattice())) +
         (opacity < 1 ? svg::attribute("stroke-opacity", format("%.3g", opacity)) : "") +
         " fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n";
}

/// Directions and drawn lengths of the axes.
std::string scale_bar(const View& view, double bottom) {
  const double power = std::pow(10, std::floor(std::log10(80 / view.scale))), left = 80 / view.scale / power,
               mm = power * (left >= 5   ? 5
                             : left >= 2 ? 2
                                         : 1);
  const Point origin{margin + 60, bottom - 44};
  std::string out;
  const std::array<std::pair<Vec, const char*>, 3> axes{{{{mm, 0, 0}, "x"}, {{0, mm, 0}, "y"}, {{0, 0, mm}, "z"}}};
  for (const auto& [axis, name] : axes) {
    const Point way = isometric(axis), end = origin + view.scale * Point{way.x, -way.y};
    out += svg::segment(origin, end, "stroke=\"#20242a\" stroke-width=\"1.2\"");
    out += svg::text(end + Point{4, 4}, name, "font-size=\"12\" fill=\"#20242a\"");
  }
  return out + svg::text(origin + Point{70, 4}, format("axes: %g mm", mm), "font-size=\"12\" fill=\"#20242a\"");
}

double tick(double most, double count) {
  const double raw = most / count, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace

namespace {

constexpr const char *way_colour = "#1f5fbf", *last_colour = "#c1121f", *begin_colour = "#1d8a5f",
                     *outline_colour = "#b6bcc5";

std::string key(Point at, std::size_t turns, bool several) {
  std::string out;
  const auto words = [&](const char* text) {
    out += svg::text(at + Point{34, 4}, text, "font-size=\"12\" fill=\"#20242a\"");
    at.x += 46 + 6.4 * static_cast<double>(std::string(text).size());
  };
  const auto line = [&](const char* colour, double width, double opacity, const char* text) {
    char look[120];
    std::snprintf(look, sizeof look, "stroke=\"%s\" stroke-width=\"%g\" stroke-opacity=\"%.3g\"", colour, width,
                  opacity);
    out += svg::segment(at, at + Point{26, 0}, look);
    words(text);
  };
  if (several) line(way_colour, 1.2, faintness(turns), turns > 2 ? "turns before" : "turn before");
  line(last_colour, 2, 1, several ? "last turn" : "needle's tip");
  out += svg::circle(at + Point{13, 0}, 4.5, std::string("fill=\"") + begin_colour + "\"");
  words("begin");
  out += svg::circle(at + Point{13, 0}, 4.5,
                     std::string("fill=\"#ffffff\" stroke-width=\"2\" stroke=\"") + last_colour + "\"");
  words("end");
  line(outline_colour, 0.7, 1, "part");
  return out;
}

}  // namespace

std::string path_drawing(const DrawnPath& path) {
  View view;
  for (const Polyline3& line : path.outline)
    for (const Vec at : line) view.widen(at);
  // The first pass determines the size, the second one draws with the accuracy that this size needs.
  for (const BezierPiece& piece : path.pieces)
    for (int i = 0; i <= 8; ++i) view.widen(place(piece.at(i / 8.0)[0]));
  view.fit();
  drawing::Thinned outline(fine);
  for (const Polyline3& line : path.outline) {
    if (line.empty()) continue;
    outline.begin(view(line.front()));
    for (const Vec at : line) outline.to(view(at));
    outline.end();
  }
  drawing::Thinned before(fine), last(fine);
  const double tolerance = 0.1 * fine / view.scale;
  const auto append = [&](drawing::Thinned& line, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
      const std::vector<SplinePoint> points = spline_points(path.pieces.subspan(k, 1), tolerance, 1);
      line.begin(view(place(points.front())));
      for (const SplinePoint& p : points) line.to(view(place(p)));
      line.end();
    }
  };
  const std::size_t split = std::min(path.last_turn, path.pieces.size());
  append(before, 0, split);
  append(last, split, path.pieces.size());
  const double height = margin + title_height + view.scale * (view.high.y - view.low.y) + foot + 2 * margin;
  std::string out = svg::open(std::max(560.0, 2 * margin + view.scale * (view.high.x - view.low.x)), height);
  out += svg::text({margin, margin + 6}, path.title, "font-size=\"16\" fill=\"#20242a\"");
  out += key({margin, margin + 26}, path.turns, split > 0);
  out += drawn(outline, outline_colour, 0.7);
  out += drawn(before, way_colour, 1.2, faintness(path.turns)) + drawn(last, last_colour, 2);
  if (!path.pieces.empty()) {
    out += svg::circle(view(place(path.pieces.front().at(0)[0])), 4.5, std::string("fill=\"") + begin_colour + "\"");
    out += svg::circle(view(place(path.pieces.back().at(1)[0])), 4.5,
                       std::string("fill=\"#ffffff\" stroke-width=\"2\" stroke=\"") + last_colour + "\"");
  }
  return out + scale_bar(view, height) + "</svg>\n";
}

std::string curvature_chart(std::span<const BezierPiece> pieces, const std::string& title) {
  constexpr double width = 860, high = 360, left = 66, right = 24, top = 56, bottom = 50;
  const std::vector<CurvaturePoint> points = curvature_points(pieces);
  double longest = 1e-6, most = 1e-9;
  for (const CurvaturePoint& p : points) longest = std::max(longest, p.length), most = std::max(most, p.curvature);
  const auto at = [&](double length, double curvature) {
    return Point{left + length / longest * (width - left - right),
                 high - bottom - curvature / most * (high - top - bottom)};
  };
  std::string out = svg::open(width, high) + svg::text({left, 24}, title, "font-size=\"16\" fill=\"#20242a\"");
  const std::string grid = "stroke=\"#dfe3e8\"", words = "font-size=\"12\" fill=\"#4a525c\"";
  for (const double step = tick(most, 5); const double i : {0., 1., 2., 3., 4., 5.})
    if (i * step <= most * (1 + 1e-9)) {
      const Point p = at(0, i * step);
      out += svg::segment(p, {width - right, p.y}, grid);
      out += svg::text(p + Point{-8, 4}, format("%.3g", i * step), words + " text-anchor=\"end\"");
    }
  const double step = tick(longest, 8);
  for (int i = 0; i * step <= longest * (1 + 1e-9); ++i)
    out += svg::text(at(i * step, 0) + Point{0, 18}, format("%.4g", i * step), words + " text-anchor=\"middle\"");
  out += svg::text({left, top - 12}, "curvature in 1/mm", words);
  out += svg::text({(left + width - right) / 2, high - 12}, "arc length in mm", words + " text-anchor=\"middle\"");
  if (pieces.size() <= 60)
    for (std::size_t k = 1; k < points.size(); ++k)
      if (points[k].piece != points[k - 1].piece)
        out += svg::segment(at(points[k].length, 0), at(points[k].length, most),
                            "stroke=\"#b6bcc5\" stroke-dasharray=\"3 4\"");
  drawing::Thinned line(fine);
  for (std::size_t k = 0; k < points.size(); ++k)
    k == 0 ? line.begin(at(points[k].length, points[k].curvature)) : line.to(at(points[k].length, points[k].curvature));
  line.end();
  return out + drawn(line, curve_colour, 1.6) + "</svg>\n";
}

}  // namespace bahnwerk::winding
