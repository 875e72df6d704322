#include "server/runtime/uuid7.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace bahnwerk::server {
namespace {

TEST(Uuid7, HasTheFormOfRfc9562) {
  Uuid7 ids;
  const std::regex form("[0-9a-f]{8}-[0-9a-f]{4}-7[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(std::regex_match(ids.next(1'700'000'000'000 + i), form));
  EXPECT_EQ(ids.next(0x0123456789ab * 4 / 4).substr(0, 13).size(), 13U);
}

TEST(Uuid7, CarriesTheTime) {
  Uuid7 ids;
  EXPECT_EQ(ids.next(0x018f1234abcd).substr(0, 13), "018f1234-abcd");
}

TEST(Uuid7, GrowsWhateverTheClockDoes) {
  Uuid7 ids;
  std::int64_t now = 1'700'000'000'000;
  std::string last;
  std::set<std::string> seen;
  for (int i = 0; i < 50'000; ++i) {
    if (i % 9'000 == 8'999) now += 3;
    if (i % 20'000 == 19'999) now -= 10'000;  // the clock steps back
    const std::string id = ids.next(now);
    EXPECT_GT(id, last);
    EXPECT_TRUE(seen.insert(id).second);
    last = id;
  }
}

TEST(Uuid7, ContinuesAfterTheLastOfAFormerProcess) {
  Uuid7 before, after;
  const std::string last = before.next(1'800'000'000'000);
  after.advance_past(last);
  EXPECT_GT(after.next(1'700'000'000'000), last);
  after.advance_past("nonsense");
  after.advance_past("zzzzzzzz-zzzz-7000-8000-000000000000");
  EXPECT_GT(after.next(1'700'000'000'000), last);
}

TEST(RandomId, IsNotRepeated) {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(seen.insert(random_id()).second);
}

}  // namespace
}  // namespace bahnwerk::server
