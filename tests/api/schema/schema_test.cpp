#include "api/schema/schema.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "api/kind.hpp"
#include "api/schema/embedded.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

bool allowed(const char* schema, const char* document) {
  return Schema(schema).validate(json::parse(document)).empty();
}

TEST(Schema, EveryKeywordAllowsAndRefuses) {
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

TEST(Schema, ASchemaMayReferToItself) {
  const char* tree =
      R"({"$ref":"#/$defs/t","$defs":{"t":{"type":"object","properties":{"next":{"$ref":"#/$defs/t"}},"additionalProperties":false}}})";
  EXPECT_TRUE(allowed(tree, R"({"next":{"next":{}}})"));
  EXPECT_FALSE(allowed(tree, R"({"next":{"next":{"other":1}}})"));
}

TEST(Schema, AsksEveryFewThousandValues) {
  struct Counts final : ProgressSink {
    void report(std::string_view, double, std::string_view) override { ++asked; }
    int asked = 0;
  } counts;
  EXPECT_TRUE(
      Schema(R"({"items":{"type":"number"}})").validate(json(std::vector<double>(100'000, 1.5)), "", counts).empty());
  EXPECT_GE(counts.asked, 20);
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
  EXPECT_THROW(Schema{R"({"$ref":"#/$defs/missing"})"}, std::invalid_argument);
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
      static const std::set<std::string> units{
          "mm", "mm/s",  "mm/s²", "mm/s³", "mm/s⁴", "mm²/s³", "mm²", "s",  "deg", "°C",   "Ω/m",   "(1)",    "`unit`",
          "N",  "N/mm²", "Ω",     "1/min", "1/mm",  "kg",     "g",   "Hz", "W",   "N/mm", "deg/s", "deg/s²", "deg/s³"};
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

TEST(Lint, FindsWhatItLooksFor) {
  EXPECT_EQ(Lint(json::parse(R"({"type":"number","description":"a speed"})")).findings.size(), 3u);
  EXPECT_EQ(Lint(json::parse(R"({"type":"object","description":"an object"})")).findings.size(), 1u);
  EXPECT_EQ(Lint(json::parse(R"({"type":"number","description":"speed, mm/s","minimum":0,"maximum":9,"default":10})"))
                .findings.size(),
            1u);
}

}  // namespace
}  // namespace bahnwerk::api
