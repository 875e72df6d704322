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

/// Returns a scale from one multiple of `step` to another.
Scale scale(double least, double most, double step, double pixel_from, double pixel_to) {
  const double from = step * std::floor(least / step + 1e-9), to = step * std::ceil(most / step - 1e-9);
  return {from, std::max(to, from + step), pixel_from, pixel_to};
}

/// Returns the mark of enamel number `which`: a dot, a ring, a square, an open square.
std::string mark(Point p, std::size_t which, const char* colour) {
  const bool open = which % 2 == 1;
  const std::string look = std::string("fill=\"") + (open ? "#ffffff" : colour) + "\" stroke=\"" + colour + "\"";
  if (which % 4 < 2) return svg::circle(p, open ? 3.2 : 2.6, look);
  return "<rect" + svg::attribute("x", svg::number(p.x - 3)) + svg::attribute("y", svg::number(p.y - 3)) +
         " width=\"6\" height=\"6\" " + look + "/>\n";
}

std::string curve(const std::vector<Point>& points, const Look& style, std::size_t enamel, const char* dash) {
  std::string d;
  for (const Point& p : points) d += (d.empty() ? "M" : "L") + svg::number(p.x) + " " + svg::number(p.y);
  std::string out =
      "<path d=\"" + d + "\" fill=\"none\" stroke-width=\"2\" stroke=\"" + style.colour + "\"" + dash + "/>\n";
  for (const Point& p : points) out += mark(p, enamel, style.colour);
  return out;
}

}  // namespace

std::string fill_chart(std::span<const FillCurve> given, const std::string& title) {
  std::vector<FillCurve> curves(given.begin(), given.end());
  for (FillCurve& c : curves)
    std::stable_sort(c.values.begin(), c.values.end(),
                     [](const auto& a, const auto& b) { return a.copper < b.copper; });
  std::vector<std::string> enamels;
  for (const FillCurve& c : curves)
    if (std::find(enamels.begin(), enamels.end(), c.enamel) == enamels.end()) enamels.push_back(c.enamel);
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
  std::vector<Algorithm> named;
  for (const FillCurve& c : curves) {
    const Look style = look(c.algorithm);
    const std::size_t enamel =
        static_cast<std::size_t>(std::find(enamels.begin(), enamels.end(), c.enamel) - enamels.begin());
    std::vector<Point> electrical, mechanical;
    for (const auto& v : c.values) {
      electrical.push_back({x(v.copper), y(100 * v.electrical)});
      mechanical.push_back({x(v.copper), y(100 * v.mechanical)});
    }
    out += curve(electrical, style, enamel, "") + curve(mechanical, style, enamel, " stroke-dasharray=\"6 4\"");
    if (std::find(named.begin(), named.end(), c.algorithm) != named.end()) continue;
    named.push_back(c.algorithm);
    out += svg::segment({at, 50}, {at + 22, 50}, std::string("stroke-width=\"3\" stroke=\"") + style.colour + "\"");
    out += svg::text({at + 28, 55}, style.name, "fill=\"#20242a\"");
    at += 50 + 7.6 * static_cast<double>(std::string(style.name).size());
  }
  if (enamels.size() > 1) {
    double from = width - right;
    for (std::size_t k = enamels.size(); k-- > 0;) {
      from -= 26 + 7.2 * static_cast<double>(enamels[k].size());
      out += mark({from, top - 15}, k, "#4a525c") + svg::text({from + 10, top - 10}, enamels[k], "fill=\"#4a525c\"");
    }
  }
  return out + "</svg>\n";
}

}  // namespace bahnwerk::winding
