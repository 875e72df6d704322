#include "api/kind_frame.hpp"

#include <utility>

#include "api/setpoints/setpoint_summary.hpp"

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
