#include "api/text/json_range.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

std::string found(std::string_view json, const std::vector<std::string>& path) {
  const auto range = value_range(json, path);
  return range ? std::string(json.substr(range->begin, range->end - range->begin)) : "none";
}

TEST(JsonRange, FindsValuesOfEveryType) {
  const std::string_view json = R"( { "a" : 1 , "b":"x\"y}" , "c" : {"d":[1,{"e":"]"}], "f":null} ,"g":true,"h":-1e5})";
  EXPECT_EQ(found(json, {"a"}), "1");
  EXPECT_EQ(found(json, {"b"}), R"("x\"y}")");
  EXPECT_EQ(found(json, {"c"}), R"({"d":[1,{"e":"]"}], "f":null})");
  EXPECT_EQ(found(json, {"c", "d"}), R"([1,{"e":"]"}])");
  EXPECT_EQ(found(json, {"c", "f"}), "null");
  EXPECT_EQ(found(json, {"g"}), "true");
  EXPECT_EQ(found(json, {"h"}), "-1e5");
}

TEST(JsonRange, FindsNothingWhereThereIsNoSuchMember) {
  EXPECT_EQ(found("{}", {"a"}), "none");
  EXPECT_EQ(found(R"({"b":{"a":1}})", {"a"}), "none");
  EXPECT_EQ(found(R"({"a":1})", {"a", "b"}), "none");
  EXPECT_EQ(found(R"({"a":[{"b":1}]})", {"a", "b"}), "none");
}

TEST(JsonRange, ReadsEscapedNames) { EXPECT_EQ(found(R"({"\u0061\"":7})", {"a\""}), "7"); }

}  // namespace
}  // namespace bahnwerk::api
