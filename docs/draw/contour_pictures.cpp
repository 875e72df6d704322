#include <cstdio>

#include "docs/draw/colours.hpp"
#include "docs/draw/map.hpp"
#include "docs/draw/pictures.hpp"
#include "docs/draw/plans.hpp"
#include "docs/draw/shapes.hpp"

namespace bahnwerk::draw {

namespace {

const Style limit_blue{"#b9cbe6", 5, "", 1, false}, limit_orange{"#f6d3ae", 5, "", 1, false};

void limits(Chart& chart, const std::vector<Line>& lines, const Style& style, const std::string& label) {
  for (std::size_t i = 0; i < lines.size(); ++i) chart.line(lines[i], style, i == 0 ? label : "");
}

void speeds(const std::string& file, const std::string& title, const Contour& contour, double highest) {
  const Machine m = machine();
  const TimeLaw fast = plan(contour, m, false).law, kept = plan(contour, m, true).law;
  Chart chart({title, "path length s, mm", "speed v, mm/s", {0, contour.path.length()}, {0, highest}});
  limits(chart, highest_speed(contour, m), limit_blue, "limit for time_optimal");
  limits(chart, reserve_speed(contour, m), limit_orange, "v\u2193, K_b = 0.7");
  chart.line(speed_over_length(kept), orange, milliseconds("braking_reserve", kept.duration()));
  chart.line(speed_over_length(fast), blue, milliseconds("time_optimal", fast.duration()));
  chart.save(file);
}

}  // namespace

void speeds_on_circle(const std::string& file) {
  speeds(file, "A full circle of radius 10 mm between two lines of 40 mm", circle(10, 40), 1300);
}

void speeds_on_window(const std::string& file) {
  speeds(file, "The free-form window of examples/bracket.json, no feed", window(), 800);
}

void bracket_in_colour(const std::string& file) {
  constexpr double fastest = 900;
  const Contour contour = bracket();
  const TimeLaw law = plan(contour, machine(), false).law;
  Chart chart(
      {"examples/bracket.json without feeds, time_optimal", "x, mm", "y, mm", {-4, 124}, {-4, 84}, 800, 0, true, 96});
  bool first = true;
  for (const Block& block : contour.blocks)
    for (std::size_t i = block.first; i < block.last; ++i) {
      if (block.mode == Mode::cut) continue;
      const Segment& way = contour.path[i];
      const Vec a = way.at(way.s0()).value, b = way.at(way.s1()).value;
      chart.line({{a[0], a[1]}, {b[0], b[1]}}, {"#b4bac2", 1, "3 3", 1, false}, first ? "positioning" : "");
      first = false;
    }
  coloured_cuts(chart, contour, law, fastest, 4);
  chart.colour_bar({0, fastest}, "v, mm/s");
  chart.save(file);
}

void use_on_window(const std::string& file) {
  const Contour contour = window();
  const Machine m = machine();
  const TimeLaw law = plan(contour, m, false).law;
  Chart chart({"How much of its acceleration each axis uses, window of the bracket, time_optimal",
               "time t, s",
               "|a_k| / A_k",
               {0, law.duration()},
               {0, 1.1}});
  chart.line(use_over_time(motion(contour, law), m, 0), blue, "axis x");
  chart.line(use_over_time(motion(contour, law), m, 1), orange, "axis y");
  chart.save(file);
  std::printf("%s: an axis is at its limit during %.3f %% of the time\n", file.c_str(),
              100 * share_at_limit(motion(contour, law), m));
}

}  // namespace bahnwerk::draw
