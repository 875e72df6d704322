#pragma once
/// The objects that handlers use, and the functions that add handlers to the router. One file per group of addresses.
#include <atomic>
#include <functional>

#include "server/http/router.hpp"
#include "server/jobs/live.hpp"
#include "server/jobs/notifier.hpp"
#include "server/runtime/build_info.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/metrics.hpp"
#include "server/runtime/pool.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// Checks a posted document: api::parse_job in the service, a small function in tests.
using Parser = std::function<api::JobRequest(std::string_view body)>;

struct Context {
  Store& store;
  LiveJobs& live;
  Notifier& notifier;
  Pool& pool;    ///< threads for short reads: a few milliseconds
  Pool& scans;   ///< threads for what reads or writes much: lists, documents, pages, setpoints, packing, removal
  Pool& health;  ///< threads for readiness and metrics
  Pool& checks;  ///< threads that check posted documents
  Pool& heavy;   ///< one thread, for large documents: one after the other they cannot exhaust memory together
  Metrics& metrics;
  Parser parse;
  std::size_t max_queued;
  std::size_t max_body;  ///< bytes of a body, also after decompression
  const std::atomic<bool>& draining;
  const BuildInfo build;
  const TimeSource& time;
  std::chrono::milliseconds event_heartbeat;  ///< longest silence of a stream of events
  unsigned workers;                           ///< number of planner threads
};

void add_job_routes(Router& router,
                    Context& context);  ///< POST and GET /v1/jobs, GET/DELETE /v1/jobs/{id}, spec, events, cancel
void add_result_routes(Router& router, Context& context);  ///< /v1/jobs/{id}/result, /v1/jobs/{id}/setpoints
void add_meta_routes(Router& router, Context& context);    ///< kinds, schemas, openapi.json, problems
void add_health_routes(Router& router, Context& context);  ///< healthz, readyz, metrics
void add_page_routes(Router& router, Context& context);    ///< the list of jobs and a page per job

/// Returns the current state of the job, without its document; throws Problem not-found.
api::Job find_job(Context& context, const std::string& id);
/// Throws job-not-finished, or no-result with the job's error, unless the job succeeded.
void require_success(Context& context, const std::string& id);
/// Throws like require_success(), except for a job that failed its verification, which has a result, too: the plan and
/// its failed checks.
void require_result(Context& context, const std::string& id);
bool final(const api::Job& job);  ///< returns whether the job has ended
std::string job_etag(const api::Job& job);
Response job_answer(int status, const api::Job& job);
/// Throws Problem not-acceptable unless the request accepts application/json.
void require_json(const Request& request);
/// Answers 304 when If-None-Match names `etag` (quotes included), else `response` with it.
Response with_etag(const Request& request, const std::string& etag, Response response);
bool matches_etag(const Request& request, const std::string& etag);
/// Throws Problem precondition-failed when If-Match does not name the tag of the job, or If-None-Match does: for
/// requests that change something [RFC 9110, 13.1].
void require_precondition(const Request& request, const api::Job& job);

}  // namespace bahnwerk::server
