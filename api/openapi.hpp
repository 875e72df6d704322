#pragma once
/// The OpenAPI 3.1 document that the server hands out.
#include <nlohmann/json_fwd.hpp>

namespace bahnwerk::api {

/// schemas/openapi.json completed with what the code knows: the version, the schemas of the envelope and of every kind,
/// the names of schemas and problem slugs. So it cannot lag behind them.
nlohmann::ordered_json openapi_document();

/// The body of GET /v1/kinds.
nlohmann::ordered_json kinds_document();

}  // namespace bahnwerk::api
