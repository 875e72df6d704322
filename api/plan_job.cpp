// The one entry of planning, for worker and command line.
#include <nlohmann/json.hpp>

#include "api/job.hpp"
#include "api/json_text.hpp"
#include "api/kind.hpp"
#include "api/planned_job.hpp"
#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/setpoints.hpp"

namespace bahnwerk::api {
namespace {

/// "velocity x: 1801.2 mm/s, limit 1800 mm/s, at 0.25; …", of the checks that failed. What `at` counts is the kind's.
std::string failed_checks(const nlohmann::ordered_json& result) {
  std::string text;
  for (const auto& check : result.at("verification").at("checks")) {
    if (check.at("passed").get<bool>()) continue;
    const auto unit = check.at("unit").get<std::string>();
    text += (text.empty() ? "" : "; ") + check.at("name").get<std::string>() + ": " + check.at("value").dump() + " " +
            unit + ", limit " + check.at("limit").dump() + " " + unit + ", at " + check.at("at").dump();
  }
  return text.empty() ? "the plan is not verified" : text;
}

}  // namespace

PlannedJob plan_job(const std::string& kind, const std::string& document, Progress& progress) {
  const Kind* descriptor = find_kind(kind);
  if (!descriptor)
    throw Problem("unknown-kind", in_quotes(kind) + " is not a kind of this server", {{"/kind", "unknown kind"}});
  PlannedJob job = descriptor->plan(job_spec(document, &progress), progress);
  if (!job.verified) throw Problem("verification-failed", failed_checks(job.result));
  return job;
}

}  // namespace bahnwerk::api
