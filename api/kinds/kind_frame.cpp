#include "api/kinds/kind_frame.hpp"

#include <utility>

namespace bahnwerk::api {

namespace {

using Members = nlohmann::ordered_json::object_t;

/// Appends a member. An object with an order copies all its members when it grows, and they may be large.
void append(nlohmann::ordered_json& object, const char* name, nlohmann::ordered_json value) {
  Members grown;
  grown.reserve(object.size() + 1);
  if (object.is_object())
    for (auto& [key, member] : object.get_ref<Members&>()) grown.emplace_back(key, std::move(member));
  grown.emplace_back(name, std::move(value));
  object = std::move(grown);
}

/// Returns count, duration, cycle time, and each column with its unit; also name, unit and step of the independent
/// variable if that is not time.
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

}  // namespace

PlannedJob planned_job(std::string_view kind, KindReport report) {
  PlannedJob job;
  job.verified = report.verification.at("passed").get<bool>();
  if (!report.drawings.is_null()) append(report.details, "drawings", std::move(report.drawings));
  append(job.result, "kind", kind);
  append(job.result, "summary", std::move(report.summary));
  append(job.result, "verification", std::move(report.verification));
  append(job.result, "bound", std::move(report.bound));
  if (report.setpoints) append(job.result, "setpoints", setpoint_summary(*report.setpoints));
  append(job.result, "details", std::move(report.details));
  job.setpoints = std::move(report.setpoints);
  return job;
}

}  // namespace bahnwerk::api
