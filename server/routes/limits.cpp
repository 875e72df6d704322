#include <nlohmann/json.hpp>

#include "api/setpoints/limits_answer.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/stored_series.hpp"

namespace bahnwerk::server {
namespace {

Response limits(Context& context, const Request& request) {
  const api::IntervalQuery query = api::parse_interval_query(request.query);
  require_json(request);
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  return unless_known(request, content_etag(context, job, "limits"), [&] {
    const SeriesInfo info = require_views(context, id);
    api::LimitsReader reader(view_reader(context.store, info), info.count);
    return json_answer(200, api::limits_answer(reader, info.count, info.cycle_time, query));
  });
}

}  // namespace

void add_limits_routes(Router& router, Context& context) {
  router.add("GET", "/v1/jobs/{id}/limits", Access::read,
             scan_unless_known(
                 context,
                 [&context](const Request& request, const api::Job& job) {
                   api::parse_interval_query(request.query);
                   return job.state == api::JobState::succeeded ? content_etag(context, job, "limits") : std::string();
                 },
                 [&](const Request& request) { return limits(context, request); }),
             {"first", "count", "points"});
}

}  // namespace bahnwerk::server
