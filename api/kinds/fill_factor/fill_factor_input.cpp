// The spec of kind "fill_factor" → slot, wires, options.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "api/kinds/fill_factor/fill_factor.hpp"
#include "api/slot/slot_input.hpp"
#include "core/base/errors.hpp"
#include "core/winding/layout/count_bound.hpp"
#include "core/winding/part/part.hpp"
#include "core/winding/slot/coil_sides.hpp"

namespace bahnwerk::api::fill_factor {
namespace {

using nlohmann::json;
using winding::Wire;

/// Wires of a spec: standard ones by a range or by diameters, and arbitrary ones.
class WireReader {
 public:
  WireReader(int grade, std::vector<InputFault>& faults) : grade_(grade), faults_(faults) {}

  std::vector<Wire> read(const json& spec) {
    std::vector<Wire> wires;
    const json list = spec.value("wires", json("standard"));
    if (list.is_string()) return standard(spec.value("wire_range", json::object()));
    for (std::size_t i = 0; i < list.size(); ++i)
      if (const auto wire = read_wire(list[i], {"wires", std::to_string(i)}, grade_, faults_)) wires.push_back(*wire);
    return wires;
  }

 private:
  int grade_;
  std::vector<InputFault>& faults_;

  std::vector<Wire> standard(const json& range) {
    const auto series = range.value("series", "R20") == "R40" ? winding::Series::r40 : winding::Series::r20;
    const double least = range.value("least", 0.5), most = range.value("most", 1.6);
    auto wires = winding::standard_wires(grade_, least, most, series);
    const auto mm = [&](const char* member, double value, double other) {
      return short_number(value, other) + " mm" + (range.contains(member) ? "" : " (the default)");
    };
    if (least > most) {
      faults_.push_back(
          {{"wire_range"}, "is reversed: least is " + mm("least", least, most) + ", most " + mm("most", most, least)});
    } else if (wires.empty()) {
      faults_.push_back({{"wire_range"},
                         "holds no wire of series " + range.value("series", std::string("R20")) + "; the nearest are " +
                             neighbouring_wires(least, grade_, series)});
    }
    return wires;
  }
};

constexpr double degree = std::numbers::pi / 180;

Point point(const json& value) { return {value[0].get<double>(), value[1].get<double>()}; }

/// Reads the slot, a drawn one turned upright as kind winding has it.
void read_slot(const json& s, FillRequest& request, Progress progress) {
  if (s["type"] == "stator") {
    request.slot = make_slot(stator_slot(s));
  } else if (s["type"] == "rotor") {
    request.slot = make_slot(rotor_slot(s));
  } else {
    const winding::UprightSlot drawn = upright(polygon_slot(s), progress);
    request.slot = make_slot(drawn.slot, progress);
    request.drawn = drawn.drawn;
  }
}

/// Adds a fault for every member of `heads` that a type of slot does not have.
void allow_only(std::initializer_list<const char*> known, const json& heads, const std::string& type,
                std::vector<InputFault>& faults) {
  for (const auto& [member, value] : heads.items())
    if (std::find(known.begin(), known.end(), member) == known.end())
      faults.push_back({{"heads", member}, "does not belong to " + type});
}

/// Adds faults for a stator's heads that contradict each other.
void check_heads(const winding::StatorHeads& h, std::vector<InputFault>& faults) {
  if (2 * std::atan2(h.tool_shift, h.tool_radius) >= h.span * h.slot_pitch)
    faults.push_back({{"heads", "tool_shift"}, "lets the winding tools of the coil's two sides pass each other"});
  if (h.span * h.slot_pitch > std::numbers::pi * (1 + 1e-9))
    faults.push_back(
        {{"heads", "span"},
         "takes the coil around more than half of the stator; the shorter way has the number of slots less this span"});
}

winding::StatorHeads heads_of_stator(const json& heads, const winding::StatorSlot& slot,
                                     std::vector<InputFault>& faults) {
  allow_only({"slot_pitch", "span", "tool_radius", "tool_shift", "tool_height", "stack"}, heads, "a stator slot",
             faults);
  winding::StatorHeads h = stator_heads(heads, slot, {"heads"}, faults);
  take(heads, "slot_pitch", h.slot_pitch, degree);
  take(heads, "span", h.span);
  check_heads(h, faults);
  return h;
}

/// Reads the heads of a drawn slot. Its layouts depend on the places of the tools relative to the slot's base, which
/// have defaults; how far the base lies from the axis serves to place and check what is given from the axis.
winding::StatorHeads heads_of_drawn(const json& heads, const winding::Slot& slot, std::vector<InputFault>& faults) {
  allow_only({"base_radius", "slot_pitch", "span", "tool_radius", "tool_shift", "tool_height", "stack"}, heads,
             "a polygon", faults);
  const bool placed = heads.contains("base_radius");
  if (!placed && heads.contains("tool_radius"))
    faults.push_back({{"heads", "base_radius"},
                      "is needed with tool_radius: a drawn slot does not tell how far from the axis it lies"});
  winding::StatorSlot base;
  base.base_radius = winding::StatorHeads{}.base_radius, base.liner = 0;
  winding::StatorHeads h = stator_heads(heads, base, {"heads"}, faults);
  take(heads, "slot_pitch", h.slot_pitch, degree);
  h.span = 1;  // without heads.span two coil sides lie side by side
  take(heads, "span", h.span);
  if (!placed) return h;
  if (h.base_radius <= slot.iron.box().high.y)
    faults.push_back(
        {{"heads", "base_radius"}, "is no more than the slot's height: the slot would reach the stator's axis"});
  if (heads.contains("slot_pitch")) check_heads(h, faults);
  return h;
}

winding::RotorHeads heads_of_rotor(const json& heads, std::vector<InputFault>& faults) {
  allow_only({"cap_height", "cap_base", "stack", "tooth_half_width", "tooth_radius", "poles"}, heads, "a rotor slot",
             faults);
  return rotor_heads(heads, {"heads"}, faults);
}

/// Returns the gap between the coils of neighbouring poles, mm, or nothing with a fault if they overlap.
std::optional<double> gap_between_poles(const winding::RotorPart& part, std::vector<InputFault>& faults) {
  try {
    return clear_way(part, checked_slot(part));
  } catch (const InvalidInput& error) {
    for (InputFault fault : error.faults) {
      if (fault.place.front() == "part") fault.place.front() = "heads";
      faults.push_back(std::move(fault));
    }
    return std::nullopt;
  }
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
  if (spec["slot"]["type"] == "rotor") {
    winding::RotorPart part{rotor_slot(spec["slot"]), heads_of_rotor(heads, faults)};
    request.heads = part.heads;
    take(heads, "poles", part.poles);
    const auto gap = heads.contains("poles") ? gap_between_poles(part, faults) : std::nullopt;
    if (gap) request.slot.opening->clear = *gap;
    return;
  }
  const bool drawn = request.slot.type == winding::Slot::Type::polygon;
  const winding::StatorHeads h =
      drawn ? heads_of_drawn(heads, request.slot, faults) : heads_of_stator(heads, stator_slot(spec["slot"]), faults);
  // The default is the source's for every slot, because it only determines where the heads lie.
  if (heads.contains("slot_pitch") && (!drawn || heads.contains("base_radius")) &&
      !winding::leaves_teeth(request.slot, h.base_radius, h.slot_pitch))
    faults.push_back({{"heads", "slot_pitch"}, "leaves no tooth between the slots: a larger one is needed"});
  request.heads = h;
}

/// Computes the usable area of one of two coil sides, and the needle that lays it.
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
  request.needle = winding::Needle{*width, beside ? winding::Needle::Stand::left : winding::Needle::Stand::middle, 1,
                                   spec.value("needle_swivels", false)};
}

/// Adds faults for wires that do not fit, too many wires, and turns that no layout can hold, by the thinnest wire,
/// because thicker ones are fewer.
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
  // The algorithm `potential` may overlap wires, by different shares of their radii.
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

FillRequest request(const json& spec, Progress progress) {
  FillRequest request;
  read_slot(spec["slot"], request, progress);
  std::vector<InputFault> faults;
  request.wires = WireReader(spec.value("grade", 2), faults).read(spec);
  read_algorithms(spec, request, faults);
  request.overlap_tolerance = given<double>(spec, "overlap_tolerance");
  request.seed = spec.value("seed", std::uint64_t{1});
  request.effort = spec.value("effort", 1.0);
  request.shifts = spec.value("shifts", 4);
  request.tie_in = spec.contains("tie_in") ? request.drawn.foot(point(spec["tie_in"])) : request.slot.tension_point;
  read_heads(spec, request, faults);
  read_sides(spec, request, faults);
  const json turns = spec.value("turns", json::object());
  request.serial = given<std::size_t>(turns, "serial");
  request.parallel = given<std::size_t>(turns, "parallel");
  if (request.needle) request.needle->wires = request.parallel.value_or(1);
  request.temperature = spec.value("temperature", 20.0);
  const json hold = spec.value("producible", json::object());
  request.producible.friction = hold.value("friction", request.producible.friction);
  request.producible.touch = hold.value("touch", request.producible.touch);
  if (spec.contains("robustness")) {
    const json& r = spec["robustness"];
    request.sampling = {r["samples"].get<int>(), given<double>(r, "wire_tolerance"), r.value("slot_tolerance", 0.0)};
    if (request.slot.usable_area.inward(request.sampling.slot_tolerance, progress).empty())
      faults.push_back(
          {{"robustness", "slot_tolerance"}, "leaves no usable area where the walls stand inside by so much"});
  }
  // Heads that cannot be built are refused before anything is planned.
  if (faults.empty() && std::holds_alternative<winding::RotorHeads>(request.heads))
    laying_regions(request.slot, std::get<winding::RotorHeads>(request.heads));
  if (faults.empty()) check_sizes(request, spec.contains("wires") && spec["wires"].is_array(), faults);
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return request;
}

}  // namespace bahnwerk::api::fill_factor
