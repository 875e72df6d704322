#include "api/schema.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "api/embedded.hpp"
#include "api/kind.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

std::string only_message(const std::string& schema, const std::string& document) {
  const auto errors = Schema(schema).validate(json::parse(document));
  if (errors.size() != 1) return std::to_string(errors.size()) + " errors";
  return errors[0].pointer + ": " + errors[0].message;
}

TEST(Schema, SaysWhatIsWrongAndWhere) {
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

TEST(Schema, FollowsReferences) {
  const std::string schema =
      R"({"items":{"$ref":"#/$defs/p"},"$defs":{"p":{"type":"array","items":{"$ref":"#/$defs/n"}},"n":{"type":"number"}}})";
  EXPECT_EQ(only_message(schema, "[[1],[2,\"x\"]]"), "/1/1: must be a number");
}

TEST(Schema, PutsThePrefixBeforeEveryPointer) {
  const auto errors = Schema(R"({"required":["a"]})").validate(json::object(), "/spec");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/spec/a");
}

TEST(Schema, StopsAtTheFirstFifty) {
  json many = json::array();
  for (int i = 0; i < 1000; ++i) many.push_back("x");
  EXPECT_EQ(Schema(R"({"items":{"type":"number"}})").validate(many).size(), Schema::max_faults);
}

TEST(Schema, RefusesKeywordsThatItWouldIgnore) {
  for (const char* schema :
       {R"({"dependentRequired":{}})", R"({"properties":{"a":{"pattern":"x"}}})", R"({"items":{"multipleOf":2}})",
        R"({"$ref":"other.json"})", R"({"oneOf":[{"unevaluatedProperties":false}]})"})
    EXPECT_THROW(Schema{schema}, std::invalid_argument) << schema;
  EXPECT_ANY_THROW(Schema{R"({"$ref":"#/$defs/missing"})"});
}

// The served schemas promise what the code does: every node is closed, described and carries units.
class Lint {
 public:
  /// Numbers of a result need no limits: it is the planner that computes them.
  enum class Of { documents, results };
  explicit Lint(json schema, Of of = Of::documents) : root_(std::move(schema)), of_(of) { node(root_, "#"); }
  std::vector<std::string> findings;

 private:
  json root_;
  Of of_;

  void find(const std::string& at, const char* what) { findings.push_back(at + ": " + what); }
  static bool has_type(const json& schema, const char* type) {
    if (!schema.contains("type")) return false;
    const auto& types = schema["type"];
    return types.is_array() ? std::find(types.begin(), types.end(), type) != types.end() : types == type;
  }
  void node(const json& schema, const std::string& at, bool branch = false) {
    if (schema.is_boolean()) return;
    if (schema.contains("$ref")) {
      for (const auto& [key, value] : schema.items())
        if (key != "$ref" && key != "description") find(at, "draft 7 ignores what stands beside $ref");
      return;
    }
    const std::string description = schema.value("description", "");
    if (description.size() < 5) find(at, "no description");
    if (has_type(schema, "number") || has_type(schema, "integer")) {
      static const std::set<std::string> units{"mm",    "mm/s", "mm/s²", "mm/s³", "mm/s⁴", "mm²/s³", "mm²",
                                               "s",     "deg",  "°C",    "Ω/m",   "(1)",   "`unit`", "N",
                                               "N/mm²", "Ω",    "1/min", "1/mm",  "kg",    "g",      "Hz"};
      bool unit = false;
      std::string text = description;
      for (char& c : text)
        if (c == ',' || c == ';' || c == '.' || c == ':') c = ' ';
      std::istringstream words(text);
      for (std::string word; words >> word;) unit |= units.count(word) > 0;
      if (!unit) find(at, "a number without a unit in its description");
      if (of_ == Of::documents && !schema.contains("minimum") && !schema.contains("exclusiveMinimum"))
        find(at, "a number without a lower limit");
      if (of_ == Of::documents && !schema.contains("maximum") && !schema.contains("exclusiveMaximum"))
        find(at, "a number without an upper limit");
    }
    if (has_type(schema, "string") && !schema.contains("maxLength")) find(at, "a string without a longest length");
    if (has_type(schema, "array") && (!schema.contains("items") || !schema.contains("maxItems")))
      find(at, "an array without items or largest size");
    if (has_type(schema, "object") && !schema.contains("additionalProperties"))
      find(at, "an object that does not say whether it is closed");
    if (!branch && !schema.contains("type") && !schema.contains("enum")) find(at, "no type");
    for (const char* key : {"properties", "$defs"})
      if (schema.contains(key))
        for (const auto& [name, child] : schema[key].items()) node(child, at + "/" + key + "/" + name);
    if (schema.contains("items")) node(schema["items"], at + "/items");
    if (schema.contains("oneOf"))
      for (const auto& child : schema["oneOf"]) {
        if (!child.contains("title") && !child.contains("$ref")) find(at, "a choice without a title");
        node(child, at + "/oneOf", true);
      }
    if (schema.contains("default") && !schema.contains("$ref")) {
      json bare = schema;
      bare["$defs"] = root_.value("$defs", json::object());
      if (!Schema(bare.dump()).validate(schema["default"]).empty()) find(at, "the default breaks its own schema");
    }
  }
};

TEST(ServedSchemas, AreClosedDescribedAndCarryUnits) {
  std::vector<std::pair<std::string, Lint::Of>> names{{"job", Lint::Of::documents}};
  for (const auto& kind : kinds()) {
    names.emplace_back(kind.name, Lint::Of::documents);
    names.emplace_back(std::string(kind.name) + ".result", Lint::Of::results);
  }
  for (const auto& [name, of] : names) {
    const auto text = embedded(name);
    ASSERT_FALSE(text.empty()) << name;
    const json schema = json::parse(text);
    EXPECT_EQ(schema["$id"], "/v1/schemas/" + name);
    EXPECT_NO_THROW(Schema{text}) << name;
    EXPECT_EQ(Lint(schema, of).findings, std::vector<std::string>{}) << name;
  }
}

TEST(ServedSchemas, AreTheFilesOfTheSourceTree) {
  std::set<std::string> names;
  for (const auto& file : test::json_files("schemas")) {
    const auto name = std::filesystem::path(file).stem().string();
    EXPECT_EQ(embedded(name), test::read_file(file)) << name;
    names.insert(name);
  }
  EXPECT_EQ(names.size(), embedded_files().size());
  EXPECT_EQ(embedded("no-such-file"), "");
}

TEST(Lint, FindsWhatItLooksFor) {
  EXPECT_EQ(Lint(json::parse(R"({"type":"number","description":"a speed"})")).findings.size(), 3u);
  EXPECT_EQ(Lint(json::parse(R"({"type":"object","description":"an object"})")).findings.size(), 1u);
  EXPECT_EQ(Lint(json::parse(R"({"type":"number","description":"speed, mm/s","minimum":0,"maximum":9,"default":10})"))
                .findings.size(),
            1u);
}

}  // namespace
}  // namespace bahnwerk::api
