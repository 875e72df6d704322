#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/context.hpp"

namespace bahnwerk::server {

api::Job find_job(Context& context, const std::string& id) {
  auto job = context.store.get(id, false);
  if (!job) throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
  context.live.overlay(*job);
  return std::move(*job);
}

std::optional<double> remaining_seconds(const api::Job& job, std::int64_t now) {
  constexpr double enough = 0.05;  // share that has to be done before the rest is estimated
  constexpr double longest = 86400;
  if (job.state != api::JobState::running || !job.started_at || job.fraction < enough) return std::nullopt;
  const double spent = static_cast<double>(std::max(std::int64_t{0}, now - *job.started_at)) * 1e-3;
  return std::min(longest, spent * (1 - job.fraction) / job.fraction);
}

nlohmann::ordered_json job_resource(const Context& context, const api::Job& job, const std::string& prefix) {
  auto resource = api::job_resource(job);
  if (const auto seconds = remaining_seconds(job, context.time.now_ms()))
    resource["progress"]["remaining"] = std::round(*seconds * 10) / 10;
  if (job.state == api::JobState::queued)
    if (const auto ahead = context.places.ahead(job.id)) resource["queue"] = {{"ahead", *ahead}};
  if (!prefix.empty())
    for (auto& [name, link] : resource["links"].items()) link = prefix + link.get<std::string>();
  return resource;
}

Response job_answer(const Context& context, int status, const Request& request, const api::Job& job) {
  Response response = json_answer(status, job_resource(context, job, request.prefix));
  response.set("ETag", job_etag(job));
  return response;
}

bool final(const api::Job& job) { return job.state != api::JobState::queued && job.state != api::JobState::running; }

std::string job_etag(const api::Job& job) { return "\"" + std::to_string(job.revision) + "\""; }

std::string content_etag(const Context& context, const api::Job& job, std::string_view what) {
  return "\"" + std::string(what) + "-" + context.build.version + "-" + context.build.commit + "-" +
         std::to_string(job.attempt) + "\"";
}

namespace {

[[noreturn]] void throw_no_result(const api::Job& job) {
  const std::string state(api::to_string(job.state));
  if (!final(job)) throw api::Problem("job-not-finished", "The job is " + state + "; it has no result yet.");
  const std::string error = job.error.value_or("{}");
  const std::string why = nlohmann::json::parse(error).value("detail", "");
  throw api::Problem("no-result", (state == "cancelled" ? "The job was cancelled" : "The job failed") +
                                      std::string(" and has no result: ") + why)
      .because_of(error);
}

}  // namespace

api::Job require_success(Context& context, const std::string& id) {
  api::Job job = find_job(context, id);
  if (job.state != api::JobState::succeeded) throw_no_result(job);
  return job;
}

api::Job require_result(Context& context, const std::string& id) {
  api::Job job = find_job(context, id);
  if (job.state == api::JobState::succeeded) return job;
  const std::string why = job.state == api::JobState::failed ? job.error.value_or("{}") : "{}";
  if (nlohmann::json::parse(why).value("type", "") != "/problems/verification-failed") throw_no_result(job);
  return job;
}

void require_json(const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"application/json"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "This address answers application/json only.");
}

void require_precondition(const Request& request, const api::Job& job) {
  const auto given = request.header("if-match");
  if (given && !names_etag(*given, job_etag(job), Comparison::strong))
    throw api::Problem("precondition-failed", "The job's ETag is " + job_etag(job) + ".");
  if (matches_etag(request, job_etag(job)))
    throw api::Problem("precondition-failed", "The job's ETag is " + job_etag(job) + ", as If-None-Match says.");
}

Handler scan_unless_known(Context& context, Tag tag, std::function<Response(const Request&)> work) {
  return [&context, tag = std::move(tag), handler = on_pool(context.scans, std::move(work))](const RequestPtr& request,
                                                                                             const Reply& reply) {
    if (request->header("if-none-match"))
      if (const auto job = context.store.at_hand(request->parameter("id")))
        if (const std::string etag = tag(*request, *job); !etag.empty() && matches_etag(*request, etag))
          return reply(with_etag(*request, etag, Response().set("Vary", "Accept")));
    handler(request, reply);
  };
}

}  // namespace bahnwerk::server
