#include "server/runtime/uuid7.hpp"

#include <gtest/gtest.h>

#include <set>

namespace bahnwerk::server {
namespace {

/// "x" stands for any hexadecimal digit, "v" for the variant's 8, 9, a or b.
bool has_form(const std::string& id, const std::string& form) {
  if (id.size() != form.size()) return false;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const std::string allowed = form[i] == 'x' ? "0123456789abcdef" : form[i] == 'v' ? "89ab" : std::string(1, form[i]);
    if (allowed.find(id[i]) == std::string::npos) return false;
  }
  return true;
}

TEST(Uuid7, HasTheFormOfRfc9562) {
  Uuid7 ids;
  for (int i = 0; i < 1000; ++i) {
    const std::string id = ids.next(1'700'000'000'000 + i);
    EXPECT_TRUE(has_form(id, "xxxxxxxx-xxxx-7xxx-vxxx-xxxxxxxxxxxx")) << id;
  }
}

TEST(Uuid7, CarriesTheTime) {
  Uuid7 ids;
  EXPECT_EQ(ids.next(0x018f1234abcd).substr(0, 13), "018f1234-abcd");
}

TEST(Uuid7, NoIdOfAMillisecondIsBelowItsFirst) {
  Uuid7 ids;
  for (const std::int64_t ms : {std::int64_t{1}, std::int64_t{1'700'000'000'000}, (std::int64_t{1} << 48) - 2}) {
    const std::string id = ids.next(ms);
    EXPECT_GE(id, first_id(ms));
    EXPECT_LT(id, first_id(ms + 1));
    EXPECT_EQ(first_id(ms).size(), id.size());
  }
  EXPECT_EQ(first_id(-5), first_id(0));
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
