#pragma once
#include "server/pages/texts.hpp"
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// GET /jobs/{id}: one job for people: verdict and duration, why it failed and what to do, what limits the motion,
/// slowest lines, places for curves and path, verification, bound, summary and downloads. It reads the result and
/// stored views, no rows. The page's module keeps it up to date until the job has ended.
Response job_page(Context& context, const Request& request);

/// GET /jobs/{id}/drawings/{name}: one of the result's drawings, SVG.
Response drawing(Context& context, const Request& request);

/// Returns a job's state as the pages show it.
std::string state_label(const api::Job& job, const Texts& text);
/// Returns "2026-01-31 12:00:00 UTC" for ms since 1970 UTC, in an element whose text the page's script replaces by the
/// local time.
std::string time_label(std::int64_t ms);

}  // namespace bahnwerk::server
