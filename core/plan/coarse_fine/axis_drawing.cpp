#include "core/plan/coarse_fine/axis_drawing.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/progress_scope.hpp"
#include "core/drawing/panel.hpp"
#include "core/drawing/svg.hpp"

namespace bahnwerk {
namespace {

using drawing::Envelope;
using drawing::Panel;

constexpr std::size_t columns = 360;
constexpr double width = 720, height = 96, right = 16, title = 30;
constexpr const char *head_colour = "#8a919b", *coarse_colour = "#1f5fbf", *fine_colour = "#d9730d";

/// Curves of one axis: position, velocity and acceleration of head, coarse and fine axis.
struct Curves {
  std::vector<Envelope> head, coarse, fine;
  explicit Curves(double end) : head(3, {columns, end}), coarse(head), fine(head) {}
  void add(double t, const MotionState& x, const MotionState& c, std::size_t k) {
    for (std::size_t d = 0; d < 3; ++d) {
      head[d].add(t, x[d][k]);
      coarse[d].add(t, c[d][k]);
      fine[d].add(t, x[d][k] - c[d][k]);
    }
  }
};

std::vector<double> both(double limit) { return {limit, -limit}; }

std::vector<Panel> panels(const CoarseFineAxis& axis, const Curves& c, bool last) {
  const std::string &n = axis.name, time = last ? "t, s" : "";
  const auto fine = [&](std::size_t d, const std::string& name) {
    return drawing::PanelCurve{name, fine_colour, c.fine[d].points()};
  };
  const auto coarse = [&](std::size_t d, const std::string& name) {
    return drawing::PanelCurve{name, coarse_colour, c.coarse[d].points()};
  };
  return {{"positions, mm", {}, {{n, head_colour, c.head[0].points()}, coarse(0, n + "c")}, {}},
          {"fine axis, mm", {}, {fine(0, n + "f")}, both(axis.stroke)},
          {"coarse velocity, mm/s", {}, {coarse(1, "v" + n + "c")}, both(axis.coarse.velocity)},
          {"fine velocity, mm/s", {}, {fine(1, "v" + n + "f")}, both(axis.fine.velocity)},
          {"coarse acceleration, mm/s²", {}, {coarse(2, "a" + n + "c")}, both(axis.coarse.acceleration)},
          {"fine acceleration, mm/s²", time, {fine(2, "a" + n + "f")}, both(axis.fine.acceleration)}};
}

}  // namespace

std::string axis_drawing(const CoarseFinePlan& plan, const CoarseFineMachine& machine, Progress progress) {
  const Motion &head = *plan.head, &coarse = *plan.coarse;
  const std::size_t moving = std::min(machine.axes.size(), plan.contour.path->dimension);
  std::vector<Curves> curves(moving, Curves(head.duration()));
  ProgressScope scope(progress.part(1, 1), "drawing");
  std::size_t piece = 0;
  for (std::size_t c = 0; c < coarse.pieces(); ++c) {
    scope.work(8);
    const double begin = coarse.begin(c), end = coarse.end(c);
    for (const double part : {1e-3, 0.5, 1 - 1e-3}) {  // cells may be as short as some ns
      const double t = begin + part * (end - begin);
      const MotionState x = head.evaluate(t, piece), at = coarse.in_piece(c, t);
      for (std::size_t k = 0; k < moving; ++k) curves[k].add(t, x, at, k);
    }
  }
  using drawing::panel_bottom;
  using drawing::panel_left;
  using drawing::panel_top;
  std::string body;
  double top = title;
  for (std::size_t k = 0; k < moving; ++k)
    for (const Panel& panel : panels(machine.axes[k], curves[k], k + 1 == moving)) {
      top += panel_top;
      body += drawing::panel_drawing(panel, panel_left, top, width, height);
      top += height + 4;
    }
  char text[120];
  std::snprintf(text, sizeof text, "coarse and fine axes, %.6g s; limits dashed", plan.contour.duration);
  return svg::open(panel_left + width + right, top + panel_bottom) + svg::text({6, 20}, text, "fill=\"#20242a\"") +
         body + "</svg>\n";
}

std::vector<Vec> coarse_way(const CoarseFinePlan& plan) {
  std::vector<Vec> way;
  const Motion& coarse = *plan.coarse;
  const auto add = [&](const MotionState& x) {
    Vec p;
    for (std::size_t k = 0; k < std::min<std::size_t>(coarse.axes(), plan.contour.path->dimension); ++k) p[k] = x[0][k];
    way.push_back(p);
  };
  for (std::size_t c = 0; c < coarse.pieces(); ++c) add(coarse.in_piece(c, coarse.begin(c)));
  add(coarse.final_state());
  return way;
}

}  // namespace bahnwerk
