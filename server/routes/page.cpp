#include <array>

#include "api/problem.hpp"
#include "server/http/accept.hpp"
#include "server/http/key_gate.hpp"
#include "server/http/middleware.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/context.hpp"
#include "server/routes/job_page.hpp"
#include "server/routes/result_html.hpp"

namespace bahnwerk::server {
namespace {

/// Returns the duration of the planned motion, in whole cycles; "" where there is none. It is known without the result.
std::string motion_duration(Context& context, const api::Job& job) {
  if (job.state != api::JobState::succeeded) return "";
  const auto info = context.store.series(job.id);
  return info && info->count > 0 ? duration_label(static_cast<double>(info->count - 1) * info->cycle_time) : "";
}

std::string planning_duration(const api::Job& job) {
  if (!job.started_at || !job.finished_at) return "";
  return duration_label(static_cast<double>(*job.finished_at - *job.started_at) * 1e-3);
}

std::string row(Context& context, const api::Job& job) {
  const std::string page = "/jobs/" + job.id, link = "/v1/jobs/" + job.id;
  const std::string name = job.request.name.value_or("");
  std::string text = "<tr><td><a href=\"" + page + "\">" + (name.empty() ? "" : escape_html(name) + "<br>") + "<code>" +
                     job.id + "</code></a></td><td>" + escape_html(job.request.kind) + "</td><td class=\"k\">" +
                     state_label(job) + "</td><td class=\"n k\">" + motion_duration(context, job) +
                     "</td><td class=\"n k\">" + planning_duration(job) + "</td><td>" + time_label(job.created_at) +
                     "</td><td>";
  if (job.state == api::JobState::succeeded) text += "<a href=\"" + link + "/result\">result</a>";
  return text + "</td></tr>\n";
}

Response list_page(Context& context, const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"text/html"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "This page comes as text/html.");
  JobFilter newest;
  newest.limit = 50;
  newest.owner = sees_only(request);
  std::string body = "<p>";
  if (!newest.owner)  // the counts are those of all jobs
    for (const auto& [state, count] : context.store.counts())
      body += std::to_string(count) + " " + std::string(api::to_string(state)) + " · ";
  body +=
      "<a href=\"/v1/kinds\">kinds</a> · <a href=\"/openapi.json\">OpenAPI</a> · <a href=\"/metrics\">metrics</a></p>\n"
      "<div class=\"scroll\"><table><thead><tr><th>job</th><th>kind</th><th>state</th><th "
      "class=\"n\">motion</th><th "
      "class=\"n\">planning</th><th>created</th><th></th></tr></thead>\n";
  for (auto& job : context.store.list(newest)) {
    context.live.overlay(job);
    body += row(context, job);
  }
  return tagged_page(request, {.title = "Bahnwerk", .body = body + "</table></div>\n", .module = "jobs"});
}

}  // namespace

void add_page_routes(Router& router, Context& context) {
  const auto add = [&](const char* pattern, Response (*page)(Context&, const Request&)) {
    router.add("GET", pattern, Access::page,
               on_pool(context.scans, [&context, page](const Request& request) { return page(context, request); }),
               {"lang"});
  };
  add("/", list_page);
  add("/jobs/{id}", job_page);
  add("/jobs/{id}/drawings/{name}", drawing);
}

}  // namespace bahnwerk::server
