#pragma once
/// The objects that handlers use, and the functions that add handlers to the router. One file per group of addresses.
#include <atomic>
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "api/documents/examples.hpp"
#include "server/callbacks/callback_hosts.hpp"
#include "server/http/etag.hpp"
#include "server/http/router.hpp"
#include "server/jobs/live.hpp"
#include "server/jobs/notifier.hpp"
#include "server/jobs/queue_places.hpp"
#include "server/jobs/running_jobs.hpp"
#include "server/runtime/build_info.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/metrics.hpp"
#include "server/runtime/pool.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// Checks a posted document: api::parse_job in the service, a small function in tests.
using Parser = std::function<api::JobRequest(std::string_view body, Progress progress)>;
/// Checks a posted document for POST /v1/check: api::preview_job in the service.
using Previewer = std::function<nlohmann::ordered_json(std::string_view body, Progress progress)>;

struct Context {
  Store& store;
  LiveJobs& live;
  Notifier& notifier;
  Pool& pool;    ///< threads for short reads: a few milliseconds
  Pool& scans;   ///< threads for what reads or writes much: lists, documents, pages, setpoints, packing, removal
  Pool& health;  ///< threads for readiness and metrics
  Pool& checks;  ///< threads that check posted documents, as long as that takes some ms
  Pool& heavy;   ///< one thread, for large documents and long checks: one after the other
  Metrics& metrics;
  Parser parse;
  Previewer preview;
  std::vector<api::MachineFile> machines;  ///< machines to be offered
  std::size_t max_queued;
  std::chrono::milliseconds max_planning;  ///< limit of the time of a plan
  std::size_t max_body;                    ///< bytes of a body, also after decompression
  const std::atomic<bool>& draining;
  const BuildInfo build;
  const TimeSource& time;
  std::chrono::milliseconds event_heartbeat;  ///< longest silence of a stream of events
  unsigned workers;                           ///< number of planner threads
  const CallbackHosts callback_hosts;         ///< hosts that may be called
  QueuePlaces& places;
  RunningJobs& running;
};

void add_job_routes(Router& router,
                    Context& context);  ///< POST and GET /v1/jobs, GET/DELETE /v1/jobs/{id}, spec, events, cancel
void add_result_routes(Router& router, Context& context);   ///< /v1/jobs/{id}/result, /v1/jobs/{id}/setpoints
void add_limits_routes(Router& router, Context& context);   ///< /v1/jobs/{id}/limits
void add_meta_routes(Router& router, Context& context);     ///< kinds, schemas, openapi.json, problems
void add_path_routes(Router& router, Context& context);     ///< /v1/jobs/{id}/path, /v1/jobs/{id}/blocks
void add_scene_routes(Router& router, Context& context);    ///< /v1/jobs/{id}/scene
void add_example_routes(Router& router, Context& context);  ///< check, examples, machines
void add_health_routes(Router& router, Context& context);   ///< healthz, readyz, metrics
void add_page_routes(Router& router, Context& context);     ///< the list of jobs and a page per job

/// How soon those who wait while the store is away look again.
inline constexpr std::chrono::milliseconds store_retry{1'000};

/// Returns the current state of the job, without its document; throws Problem not-found.
api::Job find_job(Context& context, const std::string& id);
/// Returns the job. Throws job-not-finished, or no-result with the job's error, unless it succeeded.
api::Job require_success(Context& context, const std::string& id);
/// Acts like require_success(), except for a job that failed its verification, which has a result, too: the plan and
/// its failed checks.
api::Job require_result(Context& context, const std::string& id);
bool final(const api::Job& job);  ///< returns whether the job has ended
std::string job_etag(const api::Job& job);
/// Returns the job resource with the prefix of the proxy, if there is one, before its links, with its place in the
/// queue and the time that remains. Both are as of now: a change of them alone is no new ETag.
nlohmann::ordered_json job_resource(const Context& context, const api::Job& job, const std::string& prefix);
/// Returns the estimate of the time until a running job ends, s: the time so far grows with the share that is done.
/// nullopt where too little is done to tell.
std::optional<double> remaining_seconds(const api::Job& job, std::int64_t now);
Response job_answer(const Context& context, int status, const Request& request, const api::Job& job);
/// Throws Problem not-acceptable unless the request accepts application/json.
void require_json(const Request& request);
/// Throws Problem precondition-failed when If-Match does not name the tag of the job, or If-None-Match does: for
/// requests that change something [RFC 9110, 13.1].
void require_precondition(const Request& request, const api::Job& job);
/// Returns the tag of something that was made for a job: it names `what`, the program that answers and the attempt.
std::string content_etag(const Context& context, const api::Job& job, std::string_view what);
/// Returns a handler that runs `work` on the pool of scans. If the job was read a moment ago and the client has what
/// `tag` names, it answers 304 without another thread; `tag` returns "" where only `work` can tell.
using Tag = std::function<std::string(const Request&, const api::Job&)>;
Handler scan_unless_known(Context& context, Tag tag, std::function<Response(const Request&)> work);

}  // namespace bahnwerk::server
