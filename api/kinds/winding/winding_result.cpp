#include "api/kinds/winding/winding_result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "core/machine/robot_winder.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::ordered_json;
using winding::FixedPiece;

constexpr double degrees = 180 / std::numbers::pi;

ordered_json points(const std::vector<Point>& list) {
  ordered_json out = ordered_json::array();
  for (const Point& p : list) out.push_back({p.x, p.y});
  return out;
}

ordered_json layout(const WindingRequest& request, const WindingPlan& plan) {
  const winding::Wire& wire = request.wire;
  ordered_json regions = ordered_json::object();
  for (std::size_t j = 0; j < plan.layout.size(); ++j)
    regions[laying_region(j)] = {{"positions", points(plan.layout[j].wires)},
                                 {"pulls", points(plan.layout[j].tension_points)}};
  return {{"wire", {{"copper", wire.copper}, {"outer", wire.outer}, {"tolerance", wire.tolerance}}},
          {"count", plan.layout[0].wires.size()},
          {"regions", std::move(regions)}};
}

ordered_json turns(const WindingPlan& plan) {
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < plan.turns.size(); ++i) {
    const winding::Turn& turn = plan.turns[i];
    list.push_back({{"coil", turn.coil + 1},
                    {"turn", turn.number + 1},
                    {"layer", turn.layer},
                    {"layer_jump", turn.layer_jump},
                    {"begins", plan.turn_begins.at(i)}});
  }
  return list;
}

ordered_json axes(const WindingPlan& plan) {
  ordered_json list = ordered_json::array();
  const auto& axes = plan.machine.kinematics->axes();
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const bool rotary = axes[k].unit == "rad";
    const double shown = rotary ? degrees : 1;
    const AxisSpan& span = plan.machine.spans.at(k);
    list.push_back({{"name", axes[k].name},
                    {"unit", rotary ? "deg" : axes[k].unit},
                    {"lowest", shown * span.lowest},
                    {"highest", shown * span.highest},
                    {"travel", shown * span.travel}});
  }
  return list;
}

ordered_json arm(const WindingPlan& plan) {
  const auto* robot = dynamic_cast<const RobotWinder*>(plan.machine.kinematics.get());
  if (!robot) return nullptr;
  return robot->arm() == RobotArm::lefty ? "lefty" : "righty";
}

bool takes_profile(const WindingRequest& request) { return method_row(request.feed).takes_profile; }

ordered_json notes(const WindingRequest& request, const WindingPlan& plan) {
  ordered_json list = ordered_json::array();
  // Where the wire leaves the needle at more than a right angle its tension rises [Herrmann 4.2.6].
  constexpr double right_angle = std::numbers::pi / 2 + 1e-9;
  std::size_t bent = 0, all = 0;
  double most = 0;
  for (const FixedPiece& piece : plan.support)
    for (const double angle : {piece.begin.exit_angle, piece.end.exit_angle}) {
      ++all;
      if (angle > right_angle) ++bent;
      most = std::max(most, angle);
    }
  if (bent > 0)
    list.push_back("at " + std::to_string(bent) + " of " + std::to_string(all) +
                   " support points the wire leaves the needle at more than 90 deg, at most at " +
                   std::to_string(std::lround(degrees * most)) + " deg: its tension rises there");
  if (takes_profile(request) && !speed_profile_row(request.profile).limits_jerk)
    list.push_back(std::string("profile ") + name_of<SpeedProfile>(request.profile, speed_profiles) +
                   ": the acceleration jumps where a change of speed begins and ends; no jerk limit of axes or feed is "
                   "held or verified");
  if (const double yields = winding::yield_pull(request.wire); request.model.pull.force > yields)
    list.push_back("the wire's copper yields at about " + std::to_string(std::lround(yields)) +
                   " N, less than pull.force: it is drawn thinner, and its resistance rises");
  if (request.turns > 0 && request.turns < plan.layout[0].wires.size())
    list.push_back("the slot takes " + std::to_string(plan.layout[0].wires.size()) + " turns of this wire, " +
                   std::to_string(request.turns) + " are wound");
  return list;
}

ordered_json feed_fluctuation(const WindingPlan& plan) {
  ordered_json list = ordered_json::object();
  std::size_t i = 0;
  for (const auto& row : interpolators) {
    const FeedFluctuation& f = plan.fluctuation.at(i++);
    list[row.name] = {
        {"mean", f.mean}, {"largest", f.largest}, {"chord_mean", f.chord_mean}, {"chord_largest", f.chord_largest},
        {"lag", f.lag},   {"drift", f.drift}};
  }
  return list;
}

