#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// GET /v1/jobs/{id}: the resource with ETag; `Prefer: wait=SECONDS` (at most 60) [RFC 7240] holds the answer until the
/// resource is another than If-None-Match names (without it: than it is now), is final, or the time is over. No thread
/// waits.
void watch(Context& context, const RequestPtr& request, const Reply& reply);

/// Seconds of a Prefer header's wait, 0 without one.
int preferred_wait(const Request& request);

}  // namespace bahnwerk::server
