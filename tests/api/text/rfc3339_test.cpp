#include "api/text/rfc3339.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

TEST(Rfc3339, WritesUtcWithMilliseconds) {
  EXPECT_EQ(rfc3339(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(rfc3339(1769860800123), "2026-01-31T12:00:00.123Z");
  EXPECT_EQ(rfc3339(-1), "1969-12-31T23:59:59.999Z");
}

TEST(Rfc3339, ReadsWhatItWrites) {
  for (std::int64_t ms = -5'000'000'000'123; ms < 5'000'000'000'000; ms += 98'765'432'101)
    EXPECT_EQ(parse_rfc3339(rfc3339(ms)), ms);
}

TEST(Rfc3339, ReadsOffsetsAndFractions) {
  EXPECT_EQ(parse_rfc3339("2026-01-31T13:00:00+01:00"), parse_rfc3339("2026-01-31T12:00:00Z"));
  EXPECT_EQ(parse_rfc3339("2026-01-31T06:30:00-05:30"), parse_rfc3339("2026-01-31T12:00:00Z"));
  EXPECT_EQ(parse_rfc3339("1970-01-01t00:00:00.5z"), 500);
  EXPECT_EQ(parse_rfc3339("1970-01-01 00:00:00.0019999Z"), 1);
  EXPECT_EQ(parse_rfc3339("2016-12-31T23:59:60Z"), parse_rfc3339("2017-01-01T00:00:00Z"));  // a leap second
  EXPECT_TRUE(parse_rfc3339("2028-02-29T00:00:00Z"));
}

TEST(Rfc3339, RefusesWhatIsNoTime) {
  for (const char* text :
       {"", "2026", "2026-01-31", "2026-01-31T12:00:00", "2026-01-31T12:00Z", "2026-1-31T12:00:00Z",
        "2026-02-29T12:00:00Z", "2026-13-01T12:00:00Z", "2026-00-01T12:00:00Z", "2026-01-00T12:00:00Z",
        "2026-01-31T24:00:00Z", "2026-01-31T12:60:00Z", "2026-01-31T12:00:61Z", "2026-01-31T12:00:00.Z",
        "2026-01-31T12:00:00+1:00", "2026-01-31T12:00:00+24:00", "2026-01-31T12:00:00Zx", " 2026-01-31T12:00:00Z",
        "-026-01-31T12:00:00Z"})
    EXPECT_FALSE(parse_rfc3339(text)) << text;
}

}  // namespace
}  // namespace bahnwerk::api
