#include "core/winding/laying/windable.hpp"

#include <algorithm>

#include "core/base/progress.hpp"

namespace bahnwerk::winding {
namespace {

std::vector<Windable::Blocked> blocked(const LaidCoil& coil, double touch, Progress progress) {
  std::vector<Windable::Blocked> found;
  if (!coil.slot.opening || coil.layout.wires.empty()) return found;
  const Opening& opening = *coil.slot.opening;
  for (const Obstruction& each : opening_obstructions(opening, coil.radius, coil.needle))
    found.push_back({each, false});
  if (!coil.needle || coil.needle->swivels || !found.empty() || coil.slot.type == Slot::Type::rotor) return found;
  const auto channel = [&](const Region& usable_area, Needle needle, const Layout& layout, bool back) {
    const Progress last = progress.part(1, 1).named("needle access");
    const auto wire = first_out_of_reach(usable_area, opening, needle, {layout.wires, coil.radius, touch}, last);
    if (wire) found.push_back({{Obstruction::Part::channel, 0, 0, *wire}, back});
  };
  channel(coil.slot.usable_area, *coil.needle, coil.layout, false);
  if (coil.back == nullptr) return found;
  Needle other = *coil.needle;
  if (other.stand == Needle::Stand::left) other.stand = Needle::Stand::right;
  channel(coil.back_area ? *coil.back_area : coil.slot.usable_area, other, *coil.back, true);
  return found;
}

/// Returns the number of wires in place before an obstruction.
std::size_t before(const Obstruction& each) { return each.part == Obstruction::Part::channel ? each.wire : 0; }

}  // namespace

std::size_t Windable::most() const {
  std::size_t count = producible.first ? producible.first->laid : wires;
  for (const Blocked& each : blocked) count = std::min(count, before(each));
  return count;
}

std::vector<Windable::Blocked> Windable::blocked_among(std::size_t count) const {
  std::vector<Blocked> list;
  for (const Blocked& each : blocked)
    if (before(each) < count) list.push_back(each);
  return list;
}

Producible Windable::producible_among(std::size_t count) const {
  Producible part = producible;
  if (part.first && part.first->laid >= count) part.first.reset();
  std::erase_if(part.unsupported, [&](std::size_t wire) { return wire >= count; });
  return part;
}

Windable windable(const LaidCoil& coil, const ProducibleOptions& options, Progress progress) {
  Windable verdict;
  verdict.wires = coil.layout.wires.size();
  verdict.producible =
      producible(coil.slot.usable_area, coil.radius, coil.layout, coil.tension_point, options, progress);
  verdict.blocked = blocked(coil, options.touch, progress);
  return verdict;
}

}  // namespace bahnwerk::winding
