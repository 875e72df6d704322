#pragma once
/// The OpenAPI 3.1 document of the server.
#include <nlohmann/json_fwd.hpp>
#include <span>

namespace bahnwerk::api {

struct Kind;

/// Returns schemas/openapi.json completed from the code: version, schemas of the envelope and of every kind, names of
/// schemas, layouts of the kinds' files, slugs of problems.
nlohmann::ordered_json openapi_document();
/// Returns the document of a server with these kinds.
nlohmann::ordered_json openapi_document(std::span<const Kind> all);

/// Returns the body of GET /v1/kinds.
nlohmann::ordered_json kinds_document();

}  // namespace bahnwerk::api