ordered_json wire(const WindingRequest& request, const WindingPlan& plan) {
  constexpr double density = 8.96e-3;  // g/mm³, of copper [IEC 60028: 8.89e-3 to 8.96e-3]
  const WireFigures& w = plan.wire;
  const double copper = request.wire.copper;
  return {{"length", plan.wire_length},
          {"copper_mass", density * std::numbers::pi / 4 * copper * copper * plan.wire_length},
          {"permitted", request.tension.permitted},
          {"peak", w.peak},
          {"least", w.least},
          {"peak_at_constant_brake", w.constant_peak},
          {"least_at_constant_brake", w.constant_least},
          {"speed", w.speed},
          {"taken_back", w.taken_back},
          {"acceleration", w.acceleration}};
}

/// From a turn's begin to the next one's, or to the end.
ordered_json turn_time(const WindingPlan& plan) {
  const auto& begins = plan.turn_begins;
  double least = unlimited, most = 0;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const double time = (i + 1 < begins.size() ? begins[i + 1] : plan.motion.motion->duration()) - begins[i];
    least = std::min(least, time), most = std::max(most, time);
  }
  return {
      {"least", least}, {"mean", plan.motion.motion->duration() / static_cast<double>(begins.size())}, {"most", most}};
}

/// Where the tool's path is at parameter `v` of a piece, mm.
double path_length(const Path& tool, std::size_t piece, double v) {
  for (std::size_t i = 0; i < tool.size(); ++i)
    if (tool[i].source() == piece && v <= tool[i].curve().end()) return tool[i].arc_length(v);
  return tool.length();
}

}  // namespace

const char* laying_region(std::size_t region) {
  static constexpr const char* names[] = {"slot", "head_bottom", "slot_back", "head_top"};
  return names[region];
}

const char* laying_region(const FixedPiece& piece) {
  return piece.kind == FixedPiece::Kind::coil_change ? "coil_change" : laying_region(piece.region);
}

ordered_json clearance(const WindingPlan& plan) {
  const winding::Clearance& least = plan.clearance;
  if (!(least.minimum < unlimited)) return nullptr;
  const winding::NeedlePiece& piece = plan.path.pieces.at(least.move);
  const FixedPiece& fixed = plan.support.at(piece.fixed);
  return {{"minimum", least.minimum}, {"coil", fixed.coil + 1},
          {"turn", fixed.turn + 1},   {"region", laying_region(fixed)},
          {"link", piece.link},       {"at", path_length(plan.tool->tool, least.move, least.at)},
          {"along", least.along},     {"nearest", plan.nearest}};
}

ordered_json link_times(const WindingPlan& plan) {
  if (!plan.link_times) return nullptr;
  const LinkTimes& times = *plan.link_times;
  const auto seconds = [](double time) { return std::isfinite(time) ? ordered_json(time) : ordered_json(); };
  return {{"curvature", seconds(times.curvature)},
          {"control_distance", seconds(times.control_distance)},
          {"minimum_time", seconds(times.minimum_time)},
          {"changed", times.changed},
          {"taken", name_of<LinkChoice>(times.taken, link_choices)}};
}

ordered_json details(const WindingRequest& request, const WindingPlan& plan, Progress& progress) {
  return {{"feed", name_of<PlanningMethod>(request.feed, feed_methods)},
          {"law", request.feed == PlanningMethod::jerk_limited ? ordered_json(name_of<FeedLaw>(request.law, feed_laws))
                                                               : ordered_json()},
          {"profile", takes_profile(request) ? ordered_json(name_of<SpeedProfile>(request.profile, speed_profiles))
                                             : ordered_json()},
          {"fastest", plan.fastest},
          {"jerk", {{"along", plan.jerk.along}, {"total", plan.jerk.total}, {"at", plan.jerk.at}}},
          {"interpolator", name_of<Interpolator>(request.interpolator, interpolators)},
          {"feed_fluctuation", feed_fluctuation(plan)},
          {"wire", wire(request, plan)},
          {"turn_time", turn_time(plan)},
          {"law_pieces", plan.motion.pieces},
          {"notes", notes(request, plan)},
          {"arm", arm(plan)},
          {"axes", axes(plan)},
          {"clearance", clearance(plan)},
          {"layout", layout(request, plan)},
          {"turns", turns(plan)},
          {"support_points", support_points(plan, progress)},
          {"path", path(request, plan, progress)},
          {"links", links(request, plan, progress)},
          {"link_times", link_times(plan)}};
}

Verification in_degrees(Verification verdict) {
  for (Check& check : verdict.checks) {
    if (!check.unit.starts_with("rad")) continue;
    check.unit.replace(0, 3, "deg");
    check.limit *= degrees, check.value *= degrees;
  }
  return verdict;
}

}  // namespace bahnwerk::api::winding_kind
