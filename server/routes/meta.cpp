#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "api/documents/openapi.hpp"
#include "api/kind.hpp"
#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/schema/embedded.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/context.hpp"

namespace bahnwerk::server {
namespace {

/// What can be asked, with a proxy's prefix before the schemas' addresses.
void kinds(const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  auto document = api::kinds_document();
  for (auto& kind : document["kinds"])
    for (const char* link : {"schema", "result_schema"}) kind[link] = request->prefix + kind[link].get<std::string>();
  reply(json_answer(200, document).set("Cache-Control", "max-age=60"));
}

/// Texts that do not change while the process runs.
Handler constant(const std::function<std::string()>& make, std::string type) {
  const auto text = std::make_shared<const std::string>(make());
  return [text, type = std::move(type)](const RequestPtr& request, const Reply& reply) {
    require_json(*request);
    Response response = text_answer(200, type, *text);
    response.set("Cache-Control", "max-age=60");
    reply(std::move(response));
  };
}

void schema(const RequestPtr& request, const Reply& reply) {
  static constexpr std::array<std::string_view, 2> offers{"application/schema+json", "application/json"};
  const auto chosen = negotiate(request->header("accept"), offers);
  if (!chosen) throw api::Problem("not-acceptable", "Schemas come as application/schema+json or application/json.");
  std::string name = request->parameter("name");
  if (name.ends_with(".json")) name.resize(name.size() - 5);
  const std::string_view text = name == "openapi" ? std::string_view() : api::embedded(name);
  if (text.empty())
    throw api::Problem("not-found", "There is no schema " + api::shortened(name) + "; /v1/kinds lists them.");
  Response response = text_answer(200, std::string(offers[*chosen]), std::string(text));
  response.set("Cache-Control", "max-age=60");
  response.set("Vary", "Accept");
  reply(std::move(response));
}

void problem_page(const RequestPtr& request, const Reply& reply) {
  static constexpr std::array<std::string_view, 2> offers{"text/html", "application/json"};
  const auto chosen = negotiate(request->header("accept"), offers);
  if (!chosen) throw api::Problem("not-acceptable", "This page comes as text/html or application/json.");
  const auto types = api::problem_types();
  const std::string& slug = request->parameter("slug");
  const auto type = std::find_if(types.begin(), types.end(), [&](const auto& each) { return each.slug == slug; });
  if (type == types.end()) throw api::Problem("not-found", "There is no problem type " + api::shortened(slug) + ".");
  Response response;
  if (*chosen == 0) {
    const Texts text(language_of(*request));
    const std::string where =
        type->status ? text("errors.status", {{"status", std::to_string(type->status)}}) : text("errors.in_job");
    const std::string body = "<p><code>/problems/" + std::string(type->slug) + "</code>, " + prose_html(where) +
                             "</p>\n<p lang=\"en\">" + prose_html(type->advice) + "</p>\n";
    response = html_page(
        *request,
        {.title = text.find("errors.title_" + std::string(type->slug), type->title), .body = body, .module = "plain"});
  } else {
    nlohmann::ordered_json document{{"type", "/problems/" + std::string(type->slug)}, {"title", type->title}};
    if (type->status) document["status"] = type->status;
    document["advice"] = type->advice;
    response = json_answer(200, document);
  }
  response.set("Vary", *chosen == 0 ? "Accept, Accept-Language, Cookie" : "Accept");
  reply(std::move(response));
}

}  // namespace

void add_meta_routes(Router& router, Context&) {
  router.add("GET", "/v1/kinds", Access::any, kinds);
  router.add("GET", "/openapi.json", Access::any,
             constant([] { return api::openapi_document().dump(2); }, "application/json"));
  router.add("GET", "/v1/schemas/{name}", Access::any, schema);
  router.add("GET", "/problems/{slug}", Access::open, problem_page, {"lang"});
}

}  // namespace bahnwerk::server
