#include "core/plan/winding/slot_access.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <variant>

#include "core/base/progress.hpp"

namespace bahnwerk {

std::optional<SlotAccess> slot_access(const WindingRequest& request, Progress progress) {
  const auto* part = std::get_if<winding::StatorPart>(&request.part);
  if (part == nullptr) return std::nullopt;
  constexpr double cells = 400;
  const Progress drawing = progress.part(1, 1).named("drawing");
  const winding::Slot slot = winding::checked_slot(*part);
  SlotAccess access;
  access.step = std::sqrt(part->slot.base_width * part->slot.height / cells);
  const auto add = [&](std::string title, std::optional<double> limit) {
    const auto map = winding::clearance_map(*part, slot, request.needle, limit, access.step, drawing);
    access.shares.push_back(map.share(request.least_clearance));
    access.maps.push_back({std::move(title), map});
  };
  add("without pivot shift", std::nullopt);
  if (const auto limit = request.model.pivot_limit) {
    char title[60];
    std::snprintf(title, sizeof title, "with pivot shift up to %.3g°", *limit * 180 / std::numbers::pi);
    add(title, limit);
  }
  char title[80];
  std::snprintf(title, sizeof title, "clearance of a needle of %.3g mm by the place of its tip", request.needle.width);
  access.drawing = winding::clearance_drawing(winding::StatorIron(*part, slot), access.maps, title);
  return access;
}

}  // namespace bahnwerk
