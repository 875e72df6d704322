#include "core/winding/drawing/path_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/drawing/path_lines.hpp"
#include "core/drawing/spline_points.hpp"
#include "core/drawing/svg.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double size = 860, margin = 24, title_height = 36, row_height = 20, foot = 40, fine = 0.3;  // px
constexpr const char* curve_colour = "#1f5fbf";

/// Isometric projection: x and y lead down to the left and to the right, 30° below the horizontal; mm on paper, y
/// upwards.
Point isometric(Vec p) {
  const double c = std::sqrt(0.5), s = std::sqrt(1 / 6.0);
  return {c * (p.y - p.x), 2 * s * p.z - s * (p.x + p.y)};
}

struct View {
  Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  double scale = 1, top = title_height;
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
    return {margin + scale * (p.x - low.x), margin + top + scale * (high.y - p.y)};
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
                     *outline_colour = "#b6bcc5", *coil_colour = "#20242a", *post_colour = "#7b3fa0",
                     *wire_colour = "#c77b30", *needle_colour = "#5c6b7a";

/// The meaning of lines and marks, in as many rows as the width takes.
class Key {
 public:
  explicit Key(double width) : width_(width) {}
  void line(const char* colour, double width, double opacity, const char* words) {
    char look[120];
    std::snprintf(look, sizeof look, "stroke=\"%s\" stroke-width=\"%g\" stroke-opacity=\"%.3g\"", colour, width,
                  opacity);
    const Point at = next(words);
    svg_ += svg::segment(at, at + Point{26, 0}, look);
  }
  void mark(const std::string& look, const char* words) { svg_ += svg::circle(next(words) + Point{13, 0}, 4.5, look); }
  double height() const { return at_.y - margin - title_height + row_height; }  ///< px, of all rows
  const std::string& svg() const { return svg_; }

 private:
  Point next(const char* words) {
    const double wide = 46 + 6.4 * static_cast<double>(std::string_view(words).size());
    if (at_.x > margin && at_.x + wide > width_) at_ = {margin, at_.y + row_height};
    const Point at = at_;
    svg_ += svg::text(at + Point{34, 4}, words, "font-size=\"12\" fill=\"#20242a\"");
    at_.x += wide;
    return at;
  }

  double width_;
  Point at_{margin, margin + title_height - 10};
  std::string svg_;
};

std::string begin_mark() { return std::string("fill=\"") + begin_colour + "\""; }
std::string end_mark() { return std::string("fill=\"#ffffff\" stroke-width=\"2\" stroke=\"") + last_colour + "\""; }

Key key(const DrawnPath& path, bool several, double width) {
  Key key(width);
  if (several) key.line(way_colour, 1.2, faintness(path.turns), path.turns > 2 ? "turns before" : "turn before");
  key.line(last_colour, 2, 1, several ? "last turn" : "needle's tip");
  key.mark(begin_mark(), "begin");
  key.mark(end_mark(), "end");
  key.line(outline_colour, 0.7, 1, "part");
  if (!path.coils.empty()) key.line(coil_colour, 1, 1, "slots of the coil");
  if (!path.posts.empty()) key.line(post_colour, 1, 1, "winding tools");
  if (!path.wires.empty()) key.line(wire_colour, 1, 1, "laid wires");
  if (path.needle_length > 0) key.line(needle_colour, 5, 0.6, "needle at the end");
  return key;
}

/// Numbers of slots, those of coils bold, of the others only as many as do not overlap.
std::string numbers(const std::vector<SlotLabel>& slots, const View& view) {
  constexpr double apart = 17;  // px
  std::string out;
  std::vector<Point> written;
  for (const bool marked : {true, false})
    for (const SlotLabel& label : slots) {
      if (label.marked != marked) continue;
      const Point at = view(label.at);
      if (std::any_of(written.begin(), written.end(), [&](Point p) { return distance(p, at) < apart; })) continue;
      written.push_back(at);
      out += svg::text(at + Point{0, 4}, std::to_string(label.slot),
                       std::string("text-anchor=\"middle\" font-size=\"") +
                           (marked ? "13\" font-weight=\"bold\" fill=\"" : "11\" fill=\"") +
                           (marked ? coil_colour : "#6b7480") + "\"");
    }
  return out;
}

drawing::Thinned thinned(const std::vector<Polyline3>& lines, const View& view) {
  drawing::Thinned thin(fine);
  for (const Polyline3& line : lines) {
    if (line.empty()) continue;
    thin.begin(view(line.front()));
    for (const Vec at : line) thin.to(view(at));
    thin.end();
  }
  return thin;
}

/// Returns the needle where the path ends, from its tip to its holder.
Polyline3 needle(const DrawnPath& path) {
  const auto end = path.pieces.back().at(1)[0];
  const double phi = end[3], psi = end[4];
  const Vec tip = place(end), way{std::cos(phi) * std::cos(psi), std::sin(phi) * std::cos(psi), -std::sin(psi)};
  return {tip, tip - path.needle_length * way};
}

}  // namespace

std::string path_drawing(const DrawnPath& path) {
  View view;
  for (const auto* lines : {&path.outline, &path.posts, &path.wires})
    for (const Polyline3& line : *lines)
      for (const Vec at : line) view.widen(at);
  for (const SlotLabel& label : path.slots) view.widen(label.at);
  const bool bar = path.needle_length > 0 && !path.pieces.empty();
  if (bar)
    for (const Vec at : needle(path)) view.widen(at);
  // The first pass determines the size, the second one draws with the accuracy that this size needs.
  for (const BezierPiece& piece : path.pieces)
    for (int i = 0; i <= 8; ++i) view.widen(place(piece.at(i / 8.0)[0]));
  view.fit();
  const std::size_t split = std::min(path.last_turn, path.pieces.size());
  const double width = std::max(560.0, 2 * margin + view.scale * (view.high.x - view.low.x));
  const Key words = key(path, split > 0, width);
  view.top = title_height + words.height();
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
  append(before, 0, split);
  append(last, split, path.pieces.size());
  const double height = margin + view.top + view.scale * (view.high.y - view.low.y) + foot + 2 * margin;
  std::string out = svg::open(width, height);
  out += svg::text({margin, margin + 6}, path.title, "font-size=\"16\" fill=\"#20242a\"");
  out += words.svg();
  out += drawn(thinned(path.outline, view), outline_colour, 0.7);
  out += drawn(thinned(path.coils, view), coil_colour, 1) + drawn(thinned(path.posts, view), post_colour, 1);
  out += drawn(thinned(path.wires, view), wire_colour, 1, faintness(path.turns));
  out += numbers(path.slots, view);
  out += drawn(before, way_colour, 1.2, faintness(path.turns)) + drawn(last, last_colour, 2);
  if (!path.pieces.empty()) {
    if (bar)
      out += drawn(thinned({needle(path)}, view), needle_colour, std::max(3.0, view.scale * path.needle_width), 0.6);
    out += svg::circle(view(place(path.pieces.front().at(0)[0])), 4.5, begin_mark());
    out += svg::circle(view(place(path.pieces.back().at(1)[0])), 4.5, end_mark());
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
