// GET /v1/jobs/{id}/scene: the bodies among which a motion takes place.
#include "api/scene.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "core/base/progress.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/stored_document.hpp"

namespace bahnwerk::server {
namespace {

/// Returns the scene; nullopt where kind or document have none, or this version refuses the document.
std::optional<api::Scene> scene_of(Context& context, const std::string& id) {
  return of_stored_spec(context, id, [&](const StoredSpec& stored) -> std::optional<api::Scene> {
    const auto& [kind, spec] = stored;
    if (!kind->scene) return std::nullopt;
    nlohmann::json parts = nlohmann::json::object();
    if (!kind->scene_parts.empty())
      if (const auto result = context.store.open_result(id))
        parts = nlohmann::json::parse(read_parts(*result, {kind->scene_parts.begin(), kind->scene_parts.end()}));
    Progress progress;
    return kind->scene(spec, parts, progress);
  });
}

Response scene(Context& context, const Request& request) {
  require_json(request);
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  return unless_known(request, content_etag(context, job, "scene"), [&] {
    const auto found = scene_of(context, id);
    if (!found)
      throw api::Problem("not-found", "The job " + api::shortened(id) +
                                          " has no scene: windings, probe paths, and contours with coarse and fine "
                                          "axes in space have one.");
    return json_answer(200, api::scene_document(job.request.kind, *found));
  });
}

}  // namespace

void add_scene_routes(Router& router, Context& context) {
  router.add("GET", "/v1/jobs/{id}/scene", Access::read,
             scan_unless_known(
                 context,
                 [&context](const Request&, const api::Job& job) {
                   return job.state == api::JobState::succeeded ? content_etag(context, job, "scene") : std::string();
                 },
                 [&](const Request& request) { return scene(context, request); }));
}

}  // namespace bahnwerk::server
