#include "api/text/json_text.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Problem fault(std::string_view text) {
  try {
    parse_json(text);
  } catch (const Problem& problem) {
    return problem;
  }
  ADD_FAILURE() << "accepted: " << text.substr(0, 100);
  return {"internal", "accepted"};
}

TEST(ParseJson, ReadsWhatTheLibraryReads) {
  for (const char* text : {R"({"a":[1,2.5,-3e2,true,false,null,"text ä \u00e4"],"b":{"c":{}}})", "[]", "7", "\"x\"",
                           " \n[1 , 2]\t", R"([[[]],{"a":[{"b":[1]}],"c":2}])"})
    EXPECT_EQ(parse_json(text), json::parse(text));
}

TEST(ParseJson, GivesIntegersOneForm) {
  EXPECT_EQ(parse_json("[2.0,2e0,20e-1,2,-0.0,-0]").dump(), "[2,2,2,2,0,0]");
  EXPECT_EQ(parse_json("[9007199254740992.0]").dump(), "[9007199254740992]");
  EXPECT_EQ(parse_json("[1e16,2.5]").dump(), "[1e+16,2.5]");
  EXPECT_TRUE(parse_json("18446744073709551615").is_number_float());  // beyond a signed integer
}

TEST(ParseJson, RefusesWhatIsNoJson) {
  for (const char* text : {"",
                           " ",
                           "{",
                           "[1",
                           "{\"a\"",
                           "{\"a\":}",
                           "[1,]",
                           "[1] 2",
                           "[1]]",
                           "{'a':1}",
                           "NaN",
                           "[NaN]",
                           "[Infinity]",
                           "[-Infinity]",
                           "nul",
                           "// c\n1",
                           "[01]",
                           "[1.]",
                           "[.5]",
                           "[+1]",
                           "\"\\x\"",
                           "\"\x01\"",
                           "[\"\xff\"]",
                           "[\"\xc3\"]",
                           "[\"\xed\xa0\x80\"]",
                           "[\"\\ud800\"]"}) {
    const Problem problem = fault(text);
    EXPECT_EQ(problem.type().slug, "invalid-json") << text;
    EXPECT_NO_THROW(problem.document("/").dump()) << "a detail has to be text itself";
  }
}

TEST(ParseJson, NamesLineAndColumn) {
  EXPECT_THAT(fault("{\n  \"a\": 1,\n  \"b\": x\n}").what(), HasSubstr("line 3, column 8"));
  EXPECT_THAT(fault("[1").what(), testing::StartsWith("line 1, column 3: "));
}

TEST(ParseJson, RefusesNumbersBeyondADouble) {
  EXPECT_THAT(fault("[1e999]").what(), HasSubstr("number overflow"));
  EXPECT_THAT(fault("[" + std::string(5000, '9') + "]").what(), HasSubstr("number overflow"));
  EXPECT_LT(std::string(fault("[" + std::string(100000, '9') + "]").what()).size(), 300u);
}

TEST(ParseJson, NamesADuplicateKeyByItsPointer) {
  const Problem problem = fault(R"({"a":[0,{"b/c":1,"d":{"b/c":2},"b/c":3}]})");
  EXPECT_EQ(test::pointers(problem), std::vector<std::string>{"/a/1/b~1c"});
}

TEST(ParseJson, LimitsNesting) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_NO_THROW(parse_json(nested(deepest_nesting)));
  EXPECT_THAT(fault(nested(deepest_nesting + 1)).what(), HasSubstr("64 levels"));
  EXPECT_THAT(fault(std::string(10'000'000, '[')).what(), HasSubstr("64 levels"));
  std::string objects;
  for (int i = 0; i < 1'000'000; ++i) objects += "{\"a\":";
  EXPECT_THAT(fault(objects).what(), HasSubstr("64 levels"));
}

TEST(ParseJson, KeepsEveryDouble) {
  for (double x :
       {0.1, 1.0 / 3, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, -123456.789012345, 4503599627370497.5})
    EXPECT_EQ(parse_json(json(x).dump()).get<double>(), x);
}

