#include <charconv>
#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "api/text/pointer.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/changes.hpp"
#include "server/routes/context.hpp"
#include "server/routes/events.hpp"
#include "server/routes/submit.hpp"
#include "server/routes/watch.hpp"
#include "server/runtime/clock.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t longest_list = 200;

[[noreturn]] void bad_query(const std::string& name, const std::string& message) {
  throw api::Problem("schema-violation", "The query is not valid: " + name + ": " + message,
                     {{"/query/" + name, message}});
}

JobFilter parse_filter(const Pairs& query) {
  JobFilter filter;
  for (const auto& [name, value] : query) {
    if (name == "state") {
      filter.state = api::job_state(value);
      if (!filter.state) bad_query(name, "expected queued, running, succeeded, failed or cancelled");
    } else if (name == "kind") {
      filter.kind = value;
    } else if (name == "reference") {
      filter.reference = value;
    } else if (name == "created_after" || name == "created_before" || name == "before") {
      const auto time = api::parse_rfc3339(value);
      if (!time) bad_query(name, "expected an RFC 3339 time such as 2026-01-31T12:00:00Z");
      (name == "created_after" ? filter.created_after : filter.created_before) = *time;
    } else if (name == "limit") {
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), filter.limit);
      if (error != std::errc() || end != value.data() + value.size() || filter.limit < 1 || filter.limit > longest_list)
        bad_query(name, "expected an integer from 1 to " + std::to_string(longest_list));
    } else {  // cursor: the router lets nothing else through
      if (value.size() != 36 || value.find_first_not_of("0123456789abcdef-") != std::string::npos)
        bad_query(name, "expected the `next` of a former page");
      filter.before = value;
    }
  }
  return filter;
}

Response list(Context& context, const Request& request) {
  require_json(request);
  JobFilter filter = parse_filter(request.query);
  filter.owner = sees_only(request);
  const std::size_t limit = filter.limit++;  // one more shows whether there is a next page
  auto jobs = context.store.list(filter);
  const bool more = jobs.size() > limit;
  if (more) jobs.pop_back();
  auto page = nlohmann::ordered_json::array();
  for (auto& job : jobs) {
    context.live.overlay(job);
    page.push_back(job_resource(job, request.prefix));
  }
  nlohmann::ordered_json document{{"jobs", std::move(page)}, {"next", nullptr}};
  if (more) document["next"] = jobs.back().id;
  Response response = json_answer(200, document);
  response.set("Cache-Control", "no-store");
  return response;
}

/// Reads the filter of a call that acts on all jobs which match it; without one it would act on all jobs there are.
JobFilter required_filter(const Request& request) {
  if (request.query.empty())
    throw api::Problem("schema-violation",
                       "The query is not valid: name at least one of state, kind, reference, before",
                       {{"/query", "names no filter; expected state, kind, reference or before"}});
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
  Response response = job_answer(202, request, find_job(context, id));
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
  require_precondition(request, find_job(context, id));
  switch (context.store.remove(id)) {
    case Removed::unknown:
      throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
    case Removed::running:
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
  router.add("GET", "/v1/jobs", Access::read,
             on_pool(context.scans, [&](const Request& request) { return list(context, request); }),
             {"state", "kind", "reference", "created_after", "created_before", "limit", "cursor"});
  router.add("DELETE", "/v1/jobs", Access::admin,
             on_pool(context.scans, [&](const Request& request) { return remove_all(context, request); }),
             {"state", "kind", "reference", "before"});
  router.add("POST", "/v1/jobs/cancel", Access::admin,
             on_pool(context.scans, [&](const Request& request) { return cancel_all(context, request); }),
             {"state", "kind", "reference", "before"});
  router.add("GET", "/v1/changes", Access::read,
             [&](const RequestPtr& request, const Reply& reply) { changes(context, request, reply); },
             {"since", "limit"});
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
