#include "core/plan/winding/feed_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/drawing/svg.hpp"
#include "core/drawing/ticks.hpp"
#include "core/motion/feed/curvature_feed.hpp"

namespace bahnwerk {
namespace {

constexpr double width = 960, left = 76, right = 170, top = 46;  // px
constexpr double feed_height = 330, panel_height = 130, between = 40, bottom = 50;
constexpr std::size_t per_segment = 64;
constexpr const char* colours[] = {"#1f5fbf", "#2a9d8f", "#b7791f", "#8e44ad", "#c1121f"};
constexpr const char* feed_style = "fill=\"none\" stroke=\"#20242a\" stroke-width=\"2.4\"";
constexpr const char* thin_style = "fill=\"none\" stroke=\"#20242a\" stroke-width=\"1.4\"";
constexpr const char* limit_style = "fill=\"none\" stroke=\"#c1121f\" stroke-dasharray=\"6 4\"";
constexpr const char* small = "font-size=\"12\" fill=\"#4a525c\"";

using Line = std::vector<Point>;  // a curve over s, mm

/// Returns the segments of the first coil's first turn, [0, n).
std::size_t first_turn(const WindingPlan& plan) {
  const Path& tool = plan.tool->tool;
  std::size_t n = 0;
  while (n < tool.size()) {
    const winding::FixedPiece& piece = plan.support[plan.path.pieces[tool[n].source()].fixed];
    if (piece.turn != 0 || piece.coil != 0) break;
    ++n;
  }
  return n;
}

double constant_speed(const Machine& machine, const AxisJet& q, std::size_t axis) {
  const AxisLimits& limit = machine.axes[axis];
  const auto over = [](double most, double rate) { return most / std::max(std::abs(rate), 1e-12); };
  return std::min({over(limit.velocity, q.d1[axis]), std::sqrt(over(limit.acceleration, q.d2[axis])),
                   std::cbrt(over(limit.jerk, q.d3[axis]))});
}

/// Samples of the law up to a segment: feed, acceleration and jerk.
std::array<Line, 3> law_lines(const TimeLaw& law, std::size_t segments) {
  std::array<Line, 3> lines;
  for (const LawPiece& piece : law.pieces()) {
    if (piece.segment >= segments) break;
    constexpr int parts = 6;
    for (int i = 0; i <= parts; ++i) {
      const LawState x = piece.at(piece.duration * i / parts);
      lines[0].push_back({x.s, x.v}), lines[1].push_back({x.s, x.a}), lines[2].push_back({x.s, x.j});
    }
  }
  return lines;
}

/// A frame with ticks that clips its contents.
class Chart {
 public:
  Chart(const char* id, double longest, double least, double most, double y, double height)
      : id_(id), longest_(longest), least_(least), most_(most), y_(y), height_(height) {}
  Point at(Point p) const {
    // Coordinates far outside the frame are clamped, since no number of pixels is needed there.
    const double share = std::clamp((p.y - least_) / (most_ - least_), -1.0, 2.0);
    return {left + p.x / longest_ * (width - left - right), y_ + height_ - share * height_};
  }
  /// Adds points; those that do not change the drawing, and infinite ones, are left out.
  std::string drawn(const Line& line, const std::string& style) const {
    std::string path;
    Point last{};
    bool begun = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (!std::isfinite(line[i].y)) {
        begun = false;
        continue;
      }
      const Point p = at(line[i]);
      if (begun && i + 1 < line.size() && std::hypot(p.x - last.x, p.y - last.y) < 0.7) continue;
      char text[48];
      std::snprintf(text, sizeof text, "%s%.1f %.1f", begun ? "L" : "M", p.x, p.y);
      path += text, last = p, begun = true;
    }
    if (path.empty()) return {};
    return "<path" + svg::attribute("d", path) + svg::attribute("clip-path", "url(#" + std::string(id_) + ")") + " " +
           style + "/>\n";
  }
  std::string level(double value, const std::string& style) const {
    return value > least_ && value < most_ ? svg::segment(at({0, value}), at({longest_, value}), style) : std::string();
  }
  std::string frame(const std::string& what, int ticks) const {
    using svg::attribute;
    using svg::number;
    const std::string box = "<rect" + attribute("x", number(left)) + attribute("y", number(y_)) +
                            attribute("width", number(width - left - right)) + attribute("height", number(height_));
    std::string out = "<clipPath" + attribute("id", id_) + ">" + box + "/></clipPath>\n";
    const double step = drawing::nice((most_ - least_) / ticks);
    drawing::for_each_tick(least_, most_, step, [&](double value) {
      const Point p = at({0, value});
      out += svg::segment(p, {width - right, p.y}, "stroke=\"#dfe3e8\"");
      out += svg::text({p.x - 8, p.y + 4}, drawing::tick_label(value), std::string(small) + " text-anchor=\"end\"");
    });
    out += box + " fill=\"none\" stroke=\"#8a919b\"/>\n";
    return out + svg::text({left, y_ - 8}, what, small);
  }
  std::string across() const {
    std::string out;
    drawing::for_each_tick(0, longest_, drawing::nice(longest_ / 8), [&](double s) {
      out += svg::text({at({s, 0}).x, y_ + height_ + 18}, drawing::tick_label(s),
                       std::string(small) + " text-anchor=\"middle\"");
    });
    return out + svg::text({(left + width - right) / 2, y_ + height_ + 38}, "arc length in mm",
                           std::string(small) + " text-anchor=\"middle\"");
  }

