#include "server/http/middleware.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/context.hpp"
#include "server/routes/pages/job_page.hpp"
#include "server/routes/pages/jobs_page.hpp"

namespace bahnwerk::server {
namespace {

/// The page on which a job is made. Its form is made from the schemas, by the module of the page.
Response new_page(Context&, const Request& request) {
  require_page(request);
  const Texts text(language_of(request));
  return tagged_page(request,
                     {.title = text("shell.new"), .body = "<section id=\"new\"></section>\n", .module = "new"});
}

/// The page that compares two jobs; its parameters are read by its module.
Response compare_page(Context&, const Request& request) {
  require_page(request);
  const Texts text(language_of(request));
  return tagged_page(
      request, {.title = text("shell.compare"), .body = "<section id=\"compare\"></section>\n", .module = "compare"});
}

}  // namespace

void add_page_routes(Router& router, Context& context) {
  const auto add = [&](const char* pattern, Response (*page)(Context&, const Request&),
                       std::vector<std::string_view> query = {}) {
    query.push_back("lang");
    router.add("GET", pattern, Access::page,
               on_pool(context.scans, [&context, page](const Request& request) { return page(context, request); }),
               std::move(query));
  };
  const std::vector<std::string_view> filters{"state",         "kind",           "reference", "tag",   "text",
                                              "created_after", "created_before", "sort",      "limit", "cursor"};
  add("/", jobs_page, filters);
  router.add("GET", "/jobs", Access::read,
             on_pool(context.scans, [&](const Request& request) { return jobs_data(context, request); }), filters);
  add("/new", new_page, {"from", "example", "kind"});
  add("/compare", compare_page, {"a", "b", "from"});
  add("/jobs/{id}", job_page);
  add("/jobs/{id}/drawings/{name}", drawing);
}

}  // namespace bahnwerk::server
