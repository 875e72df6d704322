#include "api/text/query_values.hpp"

#include <gtest/gtest.h>

#include "api/problem.hpp"

namespace bahnwerk::api {
namespace {

TEST(QueryValues, ANumberIsTheWholeText) {
  EXPECT_EQ(natural("12"), 12U);
  for (const char* text : {"", "-1", "1.5", "1 ", "x", "99999999999999999999"}) EXPECT_FALSE(natural(text)) << text;
  EXPECT_EQ(real("-1.5e3"), -1500);
  for (const char* text : {"", "nan", "inf", "1e999", "1,5", "2x"}) EXPECT_FALSE(real(text)) << text;
}

TEST(QueryValues, PartsMayBeEmpty) {
  EXPECT_EQ(split("a,,b"), (std::vector<std::string>{"a", "", "b"}));
  EXPECT_EQ(split(""), std::vector<std::string>{""});
  EXPECT_EQ(split("a.b", '.'), (std::vector<std::string>{"a", "b"}));
}

TEST(QueryValues, ARefusalPointsAtTheParameter) {
  bool refused = false;
  try {
    refuse_parameter("a/b", "must be more");
  } catch (const Problem& problem) {
    refused = true;
    EXPECT_EQ(problem.type().slug, "schema-violation");
    ASSERT_EQ(problem.errors().size(), 1U);
    EXPECT_EQ(problem.errors()[0].pointer, "/query/a~1b");
    EXPECT_EQ(problem.errors()[0].message, "must be more");
  }
  EXPECT_TRUE(refused);
}

}  // namespace
}  // namespace bahnwerk::api