 private:
  const char* id_;
  double longest_, least_, most_, y_, height_;
};

/// Returns the range of acceleration or jerk: that of the law, and its limit unless that lies far outside.
double range(const Line& line, double limit) {
  double most = 1e-6;
  for (const Point& p : line) most = std::max(most, std::abs(p.y));
  return 1.12 * (limit < 4 * most ? std::max(most, limit) : most);
}

/// Returns "limit 700 mm/s", with a remark if the limit is outside the frame.
std::string limit_words(double limit, double most, const char* unit) {
  char text[80];
  std::snprintf(text, sizeof text, "limit %.5g %s%s", limit, unit, limit < most ? "" : ", above");
  return text;
}

}  // namespace

std::string feed_drawing(const WindingRequest& request, const WindingPlan& plan) {
  const AxisPath& path = *plan.machine.axes;
  const Machine machine{plan.machine.kinematics->axes(), request.cycle_time};
  const std::size_t n = first_turn(plan);
  const std::array<Line, 3> law = law_lines(plan.motion.motion->law(), n);
  double fastest = 1e-6;
  for (const Point& p : law[0]) fastest = std::max(fastest, p.y);
  std::vector<double> feeds = curvature_feeds(plan.tool->tool, {request.chord_tolerance, request.cycle_time,
                                                                request.half_speed_curvature, request.along.velocity});
  std::vector<Line> axes(path.axes());
  Line allowed;
  double highest = 0;  // highest speed that the feed's own limits allow
  for (std::size_t i = 0; i < n; ++i) {
    const Curve& curve = path[i].curve();
    for (std::size_t k = 0; k <= per_segment; ++k) {
      const double u = curve.begin() + (curve.end() - curve.begin()) * static_cast<double>(k) / per_segment;
      const AxisJet q = path.at_parameter(i, u);
      for (std::size_t axis = 0; axis < axes.size(); ++axis)
        axes[axis].push_back({path[i].arc_length(u), constant_speed(machine, q, axis)});
    }
    const double limit = std::min(feeds[i], request.along.velocity);
    if (limit < 3 * fastest) highest = std::max(highest, limit);
    for (const double s : {path[i].s0(), path[i].s1()}) allowed.push_back({s, limit});
  }

  const double longest = n > 0 ? path[n - 1].s1() : 1;
  const double most = std::max(1.3 * fastest, 1.08 * highest);
  const Chart feed("feed", longest, 0, most, top, feed_height);
  std::string out = svg::open(width, top + feed_height + 2 * (between + panel_height) + bottom);
  out += svg::text({left, 22}, "the first turn: feed, and what limits leave to a constant one; acceleration, jerk",
                   "font-size=\"16\" fill=\"#20242a\"");
  out += feed.frame("feed in mm/s", 6);
  double y = top + 10;
  const auto entry = [&](const std::string& name, const std::string& style) {
    out += svg::segment({width - right + 14, y}, {width - right + 44, y}, style);
    out += svg::text({width - right + 52, y + 4}, name, "font-size=\"12\" fill=\"#20242a\"");
    y += 20;
  };
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const std::string style = std::string("fill=\"none\" stroke-width=\"1.2\"") +
                              svg::attribute("stroke", colours[axis % std::size(colours)]);
    out += feed.drawn(axes[axis], style);
    entry("limits of " + machine.axes[axis].name, style);
  }
  if (std::any_of(allowed.begin(), allowed.end(), [](const Point& p) { return p.y < unlimited; })) {
    out += feed.drawn(allowed, limit_style);
    entry("feed's limits", limit_style);
  }
  out += feed.drawn(law[0], feed_style);
  entry("feed", feed_style);

  const std::array<double, 2> limits{request.along.acceleration, request.along.jerk};
  constexpr std::array<const char*, 2> what{"acceleration along the path in mm/s²", "jerk along the path in mm/s³"},
      units{"mm/s²", "mm/s³"}, ids{"acceleration", "jerk"};
  for (std::size_t k = 0; k < 2; ++k) {
    const double span = range(law[k + 1], limits[k]);
    const double at = top + feed_height + between + static_cast<double>(k) * (panel_height + between);
    const Chart panel(ids[k], longest, -span, span, at, panel_height);
    out += panel.frame(what[k], 4) + panel.drawn(law[k + 1], thin_style);
    if (limits[k] < unlimited) {
      out += panel.level(limits[k], limit_style) + panel.level(-limits[k], limit_style);
      y = at + 10;
      entry(limit_words(limits[k], span, units[k]), limit_style);
    }
    if (k == 1) out += panel.across();
  }
  return out + "</svg>\n";
}

}  // namespace bahnwerk
