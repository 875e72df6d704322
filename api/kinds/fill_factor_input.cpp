// The spec of kind "fill_factor" → slot, wires, options.
#include "api/kinds/fill_factor_input.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kinds/fill_factor.hpp"
#include "core/base/errors.hpp"
#include "core/winding/layout/count_bound.hpp"
#include "core/winding/slot/coil_sides.hpp"

namespace bahnwerk::api::fill_factor {
namespace {

using nlohmann::json;

constexpr double degree = std::numbers::pi / 180;

Point point(const json& value) { return {value[0].get<double>(), value[1].get<double>()}; }

winding::StatorSlot stator(const json& s) {
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

winding::RotorSlot rotor(const json& s) {
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

winding::PolygonSlot polygon(const json& s) {
  winding::PolygonSlot slot;
  for (const auto& p : s["points"]) slot.points.push_back(point(p));
  slot.liner = s.value("liner", 0.0);
  slot.corner_radius = s.value("corner_radius", 0.0);
  if (s.contains("opening")) slot.opening = {point(s["opening"][0]), point(s["opening"][1])};
  return slot;
}

winding::Slot slot(const json& s, Progress* progress) {
  if (s["type"] == "stator") return make_slot(stator(s));
  if (s["type"] == "rotor") return make_slot(rotor(s));
  return make_slot(polygon(s), progress);
}

/// Members of `heads` for one type of slot.
class HeadReader {
 public:
  HeadReader(const json& heads, std::vector<InputFault>& faults) : heads_(heads), faults_(faults) {}

  void take(const char* member, double& value, double unit = 1) {
    known_.emplace_back(member);
    if (const auto v = given<double>(heads_, member)) value = unit * *v;
  }
  void take(const char* member, int& value) {
    known_.emplace_back(member);
    if (const auto v = given<int>(heads_, member)) value = *v;
  }
  void finish(const std::string& type) {
    for (const auto& [member, value] : heads_.items())
      if (std::find(known_.begin(), known_.end(), member) == known_.end())
        faults_.push_back({{"heads", member}, "does not belong to " + type});
  }

 private:
  const json& heads_;
  std::vector<InputFault>& faults_;
  std::vector<std::string> known_;
};

winding::StatorHeads stator_heads(const json& heads, const winding::StatorSlot& slot, std::vector<InputFault>& faults) {
  constexpr double behind_base = 99.971 - 95.7;  // [Herrmann Table 4.3]
  winding::StatorHeads h;
  h.base_radius = slot.base_radius + slot.liner;
  h.tool_radius = h.base_radius + behind_base;
  HeadReader reader(heads, faults);
  reader.take("slot_pitch", h.slot_pitch, degree);
  reader.take("span", h.span);
  reader.take("tool_radius", h.tool_radius);
  reader.take("tool_shift", h.tool_shift);
  reader.take("tool_height", h.tool_height);
  reader.take("stack", h.stack);
  reader.finish("a stator slot");
  if (h.tool_radius < h.base_radius)
    faults.push_back(
        {{"heads", "tool_radius"}, "lies inside the slot's base, at " + short_number(h.base_radius) + " mm"});
  if (h.span * h.slot_pitch >= std::numbers::pi)
    faults.push_back(
        {{"heads", "span"}, "takes the coil to the other side of the stator: less than half a turn is possible"});
  return h;
}

winding::RotorHeads rotor_heads(const json& heads, std::vector<InputFault>& faults) {
  winding::RotorHeads h;
  HeadReader reader(heads, faults);
  reader.take("cap_height", h.cap_height);
  reader.take("cap_base", h.cap_base);
  reader.take("stack", h.stack);
  reader.take("tooth_half_width", h.tooth_half_width);
  reader.take("tooth_radius", h.tooth_radius);
  reader.finish("a rotor slot");
  if (h.cap_height <= h.cap_base) faults.push_back({{"heads", "cap_height"}, "is no higher than the cap's grooves"});
  return h;
}

void read_algorithms(const json& spec, FillRequest& request, std::vector<InputFault>& faults) {
  json all = json::array();
  for (const auto& entry : winding::algorithms) all.push_back(entry.name);
  const json list = spec.value("algorithms", all);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto each = value_of<winding::Algorithm>(list[i].get<std::string>(), winding::algorithms);
    if (std::find(request.algorithms.begin(), request.algorithms.end(), each) != request.algorithms.end())
      faults.push_back({{"algorithms", std::to_string(i)}, "is named twice"});
    request.algorithms.push_back(each);
  }
}

void read_heads(const json& spec, FillRequest& request, std::vector<InputFault>& faults) {
  const json heads = spec.value("heads", json::object());
  if (spec["slot"]["type"] == "stator") request.heads = stator_heads(heads, stator(spec["slot"]), faults);
  if (spec["slot"]["type"] == "rotor") request.heads = rotor_heads(heads, faults);
  if (spec["slot"]["type"] == "polygon" && !heads.empty())
    faults.push_back({{"heads"}, "a polygon has no winding heads: tie_in draws all its wires"});
}

/// Usable area for one of two coil sides, and the needle that lays it.
void read_sides(const json& spec, FillRequest& request, std::vector<InputFault>& faults) {
  const bool two = spec.value("coil_sides", 1) == 2;
  const auto* stator = std::get_if<winding::StatorHeads>(&request.heads);
  const auto how = stator && stator->span > 1 ? winding::Sharing::layers : winding::Sharing::beside;
  if (two && request.slot.type != winding::Slot::Type::rotor) {
    winding::SharedSlot half = shared(request.slot, how);
    request.slot = std::move(half.slot);
    request.back = std::move(half.back);
    request.sides = 2;
  }
  const auto width = given<double>(spec, "needle_width");
  if (!width) return;
  if (!request.slot.opening) faults.push_back({{"needle_width"}, "needs the opening of the polygon, slot.opening"});
  const bool beside = two && how == winding::Sharing::beside && request.slot.type != winding::Slot::Type::rotor;
  request.needle = winding::Needle{*width, beside ? winding::Needle::Stand::left : winding::Needle::Stand::middle};
}

/// Wires that do not fit at all, more than anybody winds, turns that no layout can take. By the thinnest wire: the
/// thicker the fewer.
void check_sizes(const FillRequest& request, bool listed, std::vector<InputFault>& faults) {
  const auto thinnest =
      std::min_element(request.wires.begin(), request.wires.end(),
                       [](const winding::Wire& a, const winding::Wire& b) { return a.outer < b.outer; });
  if (thinnest == request.wires.end()) return;
  const double r = thinnest->radius();
  const std::size_t bound = winding::max_wires(request.slot.usable_area, r, 2 * r);
  if (bound == 0) faults.push_back({{"wires"}, "none of the wires fits into the slot"});
  if (bound > max_wires) {
    const std::string index = std::to_string(thinnest - request.wires.begin());
    const std::vector<std::string> place =
        listed ? std::vector<std::string>{"wires", index} : std::vector<std::string>{"wire_range", "least"};
    faults.push_back({place, "is too thin for this slot: the bound is " + short_number(static_cast<double>(bound)) +
                                 " wires, at most " + std::to_string(max_wires) + " are computed"});
  }
  if (bound == 0 || bound > max_wires || !(request.serial || request.parallel)) return;
  // Layout potential may overlap wires, by different shares of their radii.
  std::size_t most = bound;
  if (std::find(request.algorithms.begin(), request.algorithms.end(), winding::Algorithm::potential) !=
      request.algorithms.end())
    for (const winding::Wire& wire : request.wires) {
      const double overlap = allowed_overlap(request, winding::Algorithm::potential, wire);
      if (wire.outer - overlap > 2 * r) continue;  // takes no more than the thinnest without overlap
      most = std::max(most, winding::max_wires(request.slot.usable_area, wire.radius(), wire.outer - overlap));
    }
  const std::size_t needed = request.serial.value_or(1) * request.parallel.value_or(1);
  if (needed > most)
    faults.push_back({{"turns"},
                      "need " + std::to_string(needed) + " places; the slot has no more than " + std::to_string(most) +
                          ", by a proven bound"});
}

}  // namespace

FillRequest request(const json& spec, Progress* progress) {
  FillRequest request;
  request.slot = slot(spec["slot"], progress);
  std::vector<InputFault> faults;
  request.wires = wires(spec, spec.value("grade", 2), faults);
  read_algorithms(spec, request, faults);
  request.overlap_tolerance = given<double>(spec, "overlap_tolerance");
  request.seed = spec.value("seed", std::uint64_t{1});
  request.effort = spec.value("effort", 1.0);
  request.shifts = spec.value("shifts", 4);
  request.tie_in = spec.contains("tie_in") ? point(spec["tie_in"]) : request.slot.tension_point;
  read_heads(spec, request, faults);
  read_sides(spec, request, faults);
  const json turns = spec.value("turns", json::object());
  request.serial = given<std::size_t>(turns, "serial");
  request.parallel = given<std::size_t>(turns, "parallel");
  request.temperature = spec.value("temperature", 20.0);
  const json hold = spec.value("producible", json::object());
  request.producible.friction = hold.value("friction", request.producible.friction);
  request.producible.touch = hold.value("touch", request.producible.touch);
  if (spec.contains("robustness")) {
    const json& r = spec["robustness"];
    request.sampling = {r["samples"].get<int>(), given<double>(r, "wire_tolerance"), r.value("slot_tolerance", 0.0)};
  }
  // Heads that cannot be built are refused before anything is planned.
  if (faults.empty() && std::holds_alternative<winding::RotorHeads>(request.heads))
    laying_regions(request.slot, std::get<winding::RotorHeads>(request.heads));
  if (faults.empty()) check_sizes(request, spec.contains("wires") && spec["wires"].is_array(), faults);
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return request;
}

}  // namespace bahnwerk::api::fill_factor
