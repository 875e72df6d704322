#include "api/schema/schema_explain.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/progress.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

Progress silent;

std::string only_message(const std::string& schema, const std::string& document) {
  const auto errors = explain(json::parse(schema), json::parse(document), "", 50, silent);
  if (errors.size() != 1) return std::to_string(errors.size()) + " errors";
  return errors[0].pointer + ": " + errors[0].message;
}

TEST(SchemaExplain, SaysWhatIsWrongAndWhere) {
  const auto in_a = [](const std::string& rule, const std::string& value) {
    return only_message(R"({"type":"object","properties":{"a":)" + rule + "}}", R"({"a":)" + value + "}");
  };
  EXPECT_EQ(in_a(R"({"type":"number"})", "\"x\""), "/a: must be a number");
  EXPECT_EQ(in_a(R"({"type":["integer","null"]})", "1.5"), "/a: must be an integer or null");
  EXPECT_EQ(in_a(R"({"minimum":0.5})", "0"), "/a: must be at least 0.5");
  EXPECT_EQ(in_a(R"({"maximum":1e7})", "1e8"), "/a: must be at most 1e+07");
  EXPECT_EQ(in_a(R"({"exclusiveMinimum":0})", "0"), "/a: must be greater than 0");
  EXPECT_EQ(in_a(R"({"exclusiveMaximum":1})", "1"), "/a: must be less than 1");
  EXPECT_EQ(in_a(R"({"enum":["a","b"]})", "\"c\""), "/a: must be one of \"a\", \"b\"");
  EXPECT_EQ(in_a(R"({"const":3})", "4"), "/a: must be 3");
  EXPECT_EQ(in_a(R"({"minLength":1})", "\"\""), "/a: must have at least 1 character");
  EXPECT_EQ(in_a(R"({"maxLength":2})", "\"äöü\""), "/a: must have at most 2 characters");
  EXPECT_EQ(in_a(R"({"minItems":2})", "[1]"), "/a: must have at least 2 items");
  EXPECT_EQ(in_a(R"({"maxItems":1})", "[1,2]"), "/a: must have at most 1 item");
  EXPECT_EQ(in_a(R"({"items":{"type":"string"}})", "[\"\",1]"), "/a/1: must be a string");
  EXPECT_EQ(in_a(R"({"required":["b/c"]})", "{}"), "/a/b~1c: is required");
  EXPECT_EQ(in_a(R"({"properties":{"b":{}},"additionalProperties":false})", R"({"c":1})"),
            "/a/c: unknown member; known are b");
  EXPECT_EQ(in_a("false", "1"), "/a: is not allowed here");
  EXPECT_EQ(in_a(R"({"enum":["a"],"x-not-available":["b"]})", "\"b\""),
            "/a: \"b\" is not available in this version; available: \"a\"");
  EXPECT_EQ(in_a(R"({"oneOf":[{"title":"p","required":["p"]},{"title":"q","required":["q"]}]})", "{}"),
            "/a: must be exactly one of: p, or q");
}

TEST(SchemaExplain, ListsTheValuesOfTheMemberThatSelectsABranch) {
  const std::string schema = R"({"oneOf":[
    {"properties":{"type":{"const":"p"},"x":{"type":"number"}},"required":["type","x"]},
    {"$ref":"#/$defs/q"}],"$defs":{"q":{"properties":{"type":{"const":"q"}},"required":["type"]}}})";
  EXPECT_EQ(only_message(schema, R"({"type":"r"})"), R"(/type: must be one of "p", "q")");
  EXPECT_EQ(only_message(schema, R"({"type":7,"x":1})"), R"(/type: must be one of "p", "q")");
  EXPECT_EQ(only_message(schema, "{}"), R"(/type: is required: one of "p", "q")");
  EXPECT_EQ(only_message(schema, R"({"type":"p"})"), "/x: is required");
}

TEST(SchemaExplain, FollowsReferences) {
  const std::string schema =
      R"({"items":{"$ref":"#/$defs/p"},"$defs":{"p":{"type":"array","items":{"$ref":"#/$defs/n"}},"n":{"type":"number"}}})";
  EXPECT_EQ(only_message(schema, "[[1],[2,\"x\"]]"), "/1/1: must be a number");
}

TEST(SchemaExplain, ReferencesLeadIntoTheSchemaOrAreRefused) {
  const json root = json::parse(R"({"$defs":{"a/b":{"type":"null"}},"$ref":"#/$defs/a~1b"})");
  EXPECT_EQ(&resolve_ref(root, root), &root["$defs"]["a/b"]);
  EXPECT_EQ(&resolve_ref(root, root["$defs"]), &root["$defs"]);
  EXPECT_THROW(check_schema(json::parse(R"({"items":{"$ref":"#/$defs/missing"}})")), std::invalid_argument);
  EXPECT_THROW(check_schema(json::parse(R"({"items":{"pattern":"x"}})")), std::invalid_argument);
  EXPECT_NO_THROW(check_schema(root));
}

TEST(SchemaExplain, OnePlaceHasOneFaultAndThereAreNoMoreThanAsked) {
  const json schema = json::parse(R"({"items":{"type":"number","minimum":3}})"), wrong = json::parse("[1,\"x\",2,4]");
  EXPECT_EQ(explain(schema, wrong, "/p", 50, silent).size(), 3u);
  const auto two = explain(schema, wrong, "/p", 2, silent);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[1].pointer, "/p/1");
  EXPECT_TRUE(explain(schema, json::parse("[3,4]"), "", 50, silent).empty());
}

}  // namespace
}  // namespace bahnwerk::api
