#pragma once
/// Steps of every request, from the outside: request_id, access_log, audit, count, prefixed, guard.
#include "server/http/message.hpp"
#include "server/runtime/metrics.hpp"
#include "server/runtime/pool.hpp"
#include "server/store/values.hpp"

namespace bahnwerk::server {

/// Uses the client's X-Request-Id (1–128 visible characters) or generates one, and returns it in the answer.
Middleware request_id();
/// Which requests are logged: errors are those that are answered with 400 and more.
enum class LoggedRequests { all, errors, none };
/// Logs one line per request that is to be logged: id, method, route, path, status, ms until the answer's first byte,
/// bytes of its body, the job that it is about or has made, the client's traceparent [W3C Trace Context].
Middleware access_log(LoggedRequests logged);
/// Writes a line for every request of a key that may change something: who (key, its id, address), what, which job, and
/// how it ended.
Middleware audit();
/// Puts the prefix of the request's proxy before the addresses in Location and in pages.
Middleware prefixed();
/// Says in answers that the store is a standby, which may be behind: `Bahnwerk-Store: read-only`.
Middleware tell_store_state(std::function<StoreState()> state);
/// Counts requests by route, method and status, their latency, apart from it that of requests that were told to wait,
/// and problems by their slug.
Middleware count(Metrics& metrics);
/// Turns exceptions of a handler into a problem document; answers broken messages without calling the handler.
Middleware guard();

/// Runs a plain function on the pool and answers its exceptions: for handlers that read the store or parse.
Handler on_pool(Pool& pool, std::function<Response(const Request&)> work);

}  // namespace bahnwerk::server
