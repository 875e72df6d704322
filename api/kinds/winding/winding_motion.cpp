// Path, feed, pull and needle of a spec of kind "winding".
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kinds/winding/winding_input.hpp"
#include "api/limits_input.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;

constexpr double degree = std::numbers::pi / 180;

json member(const json& spec, const char* name) { return spec.value(name, json::object()); }

}  // namespace

bool minimum_time(const json& spec) { return member(spec, "path").value("objective", "") == "minimum_time"; }

winding::LinkOptions links(const json& spec) {
  const json path = member(spec, "path");
  winding::LinkOptions options;
  take(path, "continuity", options.continuity);
  take(path, "curvature_weight", options.weights.curvature);
  take(path, "curvature_rate_weight", options.weights.rate);
  take(path, "extra_point", options.extra_point);
  if (path.value("objective", "curvature") == "control_distance") options.objective = LinkObjective::control_distance;
  return options;
}

winding::NeedleModel needle_model(const json& spec, const winding::Wire& wire) {
  const json pull = member(spec, "pull"), needle = member(spec, "needle");
  winding::NeedleModel model;
  const double strength = wire_strength(spec);
  model.pull.force = wire_force(spec, wire);
  model.pull.bending_moment = winding::bending_moment(wire, std::min(winding::bending_stress, strength));
  take(pull, "bend_radius", model.pull.bend_radius);
  take(pull, "bending_moment", model.pull.bending_moment);
  take(pull, "free_length", model.pull.free_length);
  if (const auto limit = given<double>(needle, "pivot_limit")) model.pivot_limit = degree * *limit;
  take(needle, "change_radius", model.change_radius);
  take(needle, "change_height", model.change_height);
  return model;
}

double wire_strength(const json& spec) {
  double strength = winding::copper_strength;
  take(member(spec, "pull"), "strength", strength);
  return strength;
}

double wire_force(const json& spec, const winding::Wire& wire) {
  constexpr double usual_share = 0.1;  // part of the wire's breaking force
  return given<double>(member(spec, "pull"), "force")
      .value_or(usual_share * winding::breaking_pull(wire, wire_strength(spec)));
}

winding::TensionModel tension_model(const json& spec, const winding::Wire& wire) {
  const json pull = member(spec, "pull");
  winding::TensionModel model;
  model.force = wire_force(spec, wire);
  take(pull, "effective_mass", model.mass);
  take(pull, "friction", model.friction);
  take(pull, "brake_range", model.range);
  // Stress at which the copper yields; a wire that may become thinner can be pulled up to its breaking force.
  const double bears = winding::breaking_pull(wire, wire_strength(spec)),
               yields = std::min(winding::yield_pull(wire), bears);
  model.permitted = model.force <= yields ? yields : bears;
  take(pull, "permitted", model.permitted);
  return model;
}

winding::NeedleShape needle_shape(const json& spec) {
  const json needle = member(spec, "needle");
  winding::NeedleShape shape;
  take(needle, "width", shape.width);
  take(needle, "length", shape.length);
  return shape;
}

winding::ToolPost tool(const json& spec, const winding::StatorHeads* heads, Faults& faults) {
  winding::ToolPost post;
  const json document = member(spec, "tool");
  if (!heads) {
    if (!document.empty()) faults.push_back({{"tool"}, "belongs to a stator: a rotor is wound without winding tools"});
    return post;
  }
  post.height = heads->tool_height + winding::ToolPost{}.height - winding::StatorHeads{}.tool_height;
  take(document, "width", post.width);
  take(document, "thickness", post.thickness);
  take(document, "height", post.height);
  if (post.thickness >= heads->tool_radius)
    faults.push_back({{"tool", "thickness"}, "reaches the stator's axis: less than part.tool_radius is possible"});
  return post;
}

void read_feed(const json& spec, WindingRequest& request, Faults& faults) {
  const json feed = member(spec, "feed");
  request.feed = value_of<PlanningMethod>(feed.value("method", "optimised"), feed_methods);
  request.law = value_of<FeedLaw>(feed.value("law", "convex"), feed_laws);
  if (request.law == FeedLaw::bspline && request.feed != PlanningMethod::jerk_limited)
    faults.push_back({{"feed", "law"}, "belongs to feed.method optimised: the other methods have their own"});
  request.profile = value_of<SpeedProfile>(feed.value("profile", "double_s"), speed_profiles);
  take_limits(feed, request.along);
  take(feed, "tolerance", request.feed_tolerance);
  take(feed, "chord_tolerance", request.chord_tolerance);
  take(feed, "half_speed_curvature", request.half_speed_curvature);
  if (request.half_speed_curvature < unlimited && !(request.along.velocity < unlimited))
    faults.push_back({{"feed", "half_speed_curvature"}, "needs feed.velocity, of which half is allowed there"});
}

}  // namespace bahnwerk::api::winding_kind
