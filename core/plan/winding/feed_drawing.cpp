#include "core/plan/winding/feed_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/drawing/svg.hpp"
#include "core/motion/feed/curvature_feed.hpp"

namespace bahnwerk {
namespace {

constexpr double width = 960, high = 460, left = 66, right = 150, top = 46, bottom = 50;  // px
constexpr std::size_t per_segment = 64;
constexpr const char* colours[] = {"#1f5fbf", "#2a9d8f", "#b7791f", "#8e44ad", "#c1121f"};
constexpr const char* feed_style = "fill=\"none\" stroke=\"#20242a\" stroke-width=\"2.4\"";
constexpr const char* limit_style = "fill=\"none\" stroke=\"#4a525c\" stroke-dasharray=\"6 4\"";

using Line = std::vector<Point>;  // s mm, v mm/s

double step_of(double most, int parts) {
  const double rough = most / parts, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double nice : {1., 2., 5.})
    if (nice * power >= rough) return nice * power;
  return 10 * power;
}

/// Segments of the first coil's first turn: [0, n).
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

/// The feed of the law up to a segment.
Line feed_line(const TimeLaw& law, std::size_t segments) {
  Line line;
  for (const LawPiece& piece : law.pieces()) {
    if (piece.segment >= segments) break;
    constexpr int parts = 6;
    for (int i = line.empty() ? 0 : 1; i <= parts; ++i) {
      const LawState x = piece.at(piece.duration * i / parts);
      line.push_back({x.s, x.v});
    }
  }
  return line;
}

class Chart {
 public:
  Chart(double longest, double most) : longest_(longest), most_(most) {}
  Point at(Point p) const {
    return {left + p.x / longest_ * (width - left - right),
            high - bottom - std::min(p.y, most_) / most_ * (high - top - bottom)};
  }
  /// Points that show nothing new are left out.
  std::string drawn(const Line& line, const std::string& style) const {
    std::string path;
    Point last{};
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Point p = at(line[i]);
      if (i > 0 && i + 1 < line.size() && std::hypot(p.x - last.x, p.y - last.y) < 0.7) continue;
      char text[48];
      std::snprintf(text, sizeof text, "%s%.1f %.1f", i == 0 ? "M" : "L", p.x, p.y);
      path += text, last = p;
    }
    return "<path" + svg::attribute("d", path) + " " + style + "/>\n";
  }
  std::string frame(const std::string& title) const {
    const std::string words = "font-size=\"12\" fill=\"#4a525c\"";
    const auto number = [](double x) {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", x);
      return std::string(text);
    };
    std::string out = svg::open(width, high) + svg::text({left, 22}, title, "font-size=\"16\" fill=\"#20242a\"");
    for (double step = step_of(most_, 6), v = 0; v <= most_ * (1 + 1e-9); v += step) {
      const Point p = at({0, v});
      out += svg::segment(p, {width - right, p.y}, "stroke=\"#dfe3e8\"");
      out += svg::text({p.x - 8, p.y + 4}, number(v), words + " text-anchor=\"end\"");
    }
    for (double step = step_of(longest_, 8), s = 0; s <= longest_ * (1 + 1e-9); s += step) {
      const Point p = at({s, 0});
      out += svg::text({p.x, p.y + 18}, number(s), words + " text-anchor=\"middle\"");
    }
    out += svg::text({left, top - 8}, "feed in mm/s", words);
    return out +
           svg::text({(left + width - right) / 2, high - 12}, "arc length in mm", words + " text-anchor=\"middle\"");
  }

 private:
  double longest_, most_;
};

}  // namespace

std::string feed_drawing(const WindingRequest& request, const WindingPlan& plan) {
  const AxisPath& path = *plan.machine.axes;
  const Machine machine{plan.machine.kinematics->axes(), request.cycle_time};
  const std::size_t n = first_turn(plan);
  const Line feed = feed_line(plan.motion.motion->law(), n);
  double fastest = 1e-6;
  for (const Point& p : feed) fastest = std::max(fastest, p.y);
  std::vector<double> feeds = curvature_feeds(plan.tool->tool, {request.chord_tolerance, request.cycle_time,
                                                                request.half_speed_curvature, request.along.velocity});
  const Chart chart(n > 0 ? path[n - 1].s1() : 1, 1.3 * fastest);

  std::vector<Line> axes(path.axes());
  Line allowed;
  for (std::size_t i = 0; i < n; ++i) {
    const Curve& curve = path[i].curve();
    for (std::size_t k = 0; k <= per_segment; ++k) {
      const double u = curve.begin() + (curve.end() - curve.begin()) * static_cast<double>(k) / per_segment;
      const AxisJet q = path.at_parameter(i, u);
      for (std::size_t axis = 0; axis < axes.size(); ++axis)
        axes[axis].push_back({path[i].arc_length(u), constant_speed(machine, q, axis)});
    }
    const double limit = std::min(feeds[i], request.along.velocity);
    for (const double s : {path[i].s0(), path[i].s1()}) allowed.push_back({s, limit});
  }

  std::string out = chart.frame("feed of the first turn and what limits leave to a constant one");
  double y = top + 10;
  const auto entry = [&](const std::string& name, const std::string& style) {
    out += svg::segment({width - right + 14, y}, {width - right + 44, y}, style);
    out += svg::text({width - right + 52, y + 4}, name, "font-size=\"12\" fill=\"#20242a\"");
    y += 20;
  };
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const std::string style = std::string("fill=\"none\" stroke-width=\"1.2\"") +
                              svg::attribute("stroke", colours[axis % std::size(colours)]);
    out += chart.drawn(axes[axis], style);
    entry("limits of " + machine.axes[axis].name, style);
  }
  if (std::any_of(allowed.begin(), allowed.end(), [](const Point& p) { return p.y < unlimited; })) {
    out += chart.drawn(allowed, limit_style);
    entry("feed's limits", limit_style);
  }
  out += chart.drawn(feed, feed_style);
  entry("feed", feed_style);
  return out + "</svg>\n";
}

}  // namespace bahnwerk
