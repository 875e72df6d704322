#include "core/plan/probe/probe_drawings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/drawing/panel.hpp"
#include "core/drawing/svg.hpp"
#include "core/drawing/ticks.hpp"

namespace bahnwerk {
namespace {

using drawing::Envelope;
using drawing::Panel;

constexpr std::size_t columns = 720;  // number of columns of a curve over time
constexpr double chart_width = 720, chart_height = 96, right = 16, title = 30;  // px
constexpr double plot = 720, least_plot = 160, left = 64, top = 46, gap = 52;   // px
constexpr const char* axis_colours[] = {"#1f5fbf", "#d9730d", "#1d8a5f"};
constexpr const char *ink = "fill=\"#20242a\"", *small = "font-size=\"12\" fill=\"#4a525c\"";

/// One view of the path: coordinate `across` to the right, `up` upwards.
struct ProbeView {
  std::size_t across, up;
  const char* words;
};
constexpr ProbeView plan_view{0, 1, "plan"}, elevation{0, 2, "elevation"};

struct Frame {
  double low_x, low_y, scale, y, width, height;
  Point at(Vec p, const ProbeView& view) const {
    return {left + (p[view.across] - low_x) * scale, y + height - (p[view.up] - low_y) * scale};
  }
};

std::string line(const std::vector<Vec>& points, const Frame& frame, const ProbeView& view, const std::string& style) {
  std::string data;
  Point last{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = frame.at(points[i], view);
    if (i > 0 && i + 1 < points.size() && std::hypot(p.x - last.x, p.y - last.y) < 0.25) continue;
    char text[48];
    std::snprintf(text, sizeof text, "%s%.2f %.2f", i == 0 ? "M" : "L", p.x, p.y);
    data += text, last = p;
  }
  return "<path" + svg::attribute("d", data) + " fill=\"none\" " + style + "/>\n";
}

/// Places along the motion, close enough for a drawing.
std::vector<Vec> places(const SplineMotion& motion) {
  const std::size_t parts = motion.pieces() < 4000 ? 12 : 2;
  std::vector<Vec> list;
  for (std::size_t i = 0; i < motion.pieces(); ++i)
    for (std::size_t k = i == 0 ? 0 : 1; k <= parts; ++k) {
      const double t =
          motion.begin(i) + (motion.end(i) - motion.begin(i)) * static_cast<double>(k) / static_cast<double>(parts);
      const MotionState x = motion.in_piece(i, t);
      Vec p;
      for (std::size_t axis = 0; axis < motion.axes(); ++axis) p[axis] = x[0][axis];
      list.push_back(p);
    }
  return list;
}

std::string axes_of(const Frame& frame, const ProbeView& view) {
  std::string out;
  const auto tick = [&](double value, bool across) {
    Vec p;
    p[view.across] = across ? value : frame.low_x, p[view.up] = across ? frame.low_y : value;
    const Point at = frame.at(p, view);
    if (across) {
      out += svg::segment(at, {at.x, frame.y}, "stroke=\"#e6e9ed\"");
      out += svg::text({at.x, at.y + 16}, drawing::tick_label(value), std::string(small) + " text-anchor=\"middle\"");
    } else {
      out += svg::segment(at, {left + frame.width, at.y}, "stroke=\"#e6e9ed\"");
      out += svg::text({at.x - 6, at.y + 4}, drawing::tick_label(value), std::string(small) + " text-anchor=\"end\"");
    }
  };
  const double step = drawing::nice(plot / frame.scale / 8);
  drawing::for_each_tick(frame.low_x, frame.low_x + frame.width / frame.scale, step, [&](double v) { tick(v, true); });
  drawing::for_each_tick(frame.low_y, frame.low_y + frame.height / frame.scale, step,
                         [&](double v) { tick(v, false); });
  const std::string up = std::string("xyz").substr(view.up, 1), across = std::string("xyz").substr(view.across, 1);
  return out + svg::text({left, frame.y - 8}, std::string(view.words) + ": " + up + " over " + across + ", mm", small);
}

}  // namespace

std::string probe_path_drawing(const ProbePlan& plan) {
  const ProbeProblem& problem = *plan.problem;
  const std::vector<Vec> way = places(*plan.motion.motion);
  Vec low = problem.points.front(), high = low;
  for (const std::vector<Vec>* list : {&problem.points, &way})
    for (const Vec& p : *list)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const double tube = problem.tolerance;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, high[k] - low[k]);
  const double margin = std::min(tube, size / 2) + 0.03 * size, scale = plot / (size + 2 * margin);
  std::vector<ProbeView> views{plan_view};
  if (problem.dimension() == 3) views.push_back(elevation);
  std::string body;
  double y = top + 8, widest = 0;
  for (const ProbeView& view : views) {
    Frame frame{low[view.across] - margin,
                low[view.up] - margin,
                scale,
                y,
                (high[view.across] - low[view.across] + 2 * margin) * scale,
                (high[view.up] - low[view.up] + 2 * margin) * scale};
    // A view that is nearly a line is made higher.
    if (frame.height < least_plot) frame.low_y -= (least_plot - frame.height) / 2 / scale, frame.height = least_plot;
    if (frame.width < least_plot) frame.low_x -= (least_plot - frame.width) / 2 / scale, frame.width = least_plot;
    body += axes_of(frame, view);
    body += line(problem.points, frame, view,
                 "stroke=\"#cfe0f7\" stroke-linejoin=\"round\" stroke-linecap=\"round\"" +
                     svg::attribute("stroke-width", svg::number(std::max(0.5, 2 * tube * scale))));
    body += line(problem.points, frame, view, "stroke=\"#8a919b\" stroke-width=\"0.8\" stroke-dasharray=\"4 3\"");
    body += line(way, frame, view, "stroke=\"#1f5fbf\" stroke-width=\"1.5\"");
    constexpr std::size_t most_dots = 2000;
    if (problem.points.size() <= most_dots)
      for (const Vec& p : problem.points) body += svg::circle(frame.at(p, view), 2.2, "fill=\"#c1121f\"");
    y += frame.height + gap;
    widest = std::max(widest, frame.width);
  }
  char text[160];
  std::snprintf(text, sizeof text, "path (blue), points (red), edges (dashed) with their tube of radius %.4g mm", tube);
  return svg::open(std::max(left + widest + right, 620.0), y) + svg::text({6, 20}, text, ink) + body + "</svg>\n";
}