std::string repeated(std::string_view piece, std::size_t bytes) {
  std::string text = "[";
  while (text.size() < bytes) text.append(piece).append(",");
  text.back() = ']';
  return text;
}

TEST(ParseJson, RefusesWhatWouldTakeTooMuchMemoryBeforeReadingIt) {
  for (const char* piece : {"[]", "{}", R"({"a":{}})", "[[[[]]]]"}) {
    const auto problem = fault(repeated(piece, 64 << 20));
    EXPECT_EQ(problem.type().slug, "payload-too-large") << piece;
    EXPECT_THAT(problem.what(), HasSubstr("at most 768 MiB"));
  }
}

TEST(ParseJson, StopsWhereAnArrayOrObjectHasTooManyParts) {
  EXPECT_EQ(parse_json(repeated("0", 2 * max_items)).size(), max_items);
  for (const char* piece : {"0", "[]", "{}"}) {
    const auto problem = fault(repeated(piece, (std::string_view(piece).size() + 1) * (max_items + 1)));
    EXPECT_EQ(problem.type().slug, "payload-too-large") << piece;
    EXPECT_THAT(problem.what(), HasSubstr("an array has more than 2000000 items"));
  }
  std::string object = "{";
  for (std::size_t i = 0; i < max_members; ++i) object += "\"" + std::to_string(i) + "\":0,";
  EXPECT_EQ(parse_json(object.substr(0, object.size() - 1) + "}").size(), max_members);
  const auto problem = fault(object + "\"x\":0}");
  EXPECT_EQ(problem.type().slug, "payload-too-large");
  EXPECT_THAT(problem.what(), HasSubstr("an object has more than 10000 members"));
}

TEST(ParseJson, LargestDocumentsOfTheSchemasFit) {
  // Two million points in space, two million lines, a program of 64 MB: what the schema of contours allows.
  EXPECT_LT(2e6 * static_cast<double>(document_memory("[1234.56789,1234.56789,12.3],")), 768.0 * 1048576);
  EXPECT_LT(2e6 * static_cast<double>(document_memory(R"({"line":[1234.56789,1234.56789]},)")), 768.0 * 1048576);
  EXPECT_LT(document_memory('"' + std::string(64 << 20, 'x') + '"'), std::size_t{65} << 20);
}

TEST(ParseJson, EstimatesMemoryFromAbove) {
  // What lies inside strings counts by its length alone, whatever it looks like.
  EXPECT_EQ(document_memory(R"("[[[{{{:::,,,")"), document_memory(R"("abcabcabcabc")"));
  EXPECT_EQ(document_memory(R"("a\"[[[")"), document_memory(R"("a\"bcd")"));
  EXPECT_GE(document_memory("[[],[]]"), 3 * (sizeof(json) + 24));
  EXPECT_GE(document_memory(R"({"a":1,"b":2})"), sizeof(json) + 48 + 2 * (32 + 32 + sizeof(json)));
}

TEST(ParseJson, AsksProgress) {
  struct Counter : ProgressSink {
    void report(std::string_view stage, double, std::string_view) override {
      EXPECT_EQ(stage, "read");
      if (++reports == 3) throw std::runtime_error("stop");
    }
    int reports = 0;
  } counter;
  EXPECT_THROW(parse_json(repeated("1", 100'000), counter), std::runtime_error);
  EXPECT_EQ(counter.reports, 3);
}

TEST(AppendNumber, IsTheShortestTextThatReadsBack) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    double value;
    const std::uint64_t bits = random();
    std::memcpy(&value, &bits, 8);
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    double back;
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(back, value);
    ASSERT_EQ(nlohmann::json::parse(text).get<double>(), value) << text;
  }
}

TEST(AppendNumber, WritesPlainFormsPlainly) {
  const auto text = [](double value) {
    std::string out;
    append_number(out, value);
    return out;
  };
  EXPECT_EQ(text(-0.0), "0");
  EXPECT_EQ(text(12), "12");
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(-1e-9), "-1e-09");
  EXPECT_EQ(text(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(text(std::nan("")), "null");
}

}  // namespace
}  // namespace bahnwerk::api
