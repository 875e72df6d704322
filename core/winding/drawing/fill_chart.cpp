#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/drawing/svg.hpp"
#include "core/winding/drawing/drawing.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double width = 800, height = 460, left = 64, right = 24, top = 92, bottom = 56;  // px

struct Look {
  const char *name, *colour;
};
Look look(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::orthocyclic_base:
      return {"orthocyclic base", "#1f5fbf"};
    case Algorithm::orthocyclic_flank:
      return {"orthocyclic flank", "#6d4fb3"};
    case Algorithm::raabe:
      return {"Raabe", "#8a919b"};
    case Algorithm::potential:
      return {"potential", "#c1121f"};
    case Algorithm::needle:
      return {"needle", "#1d8a5f"};
  }
  throw std::logic_error("an algorithm without a colour");
}

struct Scale {
  double from, to, pixel_from, pixel_to;
  double operator()(double value) const { return pixel_from + (value - from) / (to - from) * (pixel_to - pixel_from); }
};

/// From a multiple of `step` to one.
Scale scale(double least, double most, double step, double pixel_from, double pixel_to) {
  const double from = step * std::floor(least / step + 1e-9), to = step * std::ceil(most / step - 1e-9);
  return {from, std::max(to, from + step), pixel_from, pixel_to};
}

std::string curve(const std::vector<Point>& points, const Look& style, const char* dash) {
  std::string d;
  for (const Point& p : points) d += (d.empty() ? "M" : "L") + svg::number(p.x) + " " + svg::number(p.y);
  std::string out =
      "<path d=\"" + d + "\" fill=\"none\" stroke-width=\"2\" stroke=\"" + style.colour + "\"" + dash + "/>\n";
  for (const Point& p : points) out += svg::circle(p, 2.6, std::string("fill=\"") + style.colour + "\"");
  return out;
}

}  // namespace

std::string fill_chart(std::span<const FillCurve> curves, const std::string& title) {
  double thin = 1e300, thick = 0, least = 1, most = 0;
  for (const FillCurve& c : curves)
    for (const auto& v : c.values) {
      thin = std::min(thin, v.copper);
      thick = std::max(thick, v.copper);
      least = std::min({least, v.electrical, v.mechanical});
      most = std::max({most, v.electrical, v.mechanical});
    }
  if (!(thick > 0)) thin = thick = 1, least = 0, most = 1;
  const double x_step = thick - thin > 1.5 ? 0.5 : 0.1;
  const Scale x = scale(thin, thick, x_step, left, width - right);
  const Scale y = scale(100 * least, 100 * most, 5, height - bottom, top);
  std::string out = svg::open(width, height) + svg::text({left, 26}, title, "font-size=\"16\" fill=\"#20242a\"");
  for (int k = 0; y.from + 5 * k <= y.to + 1e-9; ++k) {
    const double at = y(y.from + 5 * k);
    out += svg::segment({left, at}, {width - right, at}, "stroke=\"#dfe3e8\"");
    out += svg::text({left - 8, at + 5}, svg::number(y.from + 5 * k), "text-anchor=\"end\" fill=\"#4a525c\"");
  }
  const int ticks = static_cast<int>(std::lround((x.to - x.from) / x_step));
  for (int k = 0; k <= ticks; ++k) {
    const double at = x(x.from + x_step * k);
    out += svg::segment({at, top}, {at, height - bottom}, "stroke=\"#eef0f3\"");
    if (ticks <= 12 || k % 2 == 0)
      out += svg::text({at, height - bottom + 20}, svg::number(x.from + x_step * k),
                       "text-anchor=\"middle\" fill=\"#4a525c\"");
  }
  out += svg::text({(left + width - right) / 2, height - 12}, "copper diameter in mm",
                   "text-anchor=\"middle\" fill=\"#4a525c\"");
  out += svg::text({left, top - 10}, "fill factor in %: electrical solid, mechanical dashed", "fill=\"#4a525c\"");
  double at = left;
  for (const FillCurve& c : curves) {
    const Look style = look(c.algorithm);
    std::vector<Point> electrical, mechanical;
    for (const auto& v : c.values) {
      electrical.push_back({x(v.copper), y(100 * v.electrical)});
      mechanical.push_back({x(v.copper), y(100 * v.mechanical)});
    }
    out += curve(electrical, style, "") + curve(mechanical, style, " stroke-dasharray=\"6 4\"");
    out += svg::segment({at, 50}, {at + 22, 50}, std::string("stroke-width=\"3\" stroke=\"") + style.colour + "\"");
    out += svg::text({at + 28, 55}, style.name, "fill=\"#20242a\"");
    at += 50 + 7.6 * static_cast<double>(std::string(style.name).size());
  }
  return out + "</svg>\n";
}

}  // namespace bahnwerk::winding
