#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// GET /jobs/{id}: one job for people: its state, why it failed and what to do, drawings, summary, verification and
/// downloads. Loads itself again while the job has not ended.
Response job_page(Context& context, const Request& request);

/// GET /jobs/{id}/drawings/{name}: one of the result's drawings, SVG.
Response drawing(Context& context, const Request& request);

/// A job's state as the pages show it.
std::string state_label(const api::Job& job);
/// "2026-01-31 12:00:00 UTC", of ms since 1970 UTC.
std::string time_label(std::int64_t ms);

}  // namespace bahnwerk::server
