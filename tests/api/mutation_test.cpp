// Broken documents never crash: each is a request or a Problem, and three verdicts on a schema agree.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "api/kind.hpp"
#include "api/schema/embedded.hpp"
#include "api/schema/schema.hpp"
#include "api/schema/schema_explain.hpp"
#include "api/text/json_text.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

std::vector<std::string> seeds() {
  std::vector<std::string> bodies;
  for (const auto& kind : kinds())
    for (const auto& file : test::json_files("schemas/examples/" + std::string(kind.name)))
      bodies.push_back(test::job_with_spec(kind.name, test::read_json(file)).dump());
  for (const auto& file : test::json_files("schemas/examples/job")) bodies.push_back(test::read_file(file));
  return bodies;
}

/// Accepted or refused with a document that can be sent.
bool accepted(const std::string& body) {
  try {
    const auto request = parse_job(body);
    // The secret of a callback is taken out once.
    EXPECT_EQ(request.document, request.callback ? parse_job(request.document).document : body);
    EXPECT_NO_THROW(job_spec(request.document));
    return true;
  } catch (const Problem& problem) {
    EXPECT_NO_THROW(problem.document("/v1/jobs").dump());
    const auto slug = problem.type().slug;
    EXPECT_TRUE(slug == "invalid-json" || slug == "schema-violation" || slug == "semantic-violation" ||
                slug == "unknown-kind")
        << slug;
    return false;
  }
}

TEST(Mutations, ChangedBytesNeverCrash) {
  const auto bodies = seeds();
  std::mt19937_64 random(20260131);
  const std::string alphabet = "{}[]\",:0123456789.eE+-ntf \\/u\x80\xc3\xff";
  int good = 0;
  for (int trial = 0; trial < bahnwerk::testing::cases(20'000); ++trial) {
    std::string body = bodies[random() % bodies.size()];
    for (std::size_t edits = 1 + random() % 4; edits > 0 && !body.empty(); --edits) {
      const std::size_t at = random() % body.size();
      switch (random() % 5) {
        case 0:
          body[at] = static_cast<char>(random());
          break;
        case 1:
          body[at] = alphabet[random() % alphabet.size()];
          break;
        case 2:
          body.erase(at, 1 + random() % 8);
          break;
        case 3:
          body.insert(at, 1, alphabet[random() % alphabet.size()]);
          break;
        default:
          body.insert(at, body.substr(random() % body.size(), random() % 20));
          break;
      }
    }
    good += accepted(body);
  }
  EXPECT_GT(200 * good, bahnwerk::testing::cases(20'000)) << "mutations that stay valid have to occur";
  EXPECT_LT(20 * good, 19 * bahnwerk::testing::cases(20'000));
}

/// Replaces, removes or adds one value somewhere in a document.
void mutate(json& node, std::mt19937_64& random) {
  static const std::vector<json> values{nullptr,
                                        true,
                                        0,
                                        -1,
                                        2,
                                        1.5,
                                        1e9,
                                        "",
                                        "cut",
                                        "text",
                                        json::array(),
                                        json::object(),
                                        json::array({0, 0}),
                                        json::array({1, 2, 3}),
                                        json::object({{"line", {1, 1}}}),
                                        "polygon",
                                        json::object({{"copper", 0.9}, {"outer", 1}})};
  json* at = &node;
  while (at->is_structured() && !at->empty() && random() % 5) {
    auto child = at->begin();
    std::advance(child, static_cast<std::ptrdiff_t>(random() % at->size()));
    at = &*child;
  }
  if (at->is_object() && random() % 2) {
    static const char* names[] = {"feed", "line",    "arc",       "points", "closed", "gcode", "jerk",   "z",
                                  "mode", "unknown", "tolerance", "type",   "slot",   "wires", "copper", "liner"};
    (*at)[names[random() % std::size(names)]] = values[random() % values.size()];
  } else if (at->is_object() && !at->empty() && random() % 2) {
    auto member = at->begin();
    std::advance(member, static_cast<std::ptrdiff_t>(random() % at->size()));
    at->erase(member);
  } else if (at->is_array() && random() % 2) {
    at->push_back(values[random() % values.size()]);
  } else {
    *at = values[random() % values.size()];
  }
}

/// Removes "format", which valijson would check.
void strip_format(json& schema) {
  if (schema.is_object() && schema.contains("format") && schema["format"].is_string()) schema.erase("format");
  for (auto& child : schema)
    if (child.is_structured()) strip_format(child);
}

class MutationsOfValues : public ::testing::TestWithParam<std::string> {};

TEST_P(MutationsOfValues, GetEqualVerdictsFromRulesExplainerAndValijson) {
  const Schema schema(embedded(GetParam()));
  const json rules = json::parse(embedded(GetParam()));
  json stripped = rules;
  strip_format(stripped);
  valijson::Schema compiled;
  const valijson::adapters::NlohmannJsonAdapter schema_adapter(stripped);
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(schema_adapter, compiled);
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  Progress silent;
  std::mt19937_64 random(7);
  std::vector<json> specs;
  for (const auto& file : test::json_files("schemas/examples/" + GetParam())) specs.push_back(test::read_json(file));
  int valid = 0;
  for (int trial = 0; trial < bahnwerk::testing::cases(20'000); ++trial) {
    json spec = specs[random() % specs.size()];
    for (std::size_t edits = 1 + random() % 2; edits > 0; --edits) mutate(spec, random);
    const auto errors = schema.validate(spec);
    ASSERT_EQ(errors.empty(), explain(rules, spec, "", 50, silent).empty()) << spec.dump();
    ASSERT_EQ(errors.empty(), validator.validate(compiled, valijson::adapters::NlohmannJsonAdapter(spec), nullptr))
        << spec.dump();
    for (const auto& error : errors) ASSERT_NE(error.message, "does not follow the schema") << spec.dump();
    valid += errors.empty();
    accepted(test::job_with_spec(GetParam(), spec).dump());
  }
  EXPECT_GT(40 * valid, bahnwerk::testing::cases(20'000));
  EXPECT_LT(4 * valid, 3 * bahnwerk::testing::cases(20'000));
}

std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for (const auto& kind : kinds()) names.emplace_back(kind.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Kinds, MutationsOfValues, ::testing::ValuesIn(names_of_kinds()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace bahnwerk::api
