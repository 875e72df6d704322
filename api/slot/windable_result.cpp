#include "api/slot/windable_result.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace bahnwerk::api {

using nlohmann::ordered_json;
using winding::Obstruction;

ordered_json blocked_by(const winding::Windable& verdict, std::size_t wires) {
  ordered_json list = ordered_json::array();
  for (const auto& each : verdict.blocked_among(wires)) {
    if (each.part == Obstruction::Part::channel) {
      list.push_back({{"part", "channel"}, {"wire", each.wire + 1}, {"region", each.back ? "slot_back" : "slot"}});
      continue;
    }
    const bool bore = each.part == Obstruction::Part::bore;
    list.push_back({{"part", each.part == Obstruction::Part::wire ? "wire" : "needle"},
                    {"needed", each.needed},
                    {"clear", each.clear},
                    {"passage", bore ? "needle" : "opening"}});
  }
  return list;
}

ordered_json slips(const winding::Windable& verdict, std::size_t wires) {
  const winding::Producible among = verdict.producible_among(wires);
  if (!among.first) return nullptr;
  const bool pushed = among.first->reason == winding::Producible::Reason::pushed_out;
  return {{"wire", among.first->wire + 1},
          {"laid", among.first->laid + 1},
          {"reason", pushed ? "pushed_out" : "no_support"},
          {"unsupported", among.unsupported.size()}};
}

ordered_json windable(const winding::Windable& verdict, std::size_t parallel, std::size_t places) {
  const std::size_t most = verdict.most();
  ordered_json ends = most < places ? ordered_json("not_decided") : ordered_json();
  if (most < verdict.wires) {
    const auto& first = verdict.producible.first;
    ends = first && first->laid == most
               ? (first->reason == winding::Producible::Reason::pushed_out ? "pushed_out" : "no_support")
               : "blocked";
  }
  return {{"wires", most}, {"turns", most / std::max<std::size_t>(parallel, 1)}, {"ends_by", std::move(ends)}};
}

}  // namespace bahnwerk::api
