#include "api/kinds/motion_law/motion_law_result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "api/verification.hpp"
#include "core/cam/law_table.hpp"
#include "core/plan/motion_law/law_spectrum.hpp"

namespace bahnwerk::api::motion_law {
namespace {

// What the drive has to bring about → member `load` of a result's details.

using nlohmann::ordered_json;

/// Returns peaks with places, means, and columns over the master.
ordered_json load_result(const LoadPlan& load, const LawPlan& plan) {
  const double scale = plan.problem.length / (2 * std::numbers::pi);
  const cam::LoadFigures& f = load.figures;
  const auto figure = [&](const cam::CamExtreme& extreme) {
    return ordered_json{{"value", extreme.value}, {"at", extreme.at * scale}};
  };
  ordered_json phi = ordered_json::array(), effort = phi, speed = phi, power = phi;
  for (const cam::LoadPoint& p : f.points) {
    phi.push_back(p.at * scale), effort.push_back(p.effort);
    speed.push_back(p.speed), power.push_back(p.power);
  }
  const bool turns = load.load.turns();
  return {{"unit", turns ? "N m" : "N"},
          {"speed_unit", turns ? "1/min" : "mm/s"},
          {"max", figure(f.most)},
          {"min", figure(f.least)},
          {"rms", f.rms},
          {"max_power", figure(f.most_power)},
          {"min_power", figure(f.least_power)},
          {"mean_power", f.mean_power},
          {"curve",
           {{"phi", std::move(phi)},
            {"load", std::move(effort)},
            {"speed", std::move(speed)},
            {"power", std::move(power)}}}};
}

// A planned mechanical cam → member `cam` of a result's details.

using cam::CamExtreme;
using cam::CamType;

constexpr double degree = std::numbers::pi / 180;

ordered_json figure(const CamExtreme& extreme, double unit = 1) {
  double at = extreme.at / degree;
  at -= 360 * std::floor(at / 360);
  return {{"value", extreme.value / unit}, {"at", at}};
}
ordered_json figure(const std::optional<CamExtreme>& extreme) { return extreme ? figure(*extreme) : ordered_json(); }
ordered_json number_or_null(bool known, double value) { return known ? ordered_json(value) : ordered_json(); }

ordered_json nurbs(const NurbsPath& curve) {
  ordered_json points = ordered_json::array();
  for (const HomogeneousPoint& p : curve.points) points.push_back({p[0], p[1]});
  return {{"degree", curve.degree}, {"points", std::move(points)}, {"knots", curve.knots}};
}

/// A job that runs along a curve; its machine is an example.
ordered_json contour_job(const NurbsPath& curve, const char* name) {
  const ordered_json axis{{"velocity", 500}, {"acceleration", 5000}, {"jerk", nullptr}};
  const ordered_json block{{"mode", "cut"}, {"feed", nullptr}, {"segments", {{{"nurbs", nurbs(curve)}}}}};
  const auto& begin = curve.points.front();
  return {{"kind", "contour"},
          {"name", name},
          {"spec",
           {{"contour", {{"start", {begin[0], begin[1]}}, {"blocks", {block}}}},
            {"machine", {{"kinematics", "cartesian"}, {"axes", {{"x", axis}, {"y", axis}}}, {"cycle_time", 0.001}}},
            {"planning", {{"method", "time_optimal"}}}}}};
}

/// Pitch radius of curvature where the sign of the curvature is right.
ordered_json pitch_radius(const CamExtreme& curvature) {
  const double most = std::abs(curvature.value);
  return most > 1e-12 ? figure({1 / most, curvature.at}) : ordered_json();
}

/// Returns figures, curves, and a job of kind "contour" along the profile (a barrel: along the groove's centre line in
/// the unrolled plane).
ordered_json cam_result(const CamPlan& plan) {
  const cam::CamGeometry& g = plan.geometry;
  const cam::CamFigures& f = plan.figures;
  const bool roller = g.has_roller(), barrel = g.type == CamType::barrel;
  ordered_json out{{"type", name_of<CamType>(g.type, cam::cam_types)},
                   {"follower", name_of<cam::FollowerType>(g.follower, cam::follower_types)},
                   {"base_radius", f.base_radius},
                   {"least_base_radius", plan.least ? ordered_json(plan.least->base_radius) : ordered_json()},
                   {"excluded_base_radius", plan.least ? ordered_json(plan.least->excluded) : ordered_json()}};
  out["pressure_angle"] =
      roller ? ordered_json{{"max", figure(f.pressure_angle, degree)}, {"min", figure(f.pressure_angle_back, degree)}}
             : ordered_json();
  out["pitch_radius"] =
      roller ? ordered_json{{"convex", f.pitch_curvature.value > 0 ? pitch_radius(f.pitch_curvature) : ordered_json()},
                            {"concave",
                             f.pitch_curvature_back.value < 0 ? pitch_radius(f.pitch_curvature_back) : ordered_json()}}
             : ordered_json();
  out["profile_radius"] = figure(f.profile_radius);
  out["concave_radius"] = figure(f.concave_radius);
  out["undercut"] = !(f.undercut_bound < 0);
  out["face_width"] = number_or_null(!roller, f.face_width);
  out["stress"] = f.contact ? figure(f.contact->stress) : ordered_json();
  out["force"] = f.contact
                     ? ordered_json{{"max", figure(f.contact->most_force)}, {"min", figure(f.contact->least_force)}}
                     : ordered_json();
  out["tolerance"] = g.tolerance;
  out["profile"] = nurbs(plan.profile);
  out["other_flank"] = plan.other_flank ? nurbs(*plan.other_flank) : ordered_json();
  out["pitch_curve"] = roller ? nurbs(plan.pitch) : ordered_json();
  out["contour"] = barrel ? contour_job(plan.pitch, "centre line of a barrel cam's groove, unrolled")
                          : contour_job(plan.profile, "profile of a radial cam");
  return out;
}

using cam::CamLaw;

/// Coefficients of x^k: differences of those of Bernstein's basis.
ordered_json power(const std::vector<double>& bernstein) {
  ordered_json out = ordered_json::array();
  std::vector<double> d = bernstein;
  double choose = 1;  // C(n, k)
  const std::size_t n = bernstein.size() - 1;
  for (std::size_t k = 0; k <= n; ++k) {
    out.push_back(choose * d[0]);
    for (std::size_t i = 0; i + 1 < d.size(); ++i) d[i] = d[i + 1] - d[i];
    d.pop_back();
    choose *= static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  return out;
}

ordered_json sections(const LawPlan& plan) {
  const CamLaw& law = plan.solution.law;
  const double scale = plan.problem.length / plan.solution.cycle_duration;
  ordered_json list = ordered_json::array();
  std::size_t i = 0;
  for (std::size_t s = 0; s < plan.problem.sections(); ++s) {
    const std::size_t first = i;
    std::size_t degree = 0;
    double peak[4]{};
    ordered_json pieces = ordered_json::array();
    for (; i < law.pieces() && law.piece(i).section == s; ++i) {
      const auto& b = law.piece(i).bernstein;
      degree = std::max(degree, b.size() - 1);
      for (int r = 1; r < 4; ++r) peak[r] = std::max(peak[r], law.peak(r, i).value);
      pieces.push_back({{"begin", law.breaks()[i] * scale},
                        {"end", law.breaks()[i + 1] * scale},
                        {"bernstein", b},
                        {"power", power(b)}});
    }
    const double rise = law.piece(i - 1).bernstein.back() - law.piece(first).bernstein.front();
    const double duration = law.breaks()[i] - law.breaks()[first];
    double largest = 0;
    for (std::size_t k = first; k < i; ++k)
      for (const double c : law.piece(k).bernstein) largest = std::max(largest, std::abs(c));
    const bool rises = std::abs(rise) > 1e-9 * largest;
    const auto& named = plan.problem.points[s].law;
    list.push_back(
        {{"degree", degree},
         {"begin", law.breaks()[first] * scale},
         {"end", law.breaks()[i] * scale},
         {"law", named ? ordered_json(name_of<cam::ClassicalLaw>(*named, cam::classical_laws)) : ordered_json()},
         {"weight",
          number_or_null(plan.problem.points[s].weight.has_value(), plan.problem.points[s].weight.value_or(0))},
         {"rise", rise},
         {"peaks", {{"velocity", peak[1]}, {"acceleration", peak[2]}, {"jerk", peak[3]}}},
         {"cv", number_or_null(rises, peak[1] * duration / std::abs(rise))},
         {"ca", number_or_null(rises, peak[2] * duration * duration / std::abs(rise))},
         {"cj", number_or_null(rises, peak[3] * duration * duration * duration / std::abs(rise))},
         {"pieces", std::move(pieces)}});
  }
  return list;
}

ordered_json conversions(const std::vector<cam::Conversion>& list) {
  ordered_json out = ordered_json::array();
  for (const auto& c : list) out.push_back({{"point", c.point}, {"derivative", c.order}, {"value", c.value}});
  return out;
}

ordered_json peak(const LawPlan& plan, std::size_t order) {
  const cam::LawPeak& p = plan.solution.value.peaks[order];
  return {{"value", p.value},
          {"at", p.at * plan.problem.length / plan.solution.cycle_duration},
          {"section", plan.solution.law.piece(p.piece).section}};
}

/// Adds a note if a law without limits of sections leaves the range of its points.
void note_overshoot(const LawPlan& plan, std::vector<std::string>& notes) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const cam::MotionPoint& p : plan.problem.points) {
    least = std::min(least, p.value(0).min), most = std::max(most, p.value(0).max);
  }
  if (const cam::Range end = plan.problem.end_position(plan.problem.sections() - 1); plan.problem.travel != 0)
    least = std::min(least, end.min), most = std::max(most, end.max);
  if (!std::isfinite(least) || !std::isfinite(most) || !(most > least)) return;
  const std::string unit = " " + plan.problem.slave_unit;
  for (std::size_t s = 0; s < plan.problem.sections(); ++s) {
    if (!plan.problem.points[s].section[0].free()) continue;
    const auto extremes = plan.solution.law.section_extremes(0, s);
    const double over = extremes.highest.value - most, under = least - extremes.lowest.value;
    if (std::max(over, under) <= 1e-6 * (most - least)) continue;
    const bool high = over >= under;
    notes.push_back("section " + std::to_string(s) + " leaves the range of the points: position " +
                    ordered_json(high ? extremes.highest.value : extremes.lowest.value).dump() + unit +
                    (high ? ", above " : ", below ") + ordered_json(high ? most : least).dump() + unit +
                    "; \"section\": {\"position\": {\"" + (high ? "max" : "min") + "\": " +
                    ordered_json(high ? most : least).dump() + "}} in point " + std::to_string(s) + " keeps it there");
  }
}

ordered_json order_of_source(const LawPlan& plan) {
  if (!plan.solution.source_order) return nullptr;
  const auto& order = *plan.solution.source_order;
  return {{"objective", number_or_null(std::isfinite(order.objective), order.objective)},
          {"conversions", conversions(order.conversions)}};
}

ordered_json compared_law(const LawPlan& plan) {
  const CamLaw& law = *plan.classical;
  const cam::LawValue value = cam::evaluate_objective(plan.problem, law);
  const double scale = plan.problem.length / plan.solution.cycle_duration;
  ordered_json pieces = ordered_json::array();
  for (std::size_t i = 0; i < law.pieces(); ++i)
    pieces.push_back({{"begin", law.breaks()[i] * scale},
                      {"end", law.breaks()[i + 1] * scale},
                      {"bernstein", law.piece(i).bernstein}});
  return {{"objective", value.objective},
          {"peak_velocity", value.peaks[1].value},
          {"peak_acceleration", value.peaks[2].value},
          {"peak_jerk", value.peaks[3].value},
          {"pieces", std::move(pieces)}};
}

ordered_json spectrum(const LawPlan& plan) {
  const std::size_t harmonics = shown_harmonics(plan.problem);
  ordered_json frequencies = ordered_json::array();
  for (std::size_t k = 1; k <= harmonics; ++k)
    frequencies.push_back(static_cast<double>(k) / plan.solution.cycle_duration);
  return {{"frequency", std::move(frequencies)},
          {"law", acceleration_spectrum(plan.solution.law, harmonics)},
          {"classical", acceleration_spectrum(*plan.classical, harmonics)}};
}

}  // namespace

