#include "api/text/accept.hpp"

#include <gtest/gtest.h>

#include <array>

#include "api/setpoints/setpoints.hpp"

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

TEST(Accept, EveryEntryIsOneOfItsOwn) {
  constexpr std::array<std::string_view, 2> offers{"text/html", "application/json"};
  EXPECT_EQ(negotiate(none, offers), 0u);
  EXPECT_EQ(negotiate("application/json, text/html", offers), 0u) << "a tie: the order of the offers";
  EXPECT_EQ(negotiate("*/*, application/json", offers), 1u) << "named more specifically";
  EXPECT_EQ(negotiate(";;;,,, application/json ; charset=utf-8 ; q=0.2", offers), 1u);
  EXPECT_EQ(negotiate("*/*, text/html;q=0", offers), 1u);
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
