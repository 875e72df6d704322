#pragma once
/// What happens to every request, in this order from the outside: request_id, access_log, count, guard. Each is a few
/// lines.
#include "server/http/message.hpp"
#include "server/runtime/metrics.hpp"
#include "server/runtime/pool.hpp"

namespace bahnwerk::server {

/// Takes the client's X-Request-Id (1–128 visible characters) or makes one; it comes back in the answer.
Middleware request_id();
/// One log line per request: id, method, route, path, status, ms until the answer's first byte, bytes of its body.
Middleware access_log();
/// Requests by route, method and status; their latency.
Middleware count(Metrics& metrics);
/// Turns what a handler throws into a problem document, and a broken message too: that goes no further.
Middleware guard();

/// Runs a plain function on the pool, with its exceptions answered: for handlers that read the store or parse.
Handler on_pool(Pool& pool, std::function<Response(const Request&)> work);

}  // namespace bahnwerk::server
