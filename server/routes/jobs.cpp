#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/changes.hpp"
#include "server/routes/context.hpp"
#include "server/routes/events.hpp"
#include "server/routes/job_filter.hpp"
#include "server/routes/submit.hpp"
#include "server/routes/waiting.hpp"
#include "server/routes/watch.hpp"
#include "server/runtime/clock.hpp"

namespace bahnwerk::server {
namespace {

/// A page of the list, and its tag: of what clients see, but for places in the queue and estimates.
struct Page {
  nlohmann::ordered_json document;
  std::string etag;
  bool running = false;  ///< whether the progress of a job may change it
};

Page page(Context& context, const Request& request) {
  JobFilter filter = parse_filter(request.query);
  filter.owner = sees_only(request);
  const std::size_t limit = filter.limit++;  // one more shows whether there is a next page
  auto jobs = context.store.list(filter);
  const bool more = jobs.size() > limit;
  if (more) jobs.pop_back();
  Page page;
  std::string state = request.prefix;
  auto list = nlohmann::ordered_json::array();
  const auto queued = [](const api::Job& job) { return job.state == api::JobState::queued; };
  if (std::any_of(jobs.begin(), jobs.end(), queued)) context.places.look();
  for (auto& job : jobs) {
    context.live.overlay(job);
    list.push_back(job_resource(context, job, request.prefix));
    state.append(" ").append(job.id).append(":").append(std::to_string(job.revision));
    page.running = page.running || job.state == api::JobState::running;
  }
  nlohmann::ordered_json counts;
  for (const auto& [each, count] : context.store.counts(filter.owner))
    counts[std::string(api::to_string(each))] = count;
  page.document = {{"jobs", std::move(list)}, {"next", nullptr}, {"counts", counts}};
  if (more) page.document["next"] = jobs.back().id;
  page.etag = etag_of(state + counts.dump() + page.document["next"].dump());
  return page;
}

Response page_answer(const Request& request, const Page& page) {
  return unless_known(request, page.etag, [&] { return json_answer(200, page.document); });
}

/// GET /v1/jobs. `Prefer: wait` together with If-None-Match delays the answer until the page differs from the one that
/// the client has.
void list(Context& context, const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  context.scans.post([&context, request, reply] {
    try {
      const int wait = request->header("if-none-match") ? preferred_wait(*request) : 0;
      const Page first = page(context, *request);
      if (wait == 0 || !matches_etag(*request, first.etag)) return reply(page_answer(*request, first));
      const auto look = [&context, request](bool last) -> std::optional<Response> {
        const Page now = page(context, *request);
        if (!last && matches_etag(*request, now.etag)) return std::nullopt;
        return page_answer(*request, now);
      };
      const auto again = first.running ? std::optional<std::chrono::milliseconds>(progress_interval) : std::nullopt;
      const AnyJobWait::Schedule schedule{context.scans, wait, again};
      std::make_shared<AnyJobWait>(context, request, reply, look, schedule)->look();
    } catch (...) {
      reply(answer_from_current_exception(*request));
    }
  });
}

/// Reads the filter of a call that acts on all jobs which match it; without one it would act on all jobs there are.
JobFilter required_filter(const Request& request) {
  if (request.query.empty())
    throw api::Problem("schema-violation",
                       "The query is not valid: name at least one of state, kind, reference, tag, before",
                       {{"/query", "names no filter; expected state, kind, reference, tag or before"}});
  return parse_filter(request.query);
}

Response counted(std::size_t count) { return json_answer(200, {{"count", count}}); }

Response cancel_all(Context& context, const Request& request) {
  require_json(request);
  return counted(context.store.cancel_all(required_filter(request), context.time.now_ms()));
}

Response remove_all(Context& context, const Request& request) {
  require_json(request);
  return counted(context.store.remove_all(required_filter(request)));
}

Response cancel(Context& context, const Request& request) {
  require_json(request);
  const std::string& id = request.parameter("id");
  require_precondition(request, find_job(context, id));
  if (!context.store.cancel(id, context.time.now_ms()))
    throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
  Response response = job_answer(context, 202, request, find_job(context, id));
  response.set("Location", "/v1/jobs/" + id);
  return response;
}

std::string document_etag(const Context& context, api::Job job) {
  job.attempt = 0;  // no attempt changes it
  return content_etag(context, job, "spec");
}

/// Answers the document exactly as it was posted.
Response document(Context& context, const Request& request) {
  require_json(request);
  const std::string& id = request.parameter("id");
  return unless_known(request, document_etag(context, find_job(context, id)), [&] {
    auto text = context.store.open_document(id);
    if (!text)
      throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");  // it was deleted in between
    return text_answer("application/json", std::move(text));
  });
}

Response remove(Context& context, const Request& request) {
  const std::string& id = request.parameter("id");
  std::exception_ptr refused;
  // What is compared is the row that is removed, in the same transaction.
  const Removed removed = context.store.remove(id, [&](const api::Job& job) {
    try {
      require_precondition(request, job);
      return true;
    } catch (const api::Problem&) {
      refused = std::current_exception();
      return false;
    }
  });
  switch (removed) {
    case Removed::unknown:
      throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
    case Removed::refused:
      std::rethrow_exception(refused);
    case Removed::running:
      require_precondition(request, find_job(context, id));
      throw api::Problem("job-not-finished", "The job is running; cancel it first.");
    case Removed::yes:
      break;
  }
  Response response;
  response.status = 204;
  return response;
}

}  // namespace

void add_job_routes(Router& router, Context& context) {
  router.add("POST", "/v1/jobs", Access::submit,
             [&](const RequestPtr& request, const Reply& reply) { submit(context, request, reply); });
  router.add(
      "GET", "/v1/jobs", Access::read,
      [&](const RequestPtr& request, const Reply& reply) { list(context, request, reply); },
      {"state", "kind", "reference", "tag", "text", "created_after", "created_before", "sort", "limit", "cursor"});
  router.add("DELETE", "/v1/jobs", Access::admin,
             on_pool(context.scans, [&](const Request& request) { return remove_all(context, request); }),
             {"state", "kind", "reference", "tag", "before"});
  router.add("POST", "/v1/jobs/cancel", Access::admin,
             on_pool(context.scans, [&](const Request& request) { return cancel_all(context, request); }),
             {"state", "kind", "reference", "tag", "before"});
  router.add("GET", "/v1/changes", Access::read,
             [&](const RequestPtr& request, const Reply& reply) { changes(context, request, reply); },
             {"since", "limit"});
  router.add("GET", "/v1/events", Access::read,
             [&](const RequestPtr& request, const Reply& reply) { all_events(context, request, reply); },
             {"state", "kind"});
  router.add("GET", "/v1/jobs/{id}", Access::read,
             [&](const RequestPtr& request, const Reply& reply) { watch(context, request, reply); });
  router.add("GET", "/v1/jobs/{id}/spec", Access::read,
             scan_unless_known(
                 context, [&](const Request&, const api::Job& job) { return document_etag(context, job); },
                 [&](const Request& request) { return document(context, request); }));
  router.add("GET", "/v1/jobs/{id}/events", Access::read,
             [&](const RequestPtr& request, const Reply& reply) { events(context, request, reply); });
  router.add("DELETE", "/v1/jobs/{id}", Access::submit,
             on_pool(context.scans, [&](const Request& request) { return remove(context, request); }));
  router.add("POST", "/v1/jobs/{id}/retry", Access::submit,
             [&](const RequestPtr& request, const Reply& reply) { retry(context, request, reply); });
  router.add("POST", "/v1/jobs/{id}/cancel", Access::submit,
             on_pool(context.scans, [&](const Request& request) { return cancel(context, request); }));
}

}  // namespace bahnwerk::server
