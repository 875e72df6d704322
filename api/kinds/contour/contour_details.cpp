#include "api/kinds/contour/contour_details.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "core/machine/limits.hpp"
#include "core/plan/planning_method.hpp"

namespace bahnwerk::api::contour {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t max_blocks_listed = 10'000;  // GET …/blocks has all
constexpr std::size_t max_joints_listed = 1000;    // a fine polyline passes as many as it has points

/// Returns "feed", "velocity x", "acceleration y", "path jerk", "dwell"; empty if there is none.
std::string name(const ActiveLimit& limit) {
  switch (limit.kind) {
    case ActiveLimit::Kind::none:
      return {};
    case ActiveLimit::Kind::feed:
      return "feed";
    case ActiveLimit::Kind::axis:
      return std::string(derivative_name(limit.order)) + " " + limit.axis;
    case ActiveLimit::Kind::path:
      return std::string("path ") + derivative_name(limit.order);
    case ActiveLimit::Kind::dwell:
      return "dwell";
  }
  return {};
}

/// Returns text such as "line 1204: 14 % of the time, acceleration y, stops".
std::string sentence(const SlowLine& line, const char* what) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %zu: %.*f %% of the time", what, line.source, line.share < 0.1 ? 1 : 0,
                100 * line.share);
  std::string all = text;
  if (const std::string limit = name(line.limit); !limit.empty()) all += ", " + limit;
  if (line.stops && line.limit.kind != ActiveLimit::Kind::dwell) all += ", stops";
  return all;
}

/// Reports the lines that take most time. Only programs have lines; elsewhere it is the segment's number, from 0.
ordered_json slowest(const ContourPlan& plan, bool program) {
  ordered_json list = ordered_json::array();
  const char* const what = program ? "line" : "segment";
  for (const SlowLine& line : plan.slow_lines) {
    const std::string limit = name(line.limit);
    list.push_back({{what, line.source},
                    {"time", line.time},
                    {"share", line.share},
                    {"length", line.length},
                    {"feed", std::isfinite(line.feed) ? ordered_json(line.feed) : ordered_json()},
                    {"limit", limit.empty() ? ordered_json() : ordered_json(limit)},
                    {"limit_share", line.limit_share},
                    {"stops", line.stops},
                    {"text", sentence(line, what)}});
  }
  return list;
}

/// Reports the gaps of sections between two rests, which show where the plan is farthest from its bound.
ordered_json sections(const ContourPlan& plan, bool program) {
  const SectionGaps& s = plan.sections;
  if (s.count == 0) return {{"count", 0}, {"median_gap", nullptr}, {"worst", nullptr}};
  return {{"count", s.count},
          {"median_gap", s.median},
          {"worst",
           {{program ? "line" : "segment", s.worst.source},
            {"length", s.worst.length},
            {"time", s.worst.time},
            {"bound", s.worst.bound},
            {"gap", s.worst.gap}}}};
}

/// Returns text such as "half the jerk: 12.31 s, 4.2 % more".
std::string sentence(const WhatIf& answer, const char* change, double planned) {
  if (!answer.duration) return std::string(change) + ": cannot be planned";
  const double more = 100 * (*answer.duration / planned - 1);
  char text[120];
  if (std::abs(more) < 1e-6) {
    std::snprintf(text, sizeof text, "%s: %.6g s, no change", change, *answer.duration);
    return text;
  }
  std::snprintf(text, sizeof text, "%s: %.6g s, %.2g %% %s", change, *answer.duration, std::abs(more),
                more < 0 ? "less" : "more");
  return text;
}

ordered_json what_if(const ContourPlan& plan) {
  ordered_json list = ordered_json::array();
  for (const WhatIf& answer : plan.what_if) {
    const bool twice = answer.factor > 1;
    const char *limit = "tolerance", *change = "twice the tolerance";
    if (answer.what == WhatIf::What::jerk) limit = "jerk", change = twice ? "twice the jerk" : "half the jerk";
    if (answer.what == WhatIf::What::acceleration) limit = "acceleration", change = "half the accelerations";
    list.push_back({{"limit", limit},
                    {"factor", answer.factor},
                    {"duration", answer.duration ? ordered_json(*answer.duration) : ordered_json()},
                    {"ratio", answer.duration ? ordered_json(*answer.duration / plan.duration) : ordered_json()},
                    {"text", sentence(answer, change, plan.duration)}});
  }
  return list;
}

}  // namespace

ordered_json details(const ContourPlan& plan, const Machine& machine, const ContourPlanning& planning, bool program) {
  ordered_json blocks = ordered_json::array(), joints = ordered_json::array();
  for (const auto& block : plan.blocks) {
    if (blocks.size() == max_blocks_listed) break;
    blocks.push_back({{"mode", block.mode == Mode::cut ? "cut" : "position"},
                      {"start_time", block.start_time},
                      {"end_time", block.end_time},
                      {"length", block.length}});
  }
  for (const auto& joint : plan.joints) {
    if (joints.size() == max_joints_listed) break;
    ordered_json step = ordered_json::object();
    for (std::size_t k = 0; k < joint.step.size(); ++k) step[machine.axes[k].name] = joint.step[k];
    joints.push_back({{"s", joint.s},
                      {"angle", joint.angle * 180 / std::numbers::pi},
                      {"velocity", joint.velocity},
                      {"velocity_step", std::move(step)}});
  }
  ordered_json all = {{"method", name_of<PlanningMethod>(planning.method, planning_methods)},
                      {"law_pieces", plan.pieces},
                      {"notes", plan.notes},
                      {"blocks_total", plan.blocks.size()},
                      {"blocks", std::move(blocks)},
                      {"joints_passed", plan.joints.size()},
                      {"joints", std::move(joints)},
                      {"sections", sections(plan, program)},
                      {"slowest", slowest(plan, program)}};
  if (planning.what_if) all["what_if"] = what_if(plan);
  return all;
}

}  // namespace bahnwerk::api::contour
