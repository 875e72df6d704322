#include "core/plan/motion_law/load_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "core/base/infeasible_at.hpp"
#include "core/cam/law_table.hpp"
#include "core/drawing/panel.hpp"
#include "core/drawing/svg.hpp"
#include "core/verify/cam/law_verifier.hpp"
#include "core/verify/cam/load_checks.hpp"

namespace bahnwerk {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}
const char* unit(const cam::DriveLoad& load) { return load.turns() ? "N m" : "N"; }

[[noreturn]] void refuse(const std::string& member, const std::string& message) {
  throw InfeasibleAt("the drive cannot follow: " + message, {{{"drive", member}, message}});
}

}  // namespace

LoadPlan plan_load(const cam::DriveLoad& load, const cam::LoadLimits& limits, LawPlan& plan, Progress progress) {
  LoadPlan out{load, limits, cam::load_figures(cam::linear_load(load), plan.solution.law, progress)};
  const std::string what = load.turns() ? "torque" : "force";
  const cam::LoadFigures& f = out.figures;
  if (f.peak() > limits.peak * (1 + 1e-6)) {
    const cam::CamExtreme& worst = f.most.value > -f.least.value ? f.most : f.least;
    const double at = worst.at / (2 * std::numbers::pi) * plan.problem.length;
    refuse(what, "the law takes a " + what + " of " + number(f.peak()) + " " + unit(load) + " at " + number(at) + " " +
                     plan.problem.master_unit + ", the limit is " + number(limits.peak) + " " + unit(load) +
                     ": a longer cycle or a law with less acceleration takes less");
  }
  if (f.rms > limits.rms * (1 + 1e-6))
    refuse("rms_" + what, "the root mean square of the " + what + " is " + number(f.rms) + " " + unit(load) +
                              ", the limit is " + number(limits.rms) + " " + unit(load));
  verify_load(published(plan), {load, limits, f.peak(), f.rms}, progress, plan.verification);
  return out;
}

void check_drive(const cam::DriveLimits& drive, LawPlan& plan) {
  const double limits[] = {0, drive.velocity, drive.acceleration, drive.jerk};
  static constexpr const char* names[] = {"", "velocity", "acceleration", "jerk"};
  static constexpr const char* powers[] = {"", "/s", "/s²", "/s³"};
  for (std::size_t r = 1; r < 4; ++r) {
    if (!std::isfinite(limits[r])) continue;
    const cam::LawPeak& peak = plan.solution.value.peaks[r];
    const double limit = limits[r] * (1 + 1e-8);
    if (peak.value > limit)
      refuse(names[r], std::string("the law's ") + names[r] + " is " + number(peak.value) + " " +
                           plan.problem.slave_unit + powers[r] + ", the limit is " + number(limits[r]) + " " +
                           plan.problem.slave_unit + powers[r]);
    plan.verification.add(
        {named(CheckGroup::limit, std::string("drive ") + names[r], plan.problem.slave_unit + powers[r]), limit,
         peak.value, peak.at, true});
  }
}

std::string load_drawing(const LoadPlan& load, const LawPlan& plan) {
  constexpr double left = 84, right = 20, top = 64, width = 760, height = 150, gap = 64;
  const cam::LoadFigures& f = load.figures;
  const double scale = plan.problem.length / (2 * std::numbers::pi), first = cam::table_begin(plan.problem);
  std::vector<std::pair<double, cam::LoadPoint>> rows;
  for (const cam::LoadPoint& p : f.points) {
    double at = p.at * scale;
    if (plan.problem.periodic && at > first + plan.problem.length * (1 + 1e-9)) at -= plan.problem.length;
    rows.emplace_back(at, p);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  drawing::PanelCurve effort{"", "#1f5fbf", {}}, power{"", "#1f5fbf", {}}, plane{"", "#d9730d", {}};
  for (const auto& [at, p] : rows) {
    effort.points.push_back({at, p.effort});
    power.points.push_back({at, p.power});
  }
  for (const cam::LoadPoint& p : f.points) plane.points.push_back({p.speed, p.effort});
  const std::string what = load.load.turns() ? "torque" : "force", units = unit(load.load);
  drawing::Panel panels[3];
  panels[0].title = what + ", " + units, panels[0].across = "phi, " + plan.problem.master_unit;
  panels[0].curves = {std::move(effort)};
  panels[1].title = "power, W", panels[1].across = panels[0].across, panels[1].curves = {std::move(power)};
  panels[2].title = what + ", " + units + ", over the speed";
  panels[2].across = load.load.turns() ? "speed, 1/min" : "speed, mm/s", panels[2].curves = {std::move(plane)};
  if (std::isfinite(load.limits.peak)) panels[0].limits = panels[2].limits = {load.limits.peak, -load.limits.peak};
  std::string out = svg::open(left + width + right, top + 3 * (height + gap));
  out +=
      svg::text({6, 20},
                "Drive: peak " + what + " " + number(f.peak()) + " " + units + ", root mean square " + number(f.rms) +
                    " " + units + ", peak power " + number(std::max(f.most_power.value, -f.least_power.value)) + " W",
                "fill=\"#20242a\"");
  for (int k = 0; k < 3; ++k) out += drawing::panel_drawing(panels[k], left, top + k * (height + gap), width, height);
  return out + "</svg>\n";
}

}  // namespace bahnwerk
