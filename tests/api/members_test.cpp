#include "api/members.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::api {
namespace {

TEST(Members, AreTakenWhereTheyAreGivenInTheUnitOfCore) {
  const auto object = nlohmann::json::parse(R"({"length": 2, "none": null})");
  double length = 1, other = 1;
  take(object, "length", length, 10);
  EXPECT_EQ(length, 20);
  take(object, "length", length);
  EXPECT_EQ(length, 2);
  take(object, "none", other, 10);
  take(object, "absent", other, 10);
  EXPECT_EQ(other, 1);
  EXPECT_EQ(given<double>(object, "length"), 2);
  EXPECT_FALSE(given<double>(object, "none"));
  EXPECT_FALSE(given<double>(object, "absent"));
}

}  // namespace
}  // namespace bahnwerk::api
