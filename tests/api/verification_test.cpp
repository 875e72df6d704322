#include "api/verification.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::api {
namespace {

using nlohmann::ordered_json;

TEST(BoundDocument, NamesWhatIsBounded) {
  EXPECT_EQ(bound({2, 0.5, "a"}).dump(), R"({"duration":2.0,"gap":0.5,"basis":"a"})");
  EXPECT_EQ(bound({12, 0.25, "b", BoundQuantity::count, BoundSense::upper, "1"}).dump(),
            R"({"count":12,"gap":0.25,"basis":"b"})");
  EXPECT_EQ(bound({4.5, 0, "c", BoundQuantity::objective, BoundSense::lower, "1"}).dump(),
            R"({"objective":4.5,"gap":0.0,"basis":"c"})");
}

}  // namespace
}  // namespace bahnwerk::api
