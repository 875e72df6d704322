#include "api/schema/schema_rules.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

bool allowed(const char* schema, const char* document) {
  const json rules = json::parse(schema);
  SilentProgress silent;
  return SchemaRules(rules).allow(json::parse(document), silent);
}

TEST(SchemaRules, EveryKeywordAllowsAndRefuses) {
  struct Case {
    const char *schema, *good, *bad;
  };
  for (const Case& each : std::initializer_list<Case>{
           {R"({"type":"integer"})", "1", "1.5"},
           {R"({"type":["number","null"]})", "1", "true"},
           {R"({"type":"object"})", "{}", "[]"},
           {R"({"type":"boolean"})", "false", "\"false\""},
           {R"({"const":"cut"})", R"("cut")", R"("CUT")"},
           {R"({"enum":[1,"a",null]})", "null", "2"},
           {R"({"minimum":2})", "2", "1.99"},
           {R"({"maximum":2})", "2", "2.01"},
           {R"({"exclusiveMinimum":2})", "2.01", "2"},
           {R"({"exclusiveMaximum":2})", "1.99", "2"},
           {R"({"minLength":2})", R"("äö")", R"("ä")"},
           {R"({"maxLength":2})", R"("äö")", R"("abc")"},
           {R"({"minItems":1})", "[0]", "[]"},
           {R"({"maxItems":1})", "[0]", "[0,0]"},
           {R"({"minProperties":1})", R"({"a":1})", "{}"},
           {R"({"maxProperties":1})", R"({"a":1})", R"({"a":1,"b":2})"},
           {R"({"required":["a"]})", R"({"a":1})", R"({"b":1})"},
           {R"({"properties":{"a":{"type":"null"}}})", R"({"a":null,"b":1})", R"({"a":1})"},
           {R"({"properties":{"a":true},"additionalProperties":false})", R"({"a":1})", R"({"b":1})"},
           {R"({"additionalProperties":{"type":"null"}})", R"({"b":null})", R"({"b":1})"},
           {R"({"items":{"type":"number"}})", "[1,2]", R"([1,"2"])"},
           {R"({"oneOf":[{"minimum":0},{"maximum":9}]})", "10", "5"},
           {R"({"items":{"$ref":"#/$defs/n"},"$defs":{"n":{"type":"number"}}})", "[1]", "[null]"},
           {"true", "1", nullptr}}) {
    EXPECT_TRUE(allowed(each.schema, each.good)) << each.schema;
    if (each.bad != nullptr) {
      EXPECT_FALSE(allowed(each.schema, each.bad)) << each.schema;
    }
  }
  EXPECT_FALSE(allowed("false", "1"));
}

TEST(SchemaRules, ASchemaMayReferToItself) {
  const char* tree =
      R"({"$ref":"#/$defs/t","$defs":{"t":{"type":"object","properties":{"next":{"$ref":"#/$defs/t"}},"additionalProperties":false}}})";
  EXPECT_TRUE(allowed(tree, R"({"next":{"next":{}}})"));
  EXPECT_FALSE(allowed(tree, R"({"next":{"next":{"other":1}}})"));
}

TEST(SchemaRules, AskEveryFewThousandValues) {
  struct Counts final : Progress {
    void report(std::string_view, double, std::string_view) override { ++asked; }
    int asked = 0;
  } counts;
  const json schema = json::parse(R"({"items":{"type":"number"}})");
  const SchemaRules rules(schema);
  EXPECT_TRUE(rules.allow(json(std::vector<double>(100'000, 1.5)), counts));
  EXPECT_GE(counts.asked, 20);
}

}  // namespace
}  // namespace bahnwerk::api
