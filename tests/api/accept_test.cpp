#include <gtest/gtest.h>

#include "api/setpoints.hpp"

namespace bahnwerk::api {
namespace {

constexpr auto none = std::nullopt;

TEST(Accept, DefaultsToJson) {
  for (const char* accept :
       {"", " ", "*/*", "application/*", "application/json", "APPLICATION/JSON", "text/html, */*;q=0.1"})
    EXPECT_EQ(negotiate_setpoints(accept), SetpointFormat::json) << accept;
}

TEST(Accept, TakesTheTypeAskedFor) {
  EXPECT_EQ(negotiate_setpoints("text/csv"), SetpointFormat::csv);
  EXPECT_EQ(negotiate_setpoints("text/*"), SetpointFormat::csv);
  EXPECT_EQ(negotiate_setpoints("text/csv; charset=utf-8"), SetpointFormat::csv);
  EXPECT_EQ(negotiate_setpoints("application/x-ndjson"), SetpointFormat::ndjson);
  EXPECT_EQ(negotiate_setpoints("application/octet-stream"), SetpointFormat::f64);
}

TEST(Accept, FollowsQualityAndSpecificity) {
  EXPECT_EQ(negotiate_setpoints("application/json;q=0.5, text/csv"), SetpointFormat::csv);
  EXPECT_EQ(negotiate_setpoints("application/json;q=0.5, text/csv;q=0.4"), SetpointFormat::json);
  EXPECT_EQ(negotiate_setpoints("text/csv, */*"), SetpointFormat::csv);
  EXPECT_EQ(negotiate_setpoints("*/*, text/csv;q=0.9"), SetpointFormat::json);
  EXPECT_EQ(negotiate_setpoints("*/*, application/json;q=0"), SetpointFormat::csv);
  EXPECT_EQ(negotiate_setpoints("application/*;q=0.3, application/x-ndjson;q=0.7"), SetpointFormat::ndjson);
  EXPECT_EQ(negotiate_setpoints("application/*, application/json;q=0.1"), SetpointFormat::ndjson);
}

TEST(Accept, RefusesWhatItCannotProduce) {
  for (const char* accept : {"text/html", "application/xml", "application/json;q=0", "*/*;q=0", "nonsense", "/",
                             "*/json", "image/*", "application/json;q=2", "application/json;q=x"})
    EXPECT_EQ(negotiate_setpoints(accept), none) << accept;
}

TEST(Accept, EveryFormatHasItsType) {
  for (auto format : {SetpointFormat::json, SetpointFormat::csv, SetpointFormat::ndjson, SetpointFormat::f64})
    EXPECT_EQ(negotiate_setpoints(content_type(format)), format);
}

}  // namespace
}  // namespace bahnwerk::api
