#pragma once
#include <nlohmann/json_fwd.hpp>

#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// GET /jobs/{id}: one job for people: its state, why it failed and what to do, drawings, summary, verification and
/// downloads. The page reloads itself until the job has ended.
Response job_page(Context& context, const Request& request);

/// GET /jobs/{id}/drawings/{name}: one of the result's drawings, SVG.
Response drawing(Context& context, const Request& request);

/// Returns a value of a result as HTML: numbers with six digits, members by name, each entry of a list on its own line.
std::string shown_value(const nlohmann::ordered_json& value);
/// Returns a job's state as the pages show it.
std::string state_label(const api::Job& job);
/// Returns "2026-01-31 12:00:00 UTC" for ms since 1970 UTC.
std::string time_label(std::int64_t ms);

}  // namespace bahnwerk::server
