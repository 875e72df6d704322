#include "server/routes/pages/problem_page.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "server/http/accept.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/pages/login.hpp"

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;

/// Returns the faults of a document as a list, each with the place that it points at.
std::string fault_list(const ordered_json& document) {
  if (!document.contains("errors") || !document["errors"].is_array() || document["errors"].empty()) return "";
  std::string html = "<ul lang=\"en\">";
  for (const auto& fault : document["errors"])
    html += "<li><code>" + escape_html(fault.value("pointer", "")) + "</code> " +
            escape_html(fault.value("message", "")) + "</li>";
  return html + "</ul>\n";
}

/// Returns the reason of a job's end, where the problem is that there is no result.
std::string cause(const ordered_json& document) {
  if (!document.contains("error") || !document["error"].is_object()) return "";
  return "<p lang=\"en\"><strong>" + escape_html(document["error"].value("title", "")) + ".</strong> " +
         escape_html(document["error"].value("detail", "")) + "</p>\n";
}

bool passes_by_itself(int status) { return status == 408 || status == 429 || status >= 500; }

std::string advice(const Texts& text, const std::string& slug) {
  const std::string own = text.find("errors." + slug, "");
  if (!own.empty()) return escape_html(own);
  for (const auto& each : api::problem_types())
    if (each.slug == slug) return "<span lang=\"en\">" + prose_html(each.advice) + "</span>";
  return escape_html(text("errors.internal"));
}

}  // namespace

bool wants_page(const Request& request) {
  static constexpr std::array<std::string_view, 2> offers{"text/html", "application/json"};
  const std::string accept = request.header("accept").value_or("");
  const std::size_t html = accept.find("text/html"), json = accept.find("json");
  return html != accept.npos && html < json && negotiate(accept, offers) == std::size_t{0};
}

Response problem_page(const Request& request, const Response& problem) {
  const Texts text(language_of(request));
  const auto document = ordered_json::parse(problem.body, nullptr, false);
  const std::string slug(problem.problem);
  const std::string title = text.find("errors.title_" + slug, document.value("title", ""));
  std::string body = "<div class=\"error\"><p class=\"lead\" lang=\"en\">" + escape_html(document.value("detail", "")) +
                     "</p>\n" + cause(document) + fault_list(document) + "</div>\n<h2>" +
                     escape_html(text("errors.what_to_do")) + "</h2>\n<p>" + advice(text, slug) + "</p>\n<p>";
  if (passes_by_itself(problem.status) && request.method == "GET")
    body += "<a href=\"" + escape_html(request.target) + "\">" + escape_html(text("errors.again")) + "</a> · ";
  body += "<a href=\"/\">" + escape_html(text("errors.to_jobs")) + "</a> · <a href=\"/new\">" +
          escape_html(text("shell.new")) + "</a></p>\n<p class=\"soft\">" + std::to_string(problem.status) +
          " · <a href=\"/problems/" + slug + "\">" + slug + "</a> · " +
          escape_html(text("errors.request", {{"id", request.id}})) + "</p>\n";
  Response page = html_page(request, {.title = title, .body = body, .module = "plain"});
  page.status = problem.status;
  page.problem = problem.problem;
  page.close = problem.close;
  for (const auto& [name, value] : problem.headers)
    if (name != "Content-Type" && name != "Vary") page.set(name, value);
  page.set("Vary", "Accept, Accept-Language, Cookie");
  return page;
}

Middleware problem_pages() {
  return [](Handler next) -> Handler {
    return [next = std::move(next)](RequestPtr request, Reply reply) {
      if (!wants_page(*request)) return next(std::move(request), std::move(reply));
      next(request, [reply = std::move(reply), request](Response response) {
        const bool problem = response.header("Content-Type").value_or("") == "application/problem+json";
        if (!problem || response.problem.empty()) return reply(std::move(response));
        if (response.status == 401)
          return reply(login_page(
              *request, response.header("WWW-Authenticate").value_or("").find("invalid_token") != std::string::npos));
        reply(problem_page(*request, response));
      });
    };
  };
}

}  // namespace bahnwerk::server
