#include "api/setpoints/setpoint_summary.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace bahnwerk::api {

nlohmann::ordered_json setpoint_summary(const SetpointSource& setpoints) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const Column& column : setpoints.columns()) columns.push_back({{"name", column.name}, {"unit", column.unit}});
  nlohmann::ordered_json summary{
      {"count", setpoints.count()}, {"duration", setpoints.duration()}, {"cycle_time", setpoints.cycle_time()}};
  if (const Independent over = setpoints.independent(); !over.time())
    summary["independent"] = {{"name", over.name}, {"unit", over.unit}, {"step", over.step}};
  summary["columns"] = std::move(columns);
  return summary;
}

}  // namespace bahnwerk::api
