// Part and coils of a spec of kind "winding".
#include <nlohmann/json.hpp>
#include <set>

#include "api/kinds/winding/winding.hpp"
#include "api/kinds/winding/winding_input.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using winding::Coil;

int reduced(int n, int slots) { return ((n % slots) + slots) % slots; }

/// Return what no two coils may share: a stator's slot takes one coil side, a rotor's pole one coil.
std::vector<int> sides(const Coil& coil, int slots) {
  return {reduced(coil.first, slots), reduced(coil.first + coil.span, slots)};
}
std::vector<int> pole(const Coil& coil, int slots) {
  return {reduced(coil.span > 0 ? coil.first : coil.first - 1, slots)};
}

}  // namespace

std::variant<winding::StatorPart, winding::RotorPart> part(const json& spec, Faults& faults) {
  const json& document = spec["part"];
  if (document["type"] == "stator") {
    winding::StatorPart stator;
    if (document["slot"].value("type", "stator") == "polygon") {
      const auto base = given<double>(document, "base_radius");
      if (!base)
        throw InvalidInput(
            {{{"part", "base_radius"}, "is needed: a drawn slot does not tell how far from the axis it lies"}});
      try {
        stator = winding::drawn_stator(polygon_slot(document["slot"]), *base);
      } catch (const InvalidInput& error) {
        throw relocated(error);
      }
    } else {
      stator.slot = stator_slot(document["slot"]);
    }
    stator.heads = stator_heads(document, stator.slot, {"part"}, faults);
    take(document, "slots", stator.slots);
    return stator;
  }
  winding::RotorPart rotor;
  rotor.slot = rotor_slot(document["slot"]);
  rotor.heads = rotor_heads(document, {"part"}, faults);
  take(document, "poles", rotor.poles);
  return rotor;
}

std::vector<Coil> coils(const json& spec, const std::variant<winding::StatorPart, winding::RotorPart>& part) {
  const json& document = spec["coil"];
  const int from = document["slots"][0], to = document["slots"][1];
  const auto* stator = std::get_if<winding::StatorPart>(&part);
  const auto* rotor = std::get_if<winding::RotorPart>(&part);
  const Coil first = stator ? coil_between(*stator, from, to) : coil_between(*rotor, from, to);
  const int slots = stator ? stator->slots : rotor->poles;
  const json repeat = document.value("repeat", json::object());
  if (repeat.empty()) return winding::repeated(first, slots, 0, 1, false);
  auto list = winding::repeated(first, slots, repeat["step"], repeat["count"].get<std::size_t>(),
                                repeat.value("alternate", true));
  std::set<int> wound;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const int place : stator ? sides(list[i], slots) : pole(list[i], slots))
      if (!wound.insert(place).second)
        throw InvalidInput({{{"coil", "repeat"},
                             "lets coil " + std::to_string(i + 1) + " lie where an earlier one lies: " +
                                 (stator ? "slot " : "pole ") + std::to_string(place) + " is taken"}});
  return list;
}

}  // namespace bahnwerk::api::winding_kind
