#pragma once
/// The page with the list of jobs.
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// Answers the list of jobs as a page, with the filters that GET /v1/jobs takes, 50 jobs at a time; where there is no
/// job at all, what a newcomer needs.
Response jobs_page(Context& context, const Request& request);

/// Answers what the page's module follows: {"jobs": job resources with "duration", s or null, "next", "counts"}, with
/// an ETag of its bytes.
Response jobs_data(Context& context, const Request& request);

}  // namespace bahnwerk::server
