#include "api/kinds/contour/coarse_fine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "api/check_text.hpp"
#include "api/kinds/kind_frame.hpp"
#include "api/limits_input.hpp"
#include "core/redundant/joint/joint.hpp"
#include "core/redundant/known/lag_compensation.hpp"
#include "core/redundant/methods/method_table.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t max_slowed_listed = 1000;
constexpr double cells_per_time =
    24;  // cells per time √(stroke/coarse acceleration), the default of JointOptions::cell

constexpr const char* axis_names[] = {"x", "y", "z"};

bool given(const json& object, const char* name) { return object.contains(name) && !object[name].is_null(); }

const json& redundancy_of(const json& spec) {
  static const json none = json::object();
  return spec["machine"].contains("redundancy") ? spec["machine"]["redundancy"] : none;
}

RedundancyMethod method_of(const json& spec) {
  return value_of<RedundancyMethod>(redundancy_of(spec).value("method", "joint"), redundancy_methods);
}

ordered_json per_axis(const CoarseFineMachine& machine, const std::vector<double>& values) {
  ordered_json object = ordered_json::object();
  for (std::size_t k = 0; k < machine.axes.size(); ++k)
    object[machine.axes[k].name] = k < values.size() ? values[k] : 0.0;  // the others stand still
  return object;
}

ordered_json passes(const CoarseFinePlan& plan) {
  ordered_json list = ordered_json::array();
  for (const RedundancyIteration& pass : plan.passes) {
    ordered_json peaks = ordered_json::array();
    for (const RedundancyPeaks& p : pass.peaks)
      peaks.push_back({{"offset", p.offset},
                       {"coarse_velocity", p.coarse_velocity},
                       {"coarse_acceleration", p.coarse_acceleration},
                       {"fine_velocity", p.fine_velocity},
                       {"fine_acceleration", p.fine_acceleration}});
    list.push_back(
        {{"duration", pass.duration}, {"violated_blocks", pass.violated_blocks}, {"peaks", std::move(peaks)}});
  }
  return list;
}

ordered_json slowed(const CoarseFinePlan& plan, bool program) {
  ordered_json list = ordered_json::array();
  for (const CoarseFinePlan::Slowed& s : plan.slowed) {
    if (list.size() == max_slowed_listed) break;
    list.push_back({{program ? "line" : "segment", s.source},
                    {"length", s.length},
                    {"feed", std::isfinite(s.feed) ? ordered_json(s.feed) : ordered_json()}});
  }
  return list;
}

/// Returns the table of plans that gave way; a duration of a plan that does not exist is null.
ordered_json gave_way(const std::vector<GaveWay>& rows) {
  const auto seconds = [](double t) { return t > 0 ? ordered_json(t) : ordered_json(); };
  ordered_json list = ordered_json::array();
  for (const GaveWay& row : rows) {
    list.push_back({{"planner", row.planner},
                    {"reason", name_of<GivingWay>(row.reason, reasons_to_give_way)},
                    {"duration", seconds(row.duration)},
                    {"used", row.used},
                    {"used_duration", seconds(row.used_duration)}});
    if (row.failed)
      list.back()["failed"] = {
          {"name", check_name(*row.failed)},
          {"unit", check_unit(*row.failed)},
          {"limit", row.failed->limit},
          {"value", std::isfinite(row.failed->value) ? ordered_json(row.failed->value) : ordered_json()}};
  }
  return list;
}

ordered_json slow_sections(const CoarseFinePlan& plan, bool program) {
  ordered_json list = ordered_json::array();
  for (const SectionGap& s : plan.slow_sections)
    list.push_back({{program ? "line" : "segment", s.source},
                    {"length", s.length},
                    {"time", s.time},
                    {"bound", s.bound},
                    {"gap", s.gap}});
  return list;
}

}  // namespace

bool coarse_fine(const json& spec) { return spec["machine"].value("kinematics", "cartesian") == "coarse_fine"; }

