#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// Progress alone answers a waiter, and is sent to an event stream, this long after it began to wait at the earliest.
inline constexpr std::chrono::seconds progress_interval{1};

/// GET /v1/jobs/{id}: the resource with ETag. `Prefer: wait=SECONDS` (at most 60) [RFC 7240] holds the answer until the
/// job has ended; together with If-None-Match until the resource is another than that names, for progress alone one
/// second at least; until the time is over in any case. No thread waits.
void watch(Context& context, const RequestPtr& request, const Reply& reply);

/// Seconds of a Prefer header's wait, 0 without one.
int preferred_wait(const Request& request);

/// Whether If-None-Match names an ETag that the job has had since it entered its present state: what changed is
/// progress alone.
bool knows_state(const Request& request, const api::Job& job);

}  // namespace bahnwerk::server
