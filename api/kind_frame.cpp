#include "api/kind_frame.hpp"

#include <utility>

#include "api/setpoints/setpoint_summary.hpp"

namespace bahnwerk::api {

PlannedJob planned_job(std::string_view kind, KindReport report) {
  PlannedJob job;
  job.verified = report.verification.at("passed").get<bool>();
  if (!report.drawings.is_null()) report.details["drawings"] = std::move(report.drawings);
  job.result = {{"kind", kind},
                {"summary", std::move(report.summary)},
                {"verification", std::move(report.verification)},
                {"bound", std::move(report.bound)}};
  if (report.setpoints) job.result["setpoints"] = setpoint_summary(*report.setpoints);
  job.result["details"] = std::move(report.details);
  job.setpoints = std::move(report.setpoints);
  return job;
}

}  // namespace bahnwerk::api
