// The one entry of planning, for worker and command line.
#include <nlohmann/json.hpp>

#include "api/documents/job.hpp"
#include "api/kind.hpp"
#include "api/planned_job.hpp"
#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/setpoints/setpoints.hpp"
#include "api/text/json_text.hpp"

namespace bahnwerk::api {
namespace {

/// "velocity x: 1801.2 mm/s, limit 1800 mm/s, at 0.25 s; …", of the checks that failed, with place and advice where the
/// kind knows them.
std::string failed_checks(const nlohmann::ordered_json& result) {
  std::string text;
  for (const auto& check : result.at("verification").at("checks")) {
    if (check.at("passed").get<bool>()) continue;
    const auto unit = check.at("unit").get<std::string>();
    text += (text.empty() ? "" : "; ") + check.at("name").get<std::string>() + ": " + check.at("value").dump() + " " +
            unit + ", limit " + check.at("limit").dump() + " " + unit + ", at " + check.at("at").dump() + " " +
            check.at("at_unit").get<std::string>();
    if (check.contains("place")) text += " (" + check.at("place").at("words").get<std::string>() + ")";
    if (check.contains("change")) text += ": " + check.at("change").get<std::string>();
  }
  return text.empty() ? "the plan is not verified" : text;
}

}  // namespace

PlannedJob plan_job(const std::string& kind, const std::string& document, Progress progress) {
  const Kind* descriptor = find_kind(kind);
  if (!descriptor)
    throw Problem("unknown-kind", in_quotes(kind) + " is not a kind of this server", {{"/kind", "unknown kind"}});
  PlannedJob job = descriptor->plan(job_spec(document, progress), progress);
  if (!job.verified) {
    job.failure = failed_checks(job.result);
    job.setpoints.reset();
    job.result.erase("setpoints");
  }
  return job;
}

}  // namespace bahnwerk::api
