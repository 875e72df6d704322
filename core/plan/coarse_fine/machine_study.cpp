#include "core/plan/coarse_fine/machine_study.hpp"

#include <cstdio>

#include "core/base/errors.hpp"
#include "core/base/progress_part.hpp"
#include "core/drawing/panel.hpp"
#include "core/drawing/svg.hpp"

namespace bahnwerk {
namespace {

constexpr double strokes[] = {5, 10, 20, 35, 50, 75, 100};  // mm
constexpr double factors[] = {0.25, 0.5, 0.75, 1, 1.5, 2};  // of the accelerations
constexpr const char* stage = "machine study";

std::optional<double> duration(const Contour& contour, const CoarseFineMachine& machine,
                               const ContourPlanning& planning, const RedundancyOptions& options, Progress& progress) {
  try {
    const CoarseFinePlan plan = plan_coarse_fine(contour, machine, planning, options, progress);
    if (plan.contour.verification.passed) return plan.contour.duration;
  } catch (const Stopped&) {
    throw;
  } catch (const PlanningError&) {
    // A machine with which nothing can be planned: that is the answer.
  }
  return {};
}

}  // namespace

MachineStudy machine_study(const Contour& contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                           const RedundancyOptions& given, Progress& progress, double from, double to) {
  RedundancyOptions options = given;
  options.compare = false;
  options.smoothness = options.stretch = 0;
  const double share = (to - from) / static_cast<double>(std::size(strokes) + std::size(factors));
  double begin = from;
  const auto plan = [&](const CoarseFineMachine& other) {
    ProgressPart part(progress, stage, begin, begin + share);
    begin += share;
    return duration(contour, other, planning, options, part);
  };
  MachineStudy study;
  for (const double stroke : strokes) {
    CoarseFineMachine other = machine;
    for (CoarseFineAxis& axis : other.axes) axis.stroke = stroke;
    study.stroke.push_back({stroke, plan(other)});
  }
  for (const double factor : factors) {
    CoarseFineMachine other = machine;
    for (CoarseFineAxis& axis : other.axes) axis.fine.acceleration *= factor;
    study.fine_acceleration.push_back({other.axes.front().fine.acceleration, plan(other)});
  }
  return study;
}

std::string machine_study_drawing(const MachineStudy& study, double duration) {
  constexpr double width = 640, height = 200, right = 20;
  std::string out;
  double top = 30;
  for (const auto& [list, across] : {std::pair{&study.stroke, "stroke of the fine axes, mm"},
                                     std::pair{&study.fine_acceleration, "acceleration of the fine axes, mm/s²"}}) {
    drawing::Panel panel{"duration, s", across, {{"", "#1f5fbf", {}, true}}, {duration}};
    for (const StudiedMachine& m : *list)
      if (m.duration) panel.curves[0].points.push_back({m.value, *m.duration});
    top += drawing::panel_top;
    out += drawing::panel_drawing(panel, drawing::panel_left, top, width, height);
    top += height + drawing::panel_bottom;
  }
  char title[120];
  std::snprintf(title, sizeof title, "other fine axes; dashed: this machine, %.6g s", duration);
  return svg::open(drawing::panel_left + width + right, top) + svg::text({6, 20}, title, "fill=\"#20242a\"") + out +
         "</svg>\n";
}

}  // namespace bahnwerk
