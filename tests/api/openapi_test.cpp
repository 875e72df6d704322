#include "api/documents/openapi.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "api/documents/job.hpp"
#include "api/kind.hpp"
#include "api/problem.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

template <class Visit>
void walk(const ordered_json& node, const Visit& visit) {
  for (const auto& [key, child] : node.items()) {
    visit(key, child);
    if (child.is_structured()) walk(child, visit);
  }
}

TEST(OpenApi, ListsExactlyTheRoutes) {
  const std::set<std::string> expected{"POST /v1/jobs",
                                       "GET /v1/jobs",
                                       "DELETE /v1/jobs",
                                       "POST /v1/jobs/cancel",
                                       "GET /v1/changes",
                                       "GET /v1/events",
                                       "GET /v1/jobs/{id}",
                                       "DELETE /v1/jobs/{id}",
                                       "GET /v1/jobs/{id}/spec",
                                       "GET /v1/jobs/{id}/events",
                                       "GET /v1/jobs/{id}/result",
                                       "GET /v1/jobs/{id}/setpoints",
                                       "GET /v1/jobs/{id}/limits",
                                       "POST /v1/jobs/{id}/cancel",
                                       "POST /v1/jobs/{id}/retry",
                                       "GET /v1/jobs/{id}/blocks",
                                       "GET /v1/jobs/{id}/path",
                                       "GET /v1/jobs/{id}/scene",
                                       "POST /v1/check",
                                       "GET /v1/examples",
                                       "GET /v1/examples/{name}",
                                       "GET /v1/machines",
                                       "GET /v1/machines/{name}",
                                       "GET /v1/kinds",
                                       "GET /v1/schemas/{name}",
                                       "GET /openapi.json",
                                       "GET /problems/{slug}",
                                       "GET /healthz",
                                       "GET /readyz",
                                       "GET /metrics"};
  std::set<std::string> found, ids;
  const auto document = openapi_document();
  for (const auto& [path, methods] : document["paths"].items())
    for (const auto& [method, operation] : methods.items()) {
      std::string upper = method;
      for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      found.insert(upper + " " + path);
      EXPECT_TRUE(ids.insert(operation["operationId"]).second);
      for (const char* status : {"400", "405", "408", "413", "417", "422", "431", "500", "501", "503", "505"})
        EXPECT_TRUE(operation["responses"].contains(status)) << method << " " << path << " " << status;
    }
  EXPECT_EQ(found, expected);
}

TEST(OpenApi, ListsExactlyTheSlugsKindsAndSchemas) {
  const auto document = openapi_document();
  std::vector<std::string> slugs, types, kind_names, schema_names{"job"};
  for (const auto& type : problem_types()) {
    slugs.emplace_back(type.slug);
    types.push_back("/problems/" + slugs.back());
  }
  for (const auto& kind : kinds()) {
    kind_names.emplace_back(kind.name);
    schema_names.emplace_back(kind.name);
    schema_names.push_back(kind_names.back() + ".result");
    for (const auto& name : {kind_names.back(), schema_names.back()})
      EXPECT_TRUE(document["components"]["schemas"].contains(name)) << name;
    EXPECT_FALSE(kind.result_schema.empty());
  }
  EXPECT_EQ(document["components"]["parameters"]["slug"]["schema"]["enum"], slugs);
  EXPECT_EQ(document["components"]["schemas"]["Problem"]["properties"]["type"]["enum"], types);
  EXPECT_EQ(document["components"]["schemas"]["JobDocument"]["properties"]["kind"]["enum"], kind_names);
  EXPECT_EQ(document["components"]["parameters"]["name"]["schema"]["enum"], schema_names);
}

TEST(OpenApi, ListsTheLayoutsOfEveryKind) {
  const auto document = openapi_document();
  const auto& layout = document["components"]["parameters"]["layout"];
  std::vector<std::string> expected{"plain", "csv", "twincat", "twincat_poses"};
  for (const auto& kind : kinds())
    for (const std::string_view each : kind.files.layouts) {
      expected.emplace_back(each);
      EXPECT_NE(layout["description"].get<std::string>().find(each), std::string::npos) << each;
    }
  EXPECT_EQ(layout["schema"]["enum"], expected);
  EXPECT_EQ(layout["schema"]["default"], "plain");
}

