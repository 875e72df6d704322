#pragma once
#include "server/routes/context.hpp"

namespace bahnwerk::server {

/// Shortest time after which progress alone answers a waiter, or is sent to an event stream.
inline constexpr std::chrono::seconds progress_interval{1};

/// GET /v1/jobs/{id}: the resource with ETag. `Prefer: wait=SECONDS` (at most 60) [RFC 7240] delays the answer until
/// the job has ended; together with If-None-Match until the resource differs from that ETag, for progress alone at
/// least one second; in any case until the time is over. No thread waits.
void watch(Context& context, const RequestPtr& request, const Reply& reply);

/// Replies with `answer` when the job has ended or `seconds` are over, and says Preference-Applied; to be called on the
/// pool.
void answer_at_end(Context& context, const RequestPtr& request, const Reply& reply, const std::string& id, int seconds,
                   std::function<Response(const Context&, const Request&, const api::Job&)> answer);

/// Returns the seconds of a Prefer header's wait, 0 without one.
int preferred_wait(const Request& request);

/// Tells whether If-None-Match names an ETag that the job has had since it entered its present state, so that only
/// progress has changed.
bool knows_state(const Request& request, const api::Job& job);

}  // namespace bahnwerk::server
