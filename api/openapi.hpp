#pragma once
/// The OpenAPI 3.1 document of the server.
#include <nlohmann/json_fwd.hpp>

namespace bahnwerk::api {

/// Returns schemas/openapi.json completed from the code: version, schemas of the envelope and of every kind, names of
/// schemas, slugs of problems.
nlohmann::ordered_json openapi_document();

/// Returns the body of GET /v1/kinds.
nlohmann::ordered_json kinds_document();

}  // namespace bahnwerk::api