TEST(OpenApi, ANewKindBringsItsSchemasAndLayouts) {
  static constexpr std::string_view layouts[] = {"punched_tape", "punched_card"};
  Kind loom;
  loom.name = "loom";
  loom.schema = R"({"$defs": {"thread": {"type": "number"}}, "properties": {"warp": {"$ref": "#/$defs/thread"}}})";
  loom.result_schema = R"({"type": "object"})";
  loom.files = {"pattern", layouts, "Header X-Threads counts them.", nullptr};
  const auto components = openapi_document({&loom, 1})["components"];
  EXPECT_EQ(components["schemas"]["JobDocument"]["properties"]["kind"]["enum"], std::vector<std::string>{"loom"});
  EXPECT_EQ(components["schemas"]["loom"]["properties"]["warp"]["$ref"], "#/components/schemas/loom.thread");
  EXPECT_EQ(components["schemas"]["loom.thread"]["type"], "number");
  EXPECT_EQ(components["schemas"]["loom.result"]["type"], "object");
  const auto& layout = components["parameters"]["layout"];
  EXPECT_EQ(layout["schema"]["enum"],
            (std::vector<std::string>{"plain", "csv", "twincat", "twincat_poses", "punched_tape", "punched_card"}));
  const std::string text = layout["description"], end =
                                                      " Of kind loom also a whole pattern, with no other parameter: "
                                                      "punched_tape, punched_card. Header X-Threads counts "
                                                      "them.";
  EXPECT_EQ(text.substr(text.size() - end.size()), end);
}

TEST(OpenApi, EveryReferenceLeadsSomewhereAndEveryComponentIsUsed) {
  const auto document = openapi_document();
  std::set<std::string> used;
  walk(document, [&](const std::string& key, const ordered_json& value) {
    if (key != "$ref") return;
    const std::string ref = value;
    ASSERT_EQ(ref.substr(0, 2), "#/") << ref;
    EXPECT_TRUE(document.contains(ordered_json::json_pointer(ref.substr(1)))) << ref;
    used.insert(ref);
  });
  for (const auto& [section, components] : document["components"].items())
    for (const auto& [name, component] : components.items())
      EXPECT_TRUE(used.count("#/components/" + section + "/" + name) || section == "securitySchemes")
          << section << "/" << name;
  for (const auto& requirement : document["security"])
    for (const auto& [name, scopes] : requirement.items())
      EXPECT_TRUE(document["components"]["securitySchemes"].contains(name)) << name;
}

TEST(OpenApi, EveryHttpSlugHasAResponse) {
  std::string responses;
  const auto document = openapi_document();
  for (const auto& [name, response] : document["components"]["responses"].items()) responses += response.dump();
  for (const auto& type : problem_types()) {
    if (type.status == 0) continue;
    EXPECT_NE(responses.find(std::string(type.slug)), std::string::npos) << type.slug;
  }
}

TEST(OpenApi, PathParametersAreDeclared) {
  const auto document = openapi_document();
  for (const auto& [path, methods] : document["paths"].items())
    for (const auto& [method, operation] : methods.items()) {
      std::set<std::string> declared;
      for (const auto& parameter : operation.value("parameters", ordered_json::array())) {
        const auto& target = document[ordered_json::json_pointer(parameter["$ref"].get<std::string>().substr(1))];
        if (target["in"] == "path") declared.insert(target["name"]);
      }
      const auto open = path.find('{');
      const std::set<std::string> expected =
          open == path.npos ? std::set<std::string>{}
                            : std::set<std::string>{path.substr(open + 1, path.find('}') - open - 1)};
      EXPECT_EQ(declared, expected) << path;
    }
}

TEST(OpenApi, TheJobResourceIsTheOneDescribed) {
  const auto schema = openapi_document()["components"]["schemas"]["Job"];
  Job job;
  std::vector<std::string> described, written;
  for (const auto& [name, property] : schema["properties"].items())
    if (name != "notes") described.push_back(name);  // in the answer to POST only
  const auto resource = job_resource(job);
  for (const auto& [name, value] : resource.items()) written.push_back(name);
  EXPECT_EQ(described, written);
}

}  // namespace
}  // namespace bahnwerk::api
