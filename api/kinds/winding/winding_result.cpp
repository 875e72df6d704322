#include "api/kinds/winding/winding_result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "api/slot/slot_input.hpp"
#include "api/slot/windable_result.hpp"
#include "core/base/number_text.hpp"
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
  const std::size_t wanted = wires_per_coil(request, plan);
  ordered_json regions = ordered_json::object();
  for (std::size_t j = 0; j < plan.layout.size(); ++j)
    regions[laying_region(j)] = {{"positions", points(plan.layout[j].wires)},
                                 {"pulls", points(plan.layout[j].tension_points)}};
  return {{"wire", {{"copper", wire.copper}, {"outer", wire.outer}, {"tolerance", wire.tolerance}}},
          {"count", plan.layout[0].wires.size()},
          {"producible", plan.windable.can_be_wound(wanted)},
          {"blocked_by", blocked_by(plan.windable, wanted)},
          {"slips", slips(plan.windable, wanted)},
          {"windable", windable(plan.windable, request.parallel, plan.layout[0].wires.size())},
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

/// Reports which wires of the layout cannot be wound, and how many turns can.
void add_windable_notes(const WindingRequest& request, const WindingPlan& plan, ordered_json& list) {
  const std::size_t wanted = wires_per_coil(request, plan);
  if (plan.windable.can_be_wound(wanted)) return;
  const std::string holds =
      ": " + std::to_string(plan.windable.most() / request.parallel) + " turns of this layout can be wound";
  if (const auto slip = plan.windable.producible_among(wanted).first)
    list.push_back(slip->reason == winding::Producible::Reason::pushed_out
                       ? "wire " + std::to_string(slip->wire + 1) + " is pushed out when wire " +
                             std::to_string(slip->laid + 1) + " is laid" + holds
                       : "wire " + std::to_string(slip->wire + 1) + " has no support where it is laid" + holds);
  for (const auto& each : plan.windable.blocked_among(wanted))
    if (each.part == winding::Obstruction::Part::channel)
      list.push_back("a needle of " + short_number(request.needle.width) +
                     " mm that does not swivel has no way to wire " + std::to_string(each.wire + 1) + " in the " +
                     (each.back ? "second" : "first") + " slot past those laid before" + holds);
}

ordered_json notes(const WindingRequest& request, const WindingPlan& plan) {
  ordered_json list = ordered_json::array();
  // Where the wire leaves the needle at more than a right angle its tension rises [Herrmann 4.2.6]. Angles that a tenth
  // of a degree, as the note tells them, does not distinguish from it do not count.
  constexpr double right_angle = 90.05 / degrees;
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
                   number_text(std::round(10 * degrees * most) / 10, 4) + " deg: its tension rises there");
  if (takes_profile(request) && speed_profile_row(request.profile).order == 2)
    list.push_back(std::string("profile ") + name_of<SpeedProfile>(request.profile, speed_profiles) +
                   ": the acceleration jumps where a change of speed begins and ends; no jerk limit of axes or feed is "
                   "held or verified");
  if (const double yields = winding::yield_pull(request.wire); request.model.pull.force > yields)
    list.push_back("the wire's copper yields at about " + short_number(yields) +
                   " N, less than pull.force: it is drawn thinner, and its resistance rises");
  if (request.parallel > 1)
    list.push_back(
        std::to_string(request.parallel) +
        " wires in hand: the needle goes through the middle of the places of each turn; pull.force is that of "
        "one wire");
  if (plan.clearance.minimum < 0)
    list.push_back((request.least_clearance < 0 ? "needle.clearance is negative: the" : "the") +
                   std::string(" needle of this plan reaches ") + short_number(-plan.clearance.minimum) +
                   " mm into what it must not touch");
  const std::size_t places = plan.layout[0].wires.size() / request.parallel;
  if (request.turns > 0 && request.turns < places)
    list.push_back("the slot takes " + std::to_string(places) + " turns of this wire, " +
                   std::to_string(request.turns) + " are wound");
  add_windable_notes(request, plan, list);
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
          {"force", request.tension.force},
          {"bears", request.bears},
          {"permitted", request.tension.permitted},
          {"peak", w.peak},
          {"least", w.least},
          {"peak_at_constant_brake", w.constant_peak},
          {"least_at_constant_brake", w.constant_least},
          {"speed", w.speed},
          {"taken_back", w.taken_back},
          {"acceleration", w.acceleration}};
}

/// Returns the least, mean and largest duration of a turn, s, from its begin to the next one's, or to the end.
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

}  // namespace

std::size_t wires_per_coil(const WindingRequest& request, const WindingPlan& plan) {
  return plan.turns.size() / request.coils.size() * request.parallel;
}

const char* laying_region(std::size_t region) {
  static constexpr const char* names[] = {"slot", "head_bottom", "slot_back", "head_top"};
  return names[region];
}

const char* laying_region(const FixedPiece& piece) {
  return piece.kind == FixedPiece::Kind::coil_change ? "coil_change" : laying_region(piece.region);
}

namespace {

ordered_json clearance_curve(const WindingPlan& plan) {
  const ClearanceCurve& curve = plan.clearance_curve;
  return {{"tolerance", curve.tolerance},  {"most", curve.enough},    {"obstacles", curve.names},
          {"times", plan.clearance_times}, {"lengths", curve.bounds}, {"values", curve.least},
          {"nearest", curve.nearest}};
}

}  // namespace

ordered_json clearance(const WindingPlan& plan) {
  const winding::Clearance& least = plan.clearance;
  if (!(least.minimum < unlimited)) return nullptr;
  const winding::NeedlePiece& piece = plan.path.pieces.at(least.move);
  const FixedPiece& fixed = plan.support.at(piece.fixed);
  return {{"minimum", least.minimum},
          {"coil", fixed.coil + 1},
          {"turn", fixed.turn + 1},
          {"region", laying_region(fixed)},
          {"link", piece.link},
          {"at", tool_length(plan.tool->tool, least.move, least.at)},
          {"along", least.along},
          {"nearest", plan.nearest},
          {"curve", clearance_curve(plan)}};
}

ordered_json link_times(const WindingRequest& request, const WindingPlan& plan) {
  if (!plan.link_times) return nullptr;
  const LinkTimes& times = *plan.link_times;
  const auto seconds = [](double time) { return std::isfinite(time) ? ordered_json(time) : ordered_json(); };
  return {{"curvature", seconds(times.curvature)},
          {"control_distance", seconds(times.control_distance)},
          {"minimum_time", seconds(times.minimum_time)},
          {"feed", name_of<PlanningMethod>(request.feed, feed_methods)},
          {"changed", times.changed},
          {"taken", name_of<LinkChoice>(times.taken, link_choices)}};
}

ordered_json details(const WindingRequest& request, const WindingPlan& plan, Progress progress) {
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
          {"link_times", link_times(request, plan)}};
}

}  // namespace bahnwerk::api::winding_kind
