// GET /v1/jobs/{id}/scene: the bodies among which a motion takes place.
#include "api/scene.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/job.hpp"
#include "api/kind.hpp"
#include "api/problem.hpp"
#include "api/text/json_parts.hpp"
#include "api/text/pointer.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/context.hpp"

namespace bahnwerk::server {
namespace {

/// Returns the members of the stored result that the kind's scene reads.
nlohmann::json result_parts(Store& store, const std::string& id, const api::Kind& kind) {
  const auto document = kind.scene_parts.empty() ? nullptr : store.open_result(id);
  if (!document) return nlohmann::json::object();
  api::JsonParts parts(std::vector<std::string>(kind.scene_parts.begin(), kind.scene_parts.end()));
  std::string piece;
  for (bool more = true; more && document->next(piece);) {
    more = parts.take(piece);
    piece.clear();
  }
  return nlohmann::json::parse(parts.document());
}

/// Returns the scene; nullopt where kind or document have none, or this version refuses the document.
std::optional<api::Scene> scene_of(Context& context, const std::string& id, const api::Kind* kind) {
  if (!kind || !kind->scene) return std::nullopt;
  const auto job = context.store.get(id, true);
  if (!job) return std::nullopt;
  SilentProgress progress;
  try {
    return kind->scene(api::job_spec(job->request.document), result_parts(context.store, id, *kind), progress);
  } catch (const InvalidInput&) {
    return std::nullopt;
  } catch (const api::Problem&) {
    return std::nullopt;
  }
}

Response scene(Context& context, const Request& request) {
  require_json(request);
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  return unless_known(request, content_etag(context, job, "scene"), [&] {
    const auto found = scene_of(context, id, api::find_kind(job.request.kind));
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
