#include "api/documents/openapi.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "api/kind.hpp"
#include "api/problem.hpp"
#include "api/schema/embedded.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

/// Replaces #/$defs/point by #/components/schemas/contour.point, everywhere below.
void move_refs(ordered_json& node, const std::string& name) {
  constexpr std::string_view local = "#/$defs/";
  for (auto& [key, child] : node.items()) {
    if (key == "$ref" && child.is_string() && child.get_ref<const std::string&>().starts_with(local))
      child = "#/components/schemas/" + name + "." + child.get_ref<const std::string&>().substr(local.size());
    else if (child.is_structured())
      move_refs(child, name);
  }
}

/// Puts a schema into the document's components, its definitions beside it as NAME.definition.
void add_schema(ordered_json& components, std::string_view text, const std::string& name) {
  ordered_json schema = ordered_json::parse(text);
  schema.erase("$schema");
  schema.erase("$id");
  move_refs(schema, name);
  if (schema.contains("$defs")) {
    for (auto& [key, definition] : schema["$defs"].items()) components[name + "." + key] = definition;
    schema.erase("$defs");
  }
  components[name] = std::move(schema);
}

std::string result_schema_name(const Kind& kind) { return std::string(kind.name) + ".result"; }

/// Adds the layouts of files that kinds make of their results to the layouts of rows.
void add_layouts(ordered_json& parameter, std::span<const Kind> all) {
  auto& names = parameter["schema"]["enum"];
  std::string text = parameter["description"];
  for (const Kind& kind : all) {
    const ResultFiles& files = kind.files;
    for (std::size_t i = 0; i < files.layouts.size(); ++i) {
      text += i == 0 ? " Of kind " + std::string(kind.name) + " also a whole " + std::string(files.title) +
                           ", with no other parameter: "
                     : ", ";
      text += files.layouts[i];
      names.push_back(files.layouts[i]);
    }
    if (!files.layouts.empty()) text += ".";
    if (!files.about.empty()) text += " " + std::string(files.about);
  }
  parameter["description"] = std::move(text);
}

/// The answers that every operation can give before its handler is called: faults of the message and of the query.
void add_common_responses(ordered_json& paths) {
  static constexpr std::array<std::pair<const char*, const char*>, 12> common{{{"400", "BadRequest"},
                                                                               {"401", "Unauthorized"},
                                                                               {"403", "Forbidden"},
                                                                               {"408", "RequestTimeout"},
                                                                               {"413", "PayloadTooLarge"},
                                                                               {"417", "ExpectationFailed"},
                                                                               {"422", "InvalidQuery"},
                                                                               {"431", "HeaderTooLarge"},
                                                                               {"500", "Internal"},
                                                                               {"501", "NotImplemented"},
                                                                               {"503", "TooManyConnections"},
                                                                               {"505", "VersionNotSupported"}}};
  for (auto& [path, methods] : paths.items())
    for (auto& [method, operation] : methods.items())
      for (const auto& [status, name] : common)
        if (auto& responses = operation["responses"]; !responses.contains(status))
          responses[status] = {{"$ref", std::string("#/components/responses/") + name}};
}

}  // namespace

ordered_json openapi_document() { return openapi_document(kinds()); }

ordered_json openapi_document(std::span<const Kind> all) {
  ordered_json document = ordered_json::parse(embedded("openapi"));
  document["info"]["version"] = BAHNWERK_VERSION;
  auto& components = document["components"];
  auto& schemas = components["schemas"];

  add_schema(schemas, embedded("job"), "JobDocument");
  ordered_json specs = ordered_json::array(), results = ordered_json::array();
  ordered_json kind = ordered_json::array(), name = ordered_json::array({"job"});
  for (const auto& each : all) {
    const std::string spec(each.name), result = result_schema_name(each);
    for (const auto& [file, text] : {std::pair(spec, each.schema), std::pair(result, each.result_schema)}) {
      add_schema(schemas, text, file);
      name.push_back(file);
    }
    specs.push_back({{"$ref", "#/components/schemas/" + spec}});
    results.push_back({{"$ref", "#/components/schemas/" + result}});
    kind.push_back(each.name);
  }
  // This has to be last, because adding a member to an ordered object moves all others.
  schemas["JobDocument"]["properties"]["kind"]["enum"] = std::move(kind);
  components["parameters"]["name"]["schema"]["enum"] = std::move(name);
  schemas["Result"]["oneOf"] = std::move(results);
  auto& spec = schemas["JobDocument"]["properties"]["spec"];
  spec = specs.size() == 1 ? specs.front() : ordered_json{{"description", spec["description"]}, {"oneOf", specs}};

  add_layouts(components["parameters"]["layout"], all);
  add_common_responses(document["paths"]);

  auto& slug = components["parameters"]["slug"]["schema"]["enum"] = ordered_json::array();
  auto& type = schemas["Problem"]["properties"]["type"]["enum"] = ordered_json::array();
  for (const auto& each : problem_types()) {
    slug.push_back(each.slug);
    type.push_back("/problems/" + std::string(each.slug));
  }
  return document;
}

ordered_json kinds_document() {
  ordered_json list = ordered_json::array();
  for (const auto& kind : kinds())
    list.push_back({{"name", kind.name},
                    {"title", kind.title},
                    {"schema", "/v1/schemas/" + std::string(kind.name)},
                    {"result_schema", "/v1/schemas/" + result_schema_name(kind)}});
  return {{"kinds", std::move(list)}};
}

}  // namespace bahnwerk::api
