#include "api/slot/slot_input.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

namespace bahnwerk::api {
namespace {

using nlohmann::json;

constexpr double degree = std::numbers::pi / 180;

}  // namespace

Place below(Place place, const std::string& member) {
  place.push_back(member);
  return place;
}

winding::StatorSlot stator_slot(const json& s) {
  winding::StatorSlot slot;
  slot.base_width = s["base_width"];
  slot.opening_width = s["opening_width"];
  slot.height = s["height"];
  slot.tip_angle = degree * s["tip_angle"].get<double>();
  slot.base_radius = s["base_radius"];
  slot.base_corner_radius = s.value("base_corner_radius", 0.0);
  slot.tip_corner_radius = s.value("tip_corner_radius", 0.0);
  slot.liner = s.value("liner", 0.0);
  slot.wedge_thickness = s.value("wedge_thickness", 0.0);
  slot.wedge_width = s.value("wedge_width", 0.0);
  return slot;
}

winding::PolygonSlot polygon_slot(const json& s) {
  const auto point = [](const json& value) { return Point{value[0].get<double>(), value[1].get<double>()}; };
  winding::PolygonSlot slot;
  for (const auto& p : s["points"]) slot.points.push_back(point(p));
  slot.liner = s.value("liner", 0.0);
  slot.corner_radius = s.value("corner_radius", 0.0);
  if (s.contains("opening")) slot.opening = {point(s["opening"][0]), point(s["opening"][1])};
  return slot;
}

winding::RotorSlot rotor_slot(const json& s) {
  winding::RotorSlot slot;
  slot.grooves = s["grooves"];
  slot.groove_radius = s["groove_radius"];
  slot.groove_pitch = s["groove_pitch"];
  slot.shoe_radius = s["shoe_radius"];
  slot.shoe_angle = degree * s["shoe_angle"].get<double>();
  slot.root_angle = degree * s["root_angle"].get<double>();
  slot.base_width = s["base_width"];
  slot.root_flank = s["root_flank"];
  slot.shoe_flank = s["shoe_flank"];
  slot.height = s["height"];
  return slot;
}

winding::StatorHeads stator_heads(const json& document, const winding::StatorSlot& slot, const Place& place,
                                  std::vector<InputFault>& faults) {
  constexpr double behind_base = 99.971 - 95.7;  // [Herrmann Table 4.3]
  winding::StatorHeads h;
  h.base_radius = slot.base_radius + slot.liner;
  take(document, "base_radius", h.base_radius);
  h.tool_radius = h.base_radius + behind_base;
  take(document, "tool_radius", h.tool_radius);
  take(document, "tool_shift", h.tool_shift);
  take(document, "tool_height", h.tool_height);
  take(document, "stack", h.stack);
  if (h.tool_radius < h.base_radius)
    faults.push_back(
        {below(place, "tool_radius"), "lies inside the slot's base, at " + short_number(h.base_radius) + " mm"});
  return h;
}

winding::RotorHeads rotor_heads(const json& document, const Place& place, std::vector<InputFault>& faults) {
  winding::RotorHeads h;
  take(document, "cap_height", h.cap_height);
  take(document, "cap_base", h.cap_base);
  take(document, "stack", h.stack);
  take(document, "tooth_half_width", h.tooth_half_width);
  take(document, "tooth_radius", h.tooth_radius);
  if (h.cap_height <= h.cap_base) faults.push_back({below(place, "cap_height"), "is no higher than the cap's grooves"});
  return h;
}

}  // namespace bahnwerk::api