CoarseFineMachine coarse_fine_machine(const json& spec) {
  const json& document = spec["machine"];
  CoarseFineMachine machine;
  machine.cycle_time = document.value("cycle_time", machine.cycle_time);
  std::vector<InputFault> faults;
  bool some_jerk = false;
  for (const char* stage : {"coarse", "fine"})
    for (const auto& [name, axis] : document[stage].items()) {
      some_jerk |= given(axis, "jerk");
      if (stage == std::string("fine") && !document["coarse"].contains(name))
        faults.push_back({{"machine", "coarse", name}, "is required: there is one among the fine axes"});
    }
  if (some_jerk)
    for (const char* stage : {"coarse", "fine"})
      for (const auto& [name, axis] : document[stage].items())
        if (!given(axis, "jerk"))
          faults.push_back({{"machine", stage, name, "jerk"},
                            "is required: jerk is limited of all coarse and fine axes or of none"});
  for (const auto& [name, axis] : document["coarse"].items())
    if (given(axis, "range") && !(axis["range"][0].get<double>() < axis["range"][1].get<double>()))
      faults.push_back({{"machine", "coarse", name, "range"}, "must go from the lower end to the higher one, mm"});
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  for (const char* name : axis_names)
    if (document["coarse"].contains(name)) {
      CoarseFineAxis axis{name, read_limits(document["coarse"][name]), {}, 0};
      if (document["fine"].contains(name)) {
        const json& fine = document["fine"][name];
        axis.fine = read_limits(fine), axis.stroke = fine["stroke"].get<double>();
        axis.centred = fine.value("at_rest", "free") == "centred";
      }
      machine.axes.push_back(axis.stroke > 0 ? axis : coarse_alone(axis));
    }
  return machine;
}

RedundancyOptions redundancy(const json& spec, const ContourPlanning& planning) {
  const json& document = redundancy_of(spec);
  RedundancyOptions options;
  options.method = method_of(spec);
  options.corner_angle = planning.corner_angle;
  options.keep_reserve = planning.method == PlanningMethod::braking_reserve;
  options.braking_reserve = planning.braking_reserve;
  options.smoothness = document.value("smoothness", options.smoothness);
  if (given(document, "stretch")) options.stretch = document["stretch"].get<double>();
  options.compare = document.value("trades", options.compare);
  if (document.contains("approximation"))
    options.approximation =
        value_of<CoarseApproximation>(document["approximation"].get<std::string>(), coarse_approximations);
  if (document.contains("smoothing"))
    options.smoothing = value_of<CoarseSmoothing>(document["smoothing"].get<std::string>(), coarse_smoothings);
  options.degree = document.value("degree", options.degree);
  options.knot_multiplicity = document.value("knot_multiplicity", options.knot_multiplicity);
  options.afterburner = document.value("afterburner", options.afterburner);
  if (given(document, "window")) {
    RedundancyOptions::Window window;
    window.blocks = document["window"].value("blocks", window.blocks);
    window.overlap = document["window"].value("overlap", window.overlap);
    options.window = window;
  }
  options.thinning = document.value("thinning", options.thinning);
  options.reparametrise = document.value("reparametrise", options.reparametrise);
  options.taps = document.value("taps", options.taps);
  options.cutoff = document.value("cutoff", options.cutoff);
  options.coarse_lag = document.value("coarse_time_constant", options.coarse_lag);
  options.fine_lag = document.value("fine_time_constant", options.fine_lag);
  return options;
}

void check_redundancy(const json& spec, const CoarseFineMachine& machine, const ContourPlanning& planning,
                      std::vector<InputFault>& faults) {
  const json& document = redundancy_of(spec);
  const RedundancyMethod method = method_of(spec);
  const auto fault = [&](std::vector<std::string> place, std::string message) {
    faults.push_back({std::move(place), std::move(message)});
  };
  if (machine.limited_order() > redundancy_row(method).order)
    fault({"machine", "redundancy", "method"}, "does not limit the jerk; the methods joint and iterative do");
  if (machine.limited_order() == 3 && document.value("reparametrise", false))
    fault({"machine", "redundancy", "reparametrise"}, "does not limit the jerk, as the machine demands");
  if (document.value("taps", RedundancyOptions{}.taps) % 2 == 0)
    fault({"machine", "redundancy", "taps"}, "must be odd: the filter's delay is whole cycles");
  if (!(document.value("fine_time_constant", RedundancyOptions{}.fine_lag) <
        document.value("coarse_time_constant", RedundancyOptions{}.coarse_lag)))
    fault({"machine", "redundancy", "fine_time_constant"}, "must be less than the coarse axes' time constant");
  if (method != RedundancyMethod::joint && document.value("smoothness", 0.0) > 0)
    fault({"machine", "redundancy", "smoothness"}, "belongs to method joint");
  if (given(document, "stretch") && method != RedundancyMethod::joint)
    fault({"machine", "redundancy", "stretch"}, "belongs to method joint");
  if (given(document, "stretch") && document.value("smoothness", 0.0) > 0)
    fault({"machine", "redundancy", "stretch"}, "stands in place of smoothness; give one of them");
  if (const int degree = document.value("degree", 3); document.value("knot_multiplicity", 1) > degree)
    fault({"machine", "redundancy", "knot_multiplicity"}, "must not be greater than the degree");
  if (given(document, "window") && document["window"].value("overlap", 3) >= document["window"].value("blocks", 10))
    fault({"machine", "redundancy", "window", "overlap"}, "must be less than the window's blocks");
  if (planning.method == PlanningMethod::jerk_limited && machine.limited_order() == 2)
    fault({"machine", "coarse", "x", "jerk"}, "is required by method jerk_limited, of all coarse and fine axes");
  if (std::min({planning.along.velocity, planning.along.acceleration, planning.along.jerk}) < unlimited)
    fault({"planning", "path"}, "is not held with coarse and fine axes; blocks limit the speed by their feed");
  if (planning.what_if) fault({"planning", "what_if"}, "is not available with coarse and fine axes; machine_study is");
}

