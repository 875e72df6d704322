// draw DIR            writes the documentation's pictures into DIR
// draw --convergence  prints the tables of docs/methods/contour.md: duration over the angle of the grid
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "core/progress.hpp"
#include "core/verify/lower_bound.hpp"
#include "docs/draw/plans.hpp"
#include "docs/draw/shapes.hpp"

namespace bahnwerk::draw {
namespace {

const Style blue{"#1f5fbf", 2.2, "", 1, false}, orange{"#d9730d", 2.2, "", 1, false};
const Style limit_blue{"#b9cbe6", 5, "", 1, false}, limit_orange{"#f6d3ae", 5, "", 1, false};

std::string milliseconds(const std::string& name, double duration) {
  char text[64];
  std::snprintf(text, sizeof text, "%s %.1f ms", name.c_str(), 1e3 * duration);
  return text;
}

void limits(Chart& chart, const std::vector<Line>& lines, const Style& style, const std::string& label) {
  for (std::size_t i = 0; i < lines.size(); ++i) chart.line(lines[i], style, i == 0 ? label : "");
}

void speeds(const std::string& file, const std::string& title, const Contour& contour, double highest) {
  const Machine m = machine();
  const MotionLaw fast = plan(contour, m, false).law, kept = plan(contour, m, true).law;
  Chart chart({title, "path length s, mm", "speed v, mm/s", {0, contour.path.length()}, {0, highest}});
  limits(chart, highest_speed(contour, m), limit_blue, "limit for time_optimal");
  limits(chart, reserve_speed(contour, m), limit_orange, "v\u2193, K_b = 0.7");
  chart.line(speed_over_length(contour, kept), orange, milliseconds("braking_reserve", kept.duration()));
  chart.line(speed_over_length(contour, fast), blue, milliseconds("time_optimal", fast.duration()));
  chart.save(file);
}

void coloured(const std::string& file) {
  constexpr int colours = 24;
  constexpr double fastest = 900;
  const Contour contour = bracket();
  const MotionLaw law = plan(contour, machine(), false).law;
  Chart chart(
      {"examples/bracket.json without feeds, time_optimal", "x, mm", "y, mm", {-4, 124}, {-4, 84}, 800, 0, true, 96});
  std::vector<bool> cut(contour.path.size());
  for (const Block& block : contour.blocks)
    for (std::size_t i = block.first; i < block.last; ++i) cut[i] = block.mode == Mode::cut;
  for (std::size_t i = 0; i < cut.size(); ++i)
    if (!cut[i]) {
      const Vec a = contour.path[i].at(contour.path[i].s0()).value, b = contour.path[i].at(contour.path[i].s1()).value;
      chart.line({{a[0], a[1]}, {b[0], b[1]}}, {"#b4bac2", 1, "3 3", 1, false}, i == 0 ? "positioning" : "");
    }
  // Stretches of one colour, each begun where the last one ended.
  Line stretch;
  int colour = -1;
  const auto flush = [&] {
    if (colour >= 0) chart.line(stretch, {Chart::colour((colour + 0.5) / colours), 4, "", 1, true});
  };
  for (const LawPiece& p : law.pieces()) {
    if (!cut[p.segment]) {
      flush();
      stretch.clear();
      colour = -1;
      continue;
    }
    const Segment& segment = contour.path[p.segment];
    const int steps = 1 + static_cast<int>((p.s_end - p.s) / 0.25);
    for (int i = 0; i <= steps; ++i) {
      const LawState at = p.at(p.duration * i / steps);
      const Vec x = segment.at(std::min(std::max(at.s, p.s), p.s_end)).value;
      const int now = std::min(colours - 1, static_cast<int>(at.v / fastest * colours));
      stretch.push_back({x[0], x[1]});
      if (now == colour) continue;
      flush();
      stretch = {{x[0], x[1]}};
      colour = now;
    }
  }
  flush();
  chart.colour_bar({0, fastest}, "v, mm/s");
  chart.save(file);
}

void use(const std::string& file) {
  const Contour contour = window();
  const Machine m = machine();
  const MotionLaw law = plan(contour, m, false).law;
  Chart chart({"How much of its acceleration each axis uses, window of the bracket, time_optimal",
               "time t, s",
               "|a_k| / A_k",
               {0, law.duration()},
               {0, 1.1}});
  chart.line(use_over_time(contour, law, m, 0), blue, "axis x");
  chart.line(use_over_time(contour, law, m, 1), orange, "axis y");
  chart.save(file);
  std::printf("%s: an axis is at its limit during %.3f %% of the time\n", file.c_str(),
              100 * share_at_limit(contour, law, m));
}

void convergence(const std::string& name, const Contour& contour) {
  const Machine m = machine();
  SilentProgress silent;
  const double bound = lower_bound(contour, m, GridOptions{}.angle / 2, silent).duration;
  GridOptions finest;
  finest.angle = 2.5e-4;
  const double best = plan(contour, m, false, finest, 1e-9).law.duration();
  std::printf("%s: %.9f s on a grid of 0.00025 rad with tolerance 1e-9; lower bound %.9f s\n\n", name.c_str(), best,
              bound);
  std::printf(
      "| angle, rad | cells | duration, s | above the finest | above the bound |\n| --- | --- | --- | --- | --- |\n");
  for (const double angle : {0.032, 0.016, 0.008, 0.004, 0.002, 0.001}) {
    GridOptions grid;
    grid.angle = angle;
    const AccelerationLimitedResult result = plan(contour, m, false, grid);
    std::printf("| %.3f | %zu | %.9f | %.1e | %.1e |\n", angle, result.cells, result.law.duration(),
                result.law.duration() / best - 1, result.law.duration() / bound - 1);
  }
  std::printf("\n");
}

/// Durations against tests/core/motion/reference/circle.csv.
void reference() {
  struct Row {
    double feed, duration;
  };
  std::printf("| feed, mm/s | independent, s | planned, s | relative difference |\n| --- | --- | --- | --- |\n");
  for (const Row row :
       {Row{unlimited, 0.427110407865}, Row{440, 0.635346100218}, Row{400, 0.682079632680}, Row{250, 1.066952412281}}) {
    const double planned = plan(circle(10, 100, row.feed), machine(), false).law.duration();
    std::printf("| %g | %.9f | %.9f | %.1e |\n", row.feed, row.duration, planned, planned / row.duration - 1);
  }
  std::printf("\n");
}

int run(const std::string& what) {
  if (what == "--convergence") {
    reference();
    convergence("circle between lines", circle(10, 100));
    convergence("window", window());
    return 0;
  }
  speeds(what + "/speed_circle.svg", "A full circle of radius 10 mm between two lines of 40 mm", circle(10, 40), 1300);
  speeds(what + "/speed_window.svg", "The free-form window of examples/bracket.json, no feed", window(), 800);
  coloured(what + "/bracket.svg");
  use(what + "/axis_use.svg");
  return 0;
}

}  // namespace
}  // namespace bahnwerk::draw

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw DIR | draw --convergence\n");
    return 2;
  }
  try {
    return bahnwerk::draw::run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
