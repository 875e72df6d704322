#include <array>

#include "api/problem.hpp"
#include "server/http/accept.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/context.hpp"
#include "server/routes/html.hpp"

namespace bahnwerk::server {
namespace {

std::string row(const api::Job& job) {
  const std::string link = "/v1/jobs/" + job.id, state(api::to_string(job.state));
  std::string text = "<tr><td><a href=\"" + link + "\"><code>" + job.id + "</code></a></td><td>" +
                     escape_html(job.request.name.value_or("")) + "</td><td>" + escape_html(job.request.kind) +
                     "</td><td>" + state;
  if (job.state == api::JobState::running) text += " " + std::to_string(static_cast<int>(job.fraction * 100)) + " %";
  text += "</td><td>" + api::rfc3339(job.created_at) + "</td><td>";
  if (job.state == api::JobState::succeeded)
    text += "<a href=\"" + link + "/result\">result</a> <a href=\"" + link + "/setpoints?points=1000\">setpoints</a>";
  return text + "</td></tr>\n";
}

Response status_page(Context& context, const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"text/html"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "This page comes as text/html.");
  std::string body = "<p>";
  for (const auto& [state, count] : context.store.counts())
    body += std::to_string(count) + " " + std::string(api::to_string(state)) + " · ";
  body +=
      "<a href=\"/v1/kinds\">kinds</a> · <a href=\"/openapi.json\">OpenAPI</a> · <a href=\"/metrics\">metrics</a></p>\n"
      "<table><tr><th>job</th><th>name</th><th>kind</th><th>state</th><th>created</th><th></th></tr>\n";
  JobFilter newest;
  newest.limit = 50;
  for (auto& job : context.store.list(newest)) {
    context.live.overlay(job);
    body += row(job);
  }
  Response response = html_page("Bahnwerk", body + "</table>\n");
  response.set("Cache-Control", "no-store");
  return response;
}

}  // namespace

void add_page_routes(Router& router, Context& context) {
  router.add("GET", "/", on_pool(context.pool, [&](const Request& request) { return status_page(context, request); }));
}

}  // namespace bahnwerk::server