double least_stroke(const CoarseFineMachine& machine, double shortest) {
  double least = RedundancyOptions{}.least_stroke;
  for (const CoarseFineAxis& axis : machine.axes) {
    const double time = cells_per_time * shortest / max_cells;  // √(stroke/coarse acceleration) with as many cells
    least = std::max(least, axis.coarse.acceleration * time * time);
  }
  return least;
}

std::vector<std::string> unresolved_strokes(const CoarseFineMachine& machine, double least) {
  std::vector<std::string> notes;
  for (const CoarseFineAxis& axis : machine.axes) {
    if (!(axis.stroke > 0) || axis.stroke >= least) continue;
    char note[240];
    if (axis.stroke < RedundancyOptions{}.least_stroke) {
      std::snprintf(note, sizeof note,
                    "fine axis %s stands still wherever no closed form moves it: a stroke below %g mm is too short to "
                    "plan",
                    axis.name.c_str(), RedundancyOptions{}.least_stroke);
      notes.emplace_back(note);
      continue;
    }
    std::snprintf(
        note, sizeof note,
        "fine axis %s stands still wherever no closed form moves it: in a motion as long as this one a stroke "
        "below %.3g mm is too short to plan; split the contour into shorter ones to use it",
        axis.name.c_str(), least);
    notes.emplace_back(note);
  }
  return notes;
}

std::vector<std::string> unused_options(const json& spec) {
  std::vector<std::string> notes;
  if (method_of(spec) != RedundancyMethod::joint) return notes;
  for (const char* name :
       {"approximation", "smoothing", "degree", "knot_multiplicity", "afterburner", "window", "thinning"})
    if (given(redundancy_of(spec), name))
      notes.push_back(std::string("redundancy.") + name + " is given but plays no part in method joint");
  if (spec.contains("planning"))
    if (spec["planning"].value("method", "") == "braking_reserve" || spec["planning"].contains("braking_reserve"))
      notes.push_back("the braking reserve is given but not kept: method joint plans the shortest motion");
  return notes;
}

void report(const CoarseFinePlan& plan, const CoarseFineMachine& machine, RedundancyMethod method, bool program,
            KindReport& out) {
  out.summary["coarse_smoothness"] = per_axis(machine, plan.energy);
  out.summary["peak_coarse_acceleration"] = per_axis(machine, plan.peak_coarse_acceleration);
  out.summary["rms_acceleration"] = {{"coarse", per_axis(machine, plan.rms.coarse)},
                                     {"fine", per_axis(machine, plan.rms.fine)}};
  ordered_json trades = ordered_json::array();
  for (const RedundancyTrade& trade : plan.trades)
    trades.push_back({{"stretch", trade.stretch},
                      {"duration", trade.duration},
                      {"coarse_smoothness", per_axis(machine, trade.energy)}});
  ordered_json lags = ordered_json::array();
  for (const RedundancyLag& lag : plan.lags)
    lags.push_back({{"prefilter", lag.prefilter},
                    {"following_error", lag.following_error},
                    {"contour_error", lag.contour_error},
                    {"overshoot", lag.overshoot},
                    {"circle_growth", lag.circle_growth}});
  out.details["redundancy"] = {{"method", name_of<RedundancyMethod>(method, redundancy_methods)},
                               {"fastest", plan.fastest},
                               {"trades", std::move(trades)},
                               {"passes", passes(plan)},
                               {"slowed_count", plan.slowed_count},
                               {"slowed", slowed(plan, program)},
                               {"slow_sections", slow_sections(plan, program)},
                               {"certificates", plan.certified},
                               {"fallbacks", plan.gave_way.size()},
                               {"coarse_jerk_limited", plan.coarse_jerk_limited}};
  if (!lags.empty()) out.details["redundancy"]["lags"] = std::move(lags);
  if (!plan.gave_way.empty()) out.summary["gave_way"] = gave_way(plan.gave_way);
}

