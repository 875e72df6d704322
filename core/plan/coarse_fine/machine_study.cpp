#include "core/plan/coarse_fine/machine_study.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/progress.hpp"
#include "core/drawing/panel.hpp"
#include "core/drawing/svg.hpp"
#include "core/plan/trial.hpp"

namespace bahnwerk {
namespace {

constexpr double strokes[] = {0.5, 1, 2, 5, 10, 20, 35, 50, 75, 100};  // mm
constexpr double factors[] = {0.25, 0.5, 0.75, 1, 1.5, 2};             // factors of the fine accelerations
constexpr double other_factors[] = {0.5, 0.75, 1, 1.5, 2};             // factors of all other limits
constexpr const char* stage = "machine study";

/// Returns the studied figure of an axis.
double& figure(CoarseFineAxis& axis, StudiedQuantity quantity) {
  switch (quantity) {
    case StudiedQuantity::fine_acceleration:
      return axis.fine.acceleration;
    case StudiedQuantity::fine_velocity:
      return axis.fine.velocity;
    case StudiedQuantity::coarse_acceleration:
      return axis.coarse.acceleration;
    case StudiedQuantity::coarse_velocity:
      return axis.coarse.velocity;
    case StudiedQuantity::stroke:
      break;
  }
  return axis.stroke;
}

/// Returns the first axis with a fine axis, by which others are scaled.
std::size_t leading(const CoarseFineMachine& machine) {
  for (std::size_t k = 0; k < machine.axes.size(); ++k)
    if (machine.axes[k].stroke > 0) return k;
  return 0;
}

std::vector<double> values_of(const StudyRequest& request, CoarseFineMachine machine) {
  std::vector<double> values = request.values;
  if (values.empty()) {
    const double now = figure(machine.axes[leading(machine)], request.quantity);
    if (request.quantity == StudiedQuantity::stroke)
      values.assign(std::begin(strokes), std::end(strokes));
    else if (request.quantity == StudiedQuantity::fine_acceleration)
      for (const double factor : factors) values.push_back(factor * now);
    else
      for (const double factor : other_factors) values.push_back(factor * now);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

CoarseFineMachine changed(CoarseFineMachine machine, StudiedQuantity quantity, double value) {
  const double factor = value / figure(machine.axes[leading(machine)], quantity);
  const bool fine = quantity != StudiedQuantity::coarse_acceleration && quantity != StudiedQuantity::coarse_velocity;
  for (CoarseFineAxis& axis : machine.axes) {
    if (fine && !(axis.stroke > 0)) continue;  // there is no fine axis
    double& now = figure(axis, quantity);
    now = quantity == StudiedQuantity::stroke ? value : factor * now;
  }
  return machine;
}

void fail(const Verification& verification, StudiedMachine& machine) {
  machine.note = "no plan passed the verifier";
  const auto& checks = verification.checks;
  const auto failed = std::find_if(checks.begin(), checks.end(), [](const Check& check) { return !check.passed; });
  if (failed != checks.end()) machine.failed = *failed;
}

StudiedMachine studied(double value, const Contour& contour, const CoarseFineMachine& machine,
                       const ContourPlanning& planning, const RedundancyOptions& options, Progress progress) {
  StudiedMachine result;
  result.value = value;
  const auto plan = trial([&] { return plan_coarse_fine(contour, machine, planning, options, progress); });
  if (!plan)
    result.note = "nothing can be planned: " + plan.reason();
  else if (plan->contour.verification.passed)
    result.duration = plan->contour.duration;
  else
    fail(plan->contour.verification, result);
  return result;
}

/// A plan for a machine also is one for machines with larger values.
void take_over(std::vector<StudiedMachine>& machines) {
  const StudiedMachine* best = nullptr;
  for (StudiedMachine& m : machines) {
    if (best && (!m.duration || *m.duration > *best->duration)) {
      char note[120];
      std::snprintf(note, sizeof note, "the plan for %.6g holds here, too, and is the shorter one", best->value);
      m.duration = best->duration;
      m.note = note;
      m.failed.reset();
      continue;
    }
    if (m.duration) best = &m;
  }
}

const char* across(StudiedQuantity quantity) {
  switch (quantity) {
    case StudiedQuantity::fine_acceleration:
      return "acceleration of the fine axes, mm/s²";
    case StudiedQuantity::fine_velocity:
      return "velocity of the fine axes, mm/s";
    case StudiedQuantity::coarse_acceleration:
      return "acceleration of the coarse axes, mm/s²";
    case StudiedQuantity::coarse_velocity:
      return "velocity of the coarse axes, mm/s";
    case StudiedQuantity::stroke:
      break;
  }
  return "stroke of the fine axes, mm";
}

}  // namespace

std::vector<StudyRequest> usual_studies() {
  std::vector<StudyRequest> requests;
  for (const auto& quantity : studied_quantities) requests.push_back({quantity.value, {}});
  return requests;
}

MachineStudy machine_study(const Contour& contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                           const RedundancyOptions& given, const std::vector<StudyRequest>& requests,
                           Progress progress) {
  RedundancyOptions options = given;
  options.compare = false;
  options.smoothness = options.stretch = 0;
  MachineStudy study;
  std::size_t plans = 0;
  for (const StudyRequest& request : requests) {
    study.push_back({request.quantity, {}});
    for (const double value : values_of(request, machine)) study.back().machines.push_back({value, {}, {}});
    plans += study.back().machines.size();
  }
  const double share = 1 / static_cast<double>(std::max<std::size_t>(plans, 1));
  double begin = 0;
  for (Study& table : study) {
    for (StudiedMachine& m : table.machines) {
      const Progress part = progress.part(begin, begin + share).named(stage);
      begin += share;
      m = studied(m.value, contour, changed(machine, table.quantity, m.value), planning, options, part);
    }
    take_over(table.machines);
  }
  return study;
}

std::string machine_study_drawing(const MachineStudy& study, double duration) {
  constexpr double width = 640, height = 200, right = 20;
  std::string out;
  double top = 30;
  for (const Study& table : study) {
    drawing::Panel panel{"duration, s", across(table.quantity), {{"", "#1f5fbf", {}, true}}, {duration}};
    for (const StudiedMachine& m : table.machines)
      if (m.duration) panel.curves[0].points.push_back({m.value, *m.duration});
    top += drawing::panel_top;
    out += drawing::panel_drawing(panel, drawing::panel_left, top, width, height);
    top += height + drawing::panel_bottom;
  }
  char title[120];
  std::snprintf(title, sizeof title, "other axes; dashed: this machine, %.6g s", duration);
  return svg::open(drawing::panel_left + width + right, top) + svg::text({6, 20}, title, "fill=\"#20242a\"") + out +
         "</svg>\n";
}

}  // namespace bahnwerk