KindReport report_law(const MotionLawRequest& request, const MotionLawPlan& plan) {
  const cam::LawSolution& solution = plan.solution;
  const bool optimal = plan.problem.method == cam::LawMethod::optimal;
  std::vector<std::string> notes = request.notes;
  notes.insert(notes.end(), solution.notes.begin(), solution.notes.end());
  if (!optimal) note_overshoot(plan, notes);  // the optimiser's notes have its own
  const auto positions = solution.law.extremes(0);
  KindReport out;
  out.details = {{"master",
                  {{"unit", plan.problem.master_unit},
                   {"begin", cam::table_begin(plan.problem)},
                   {"length", plan.problem.length},
                   {"periodic", plan.problem.periodic},
                   {"travel", plan.problem.travel}}},
                 {"sections", sections(plan)},
                 {"angles", solution.at},
                 {"peaks", {{"velocity", peak(plan, 1)}, {"acceleration", peak(plan, 2)}, {"jerk", peak(plan, 3)}}},
                 {"conversions", conversions(solution.conversions)},
                 {"source_order", order_of_source(plan)},
                 {"distributions", solution.distributions},
                 {"systems", solution.systems},
                 {"condition", solution.condition ? ordered_json(*solution.condition) : ordered_json()},
                 {"lower", solution.lower ? ordered_json(*solution.lower) : ordered_json()},
                 {"classical", compared_law(plan)},
                 {"active_set", plan.source_law ? ordered_json{{"objective", plan.source_law->value.objective},
                                                               {"degree", plan.source_law->law.max_degree()}}
                                                : ordered_json()},
                 {"spectrum", spectrum(plan)},
                 {"notes", notes}};
  out.summary = {{"objective", solution.value.objective},
                 {"peak_velocity", solution.value.peaks[1].value},
                 {"peak_acceleration", solution.value.peaks[2].value},
                 {"peak_jerk", solution.value.peaks[3].value},
                 {"rms_acceleration", solution.law.rms(2)},
                 {"rms_jerk", solution.law.rms(3)},
                 {"cycle_duration", solution.cycle_duration},
                 {"stroke", positions.highest.value - positions.lowest.value},
                 {"degree", solution.law.max_degree()},
                 {"method", optimal ? "optimal" : "active_set"}};
  out.verification = verification(plan.verification);
  out.bound = {{"objective", plan.lower},
               {"gap", number_or_null(plan.lower > 0, solution.value.objective / plan.lower - 1)},
               {"basis", plan.basis}};
  if (solution.cycle_bound) {
    out.bound["cycle_duration"] = solution.cycle_bound->duration;
    out.bound["cycle_gap"] = solution.cycle_duration / solution.cycle_bound->duration - 1;
    out.bound["cycle_basis"] = solution.cycle_bound->basis;
  }
  if (plan.cam) out.details["cam"] = cam_result(*plan.cam);
  if (plan.load) {
    out.details["load"] = load_result(*plan.load, plan);
    out.summary["peak_load"] = plan.load->figures.peak(), out.summary["rms_load"] = plan.load->figures.rms;
  }
  return out;
}

}  // namespace bahnwerk::api::motion_law