std::vector<StudyRequest> study_requests(const json& spec) {
  if (!spec.contains("planning") || !spec["planning"].contains("machine_study")) return {};
  const json& document = spec["planning"]["machine_study"];
  if (document.is_boolean()) return document.get<bool>() ? usual_studies() : std::vector<StudyRequest>();
  std::vector<StudyRequest> requests;
  for (const auto& quantity : studied_quantities)
    if (document.contains(quantity.name))
      requests.push_back({quantity.value, document[quantity.name].is_array()
                                              ? document[quantity.name].get<std::vector<double>>()
                                              : std::vector<double>()});
  return requests;
}

void report_prefilter(const RedundancyOptions& options, double cycle_time, KindReport& out) {
  const Prefilter v = prefilter(options.coarse_lag, options.fine_lag, cycle_time);
  out.details["redundancy"]["prefilter"] = {{"numerator", v.numerator},
                                            {"denominator", v.denominator},
                                            {"cycle_time", cycle_time},
                                            {"b", v.b},
                                            {"a", {1.0, v.a1}}};
}

void check_range(const CoarseFineMachine& machine, const Contour& contour, std::vector<InputFault>& faults) {
  constexpr int places = 32;  // places per curve
  for (std::size_t k = 0; k < std::min(machine.axes.size(), contour.dimension); ++k) {
    const CoarseFineAxis& axis = machine.axes[k];
    double least = unlimited, most = -unlimited;
    for (std::size_t i = 0; i < contour.path.size(); ++i) {
      const Curve& curve = contour.path[i].curve();
      const int looks = contour.path[i].straight() ? 1 : places;
      for (int j = 0; j <= looks; ++j) {
        const Vec p = curve.at(curve.begin() + (curve.end() - curve.begin()) * j / looks).value;
        const double x = k == 0 ? p.x : k == 1 ? p.y : p.z;
        least = std::min(least, x), most = std::max(most, x);
      }
    }
    const double low = axis.coarse.lowest - axis.stroke, high = axis.coarse.highest + axis.stroke;
    if (least >= low && most <= high) continue;
    char text[300];
    std::snprintf(
        text, sizeof text,
        "ends before the tool does: the contour goes from %.6g to %.6g mm, the coarse axis from %.6g to %.6g mm "
        "and the fine one %.6g mm beyond; move the contour or widen the range",
        least, most, axis.coarse.lowest, axis.coarse.highest, axis.stroke);
    faults.push_back({{"machine", "coarse", axis.name, "range"}, text});
  }
}

/// Returns text such as "velocity xc 2476 mm/s, limit 1800 mm/s".
static std::string against_limit(const Check& check) {
  char text[200];
  const std::string name = check_name(check), unit = check_unit(check);
  std::snprintf(text, sizeof text, "%s %.6g %s, limit %.6g %s", name.c_str(), check.value, unit.c_str(), check.limit,
                unit.c_str());
  return text;
}

void report(const MachineStudy& study, double duration, KindReport& out) {
  ordered_json& tables = out.details["redundancy"]["machine_study"] = ordered_json::object();
  for (const Study& table : study) {
    ordered_json list = ordered_json::array();
    for (const StudiedMachine& m : table.machines) {
      list.push_back({{"value", m.value},
                      {"duration", m.duration ? ordered_json(*m.duration) : ordered_json()},
                      {"ratio", m.duration ? ordered_json(*m.duration / duration) : ordered_json()}});
      if (!m.note.empty()) list.back()["note"] = m.failed ? m.note + ": " + against_limit(*m.failed) : m.note;
    }
    tables[name_of<StudiedQuantity>(table.quantity, studied_quantities)] = std::move(list);
  }
}

}  // namespace bahnwerk::api::contour