std::string probe_motion_drawing(const ProbePlan& plan, Progress progress) {
  const ProbeProblem& problem = *plan.problem;
  const SplineMotion& motion = *plan.motion.motion;
  const double T = motion.duration();
  const std::size_t n = problem.dimension();
  Envelope deviation(columns, T), speed(columns, T);
  std::vector<std::array<Envelope, 3>> axes(n, {Envelope(columns, T), Envelope(columns, T), Envelope(columns, T)});
  ProgressScope scope(progress.part(1, 1), "drawing");
  std::size_t edge = 0;
  for (std::size_t i = 0; i < motion.pieces(); ++i) {
    const double begin = motion.begin(i), duration = motion.end(i) - begin;
    const auto parts = static_cast<std::size_t>(std::clamp(std::ceil(4 * columns * duration / T), 4.0, 4.0 * columns));
    scope.work(8 * parts);
    for (std::size_t k = 0; k <= parts; ++k) {
      const double t = begin + duration * static_cast<double>(k) / static_cast<double>(parts);
      const MotionState x = motion.in_piece(i, t);
      while (edge + 1 < problem.edges() && plan.motion.times[edge + 1] <= t) ++edge;
      Vec p, v;
      for (std::size_t axis = 0; axis < n; ++axis) {
        p[axis] = x[0][axis], v[axis] = x[1][axis];
        axes[axis][0].add(t, x[2][axis]);
        axes[axis][1].add(t, x[3][axis]);
        axes[axis][2].add(t, x[4][axis]);
      }
      deviation.add(t, distance_from_edge(p, problem.points[edge], problem.points[edge + 1]));
      speed.add(t, norm(v));
    }
  }
  std::vector<Panel> panels{
      {"deviation, mm", {}, {{"", axis_colours[0], deviation.points()}}, {problem.tolerance}, true},
      {"speed, mm/s", {}, {{"", axis_colours[0], speed.points()}}, {problem.speed}, true}};
  constexpr std::array quantities{"acceleration ", "jerk ", "snap "}, units{", mm/s²", ", mm/s³", ", mm/s⁴"};
  for (std::size_t order = 0; order < 3; ++order)
    for (std::size_t axis = 0; axis < n; ++axis) {
      const AxisLimits& of = problem.axis(axis);
      const double limit = std::array{of.acceleration, of.jerk, of.snap}[order];
      panels.push_back({quantities[order] + of.name + units[order],
                        {},
                        {{"", axis_colours[axis], axes[axis][order].points()}},
                        {limit, -limit}});
    }
  panels.back().across = "t, s";
  std::string body;
  double y = title;
  for (const Panel& panel : panels) {
    y += drawing::panel_top;
    body += drawing::panel_drawing(panel, drawing::panel_left, y, chart_width, chart_height);
    y += chart_height + 4;
  }
  char text[120];
  std::snprintf(text, sizeof text, "probe path, %.6g s; limits dashed", plan.duration);
  return svg::open(drawing::panel_left + chart_width + right, y + drawing::panel_bottom) +
         svg::text({6, 20}, text, ink) + body + "</svg>\n";
}

}  // namespace bahnwerk
