#include "core/drawing/panel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "core/drawing/svg.hpp"
#include "core/drawing/ticks.hpp"

namespace bahnwerk::drawing {
namespace {

constexpr const char* ink = "fill=\"#20242a\" font-size=\"11\"";

struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void hold(double value) { low = std::min(low, value), high = std::max(high, value); }
  /// Widens the range slightly, so that it is never empty.
  void widen() {
    if (!(high >= low)) low = 0, high = 1;
    const double more = std::max(0.06 * (high - low), 1e-9 * std::max({1.0, std::abs(low), std::abs(high)}));
    low -= more, high += more;
  }
};

std::string tenth(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  std::string s = text;
  if (s.ends_with(".0")) s.resize(s.size() - 2);
  return s;
}

}  // namespace

std::string panel_drawing(const Panel& panel, double left, double top, double width, double height) {
  Range x, y;
  for (const PanelCurve& curve : panel.curves)
    for (const Point& p : curve.points) x.hold(p.x), y.hold(p.y);
  for (const double limit : panel.limits) y.hold(limit);
  if (panel.from_zero) y.hold(0);
  y.widen();
  if (panel.from_zero) y.low = 0;
  if (!(x.high > x.low)) x.widen();
  const double right = left + width, bottom = top + height;
  const auto at_x = [&](double value) { return left + width * (value - x.low) / (x.high - x.low); };
  const auto at_y = [&](double value) { return bottom - height * (value - y.low) / (y.high - y.low); };

  std::string out;
  const std::string grid = "stroke=\"#e6e9ed\"";
  for_each_tick(y.low, y.high, nice((y.high - y.low) / (height / 24)), [&](double value) {
    out += svg::segment({left, at_y(value)}, {right, at_y(value)}, grid);
    out += svg::text({left - 6, at_y(value) + 4}, tick_label(value), std::string(ink) + " text-anchor=\"end\"");
  });
  for_each_tick(x.low, x.high, nice((x.high - x.low) / (width / 70)), [&](double value) {
    out += svg::segment({at_x(value), top}, {at_x(value), bottom}, grid);
    if (!panel.across.empty())
      out += svg::text({at_x(value), bottom + 14}, tick_label(value), std::string(ink) + " text-anchor=\"middle\"");
  });
  out += "<rect" + svg::attribute("x", svg::number(left)) + svg::attribute("y", svg::number(top)) +
         svg::attribute("width", svg::number(width)) + svg::attribute("height", svg::number(height)) +
         " fill=\"none\" stroke=\"#8a919b\"/>\n";
  for (const double limit : panel.limits)
    out += svg::segment({left, at_y(limit)}, {right, at_y(limit)},
                        "class=\"limit\" stroke=\"#c1121f\" stroke-dasharray=\"5 4\"");
  for (const PanelCurve& curve : panel.curves) {
    std::string data;
    char next = 'M';
    for (const Point& p : curve.points) {
      data += next + tenth(at_x(p.x)) + " " + tenth(at_y(p.y));
      next = 'L';
    }
    if (data.empty()) continue;
    out += "<path" + svg::attribute("class", "curve") + svg::attribute("d", data) +
           " fill=\"none\" stroke-width=\"1.2\"" + svg::attribute("stroke", curve.colour) + "/>\n";
    if (curve.marked)
      for (const Point& p : curve.points)
        out += svg::circle({at_x(p.x), at_y(p.y)}, 3, svg::attribute("fill", curve.colour));
  }
  out += svg::text({left, top - 7}, panel.title, ink);
  double legend = right;
  for (std::size_t i = panel.curves.size(); i-- > 0;) {  // curves are labelled from right to left
    const PanelCurve& curve = panel.curves[i];
    if (curve.name.empty()) continue;
    out +=
        svg::text({legend, top - 7}, curve.name, "font-size=\"11\" text-anchor=\"end\" fill=\"" + curve.colour + "\"");
    legend -= 14 + 6.2 * static_cast<double>(curve.name.size());
  }
  if (!panel.across.empty())
    out += svg::text({right, bottom + 28}, panel.across, std::string(ink) + " text-anchor=\"end\"");
  return out;
}

Envelope::Envelope(std::size_t columns, double end) : end_(end), low_(columns, HUGE_VAL), high_(columns, -HUGE_VAL) {}

void Envelope::add(double x, double value) {
  const auto last = static_cast<double>(low_.size() - 1);
  const auto column = static_cast<std::size_t>(std::clamp(std::floor(x / end_ * (last + 1)), 0.0, last));
  low_[column] = std::min(low_[column], value), high_[column] = std::max(high_[column], value);
}

std::vector<Point> Envelope::points() const {
  std::vector<Point> list;
  for (std::size_t i = 0; i < low_.size(); ++i) {
    if (!(high_[i] >= low_[i])) continue;
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(low_.size()) * end_;
    const bool falling = !list.empty() && std::abs(list.back().y - high_[i]) < std::abs(list.back().y - low_[i]);
    list.push_back({x, falling ? high_[i] : low_[i]});
    if (high_[i] > low_[i]) list.push_back({x, falling ? low_[i] : high_[i]});
  }
  return list;
}

}  // namespace bahnwerk::drawing
