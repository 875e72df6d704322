#include "server/jobs/queue_places.hpp"

#include "tests/server/manual_time.hpp"
#include "tests/server/store/fixture.hpp"

namespace bahnwerk::server {
namespace {

TEST(QueuePlaces, CountTheJobsThatAreClaimedBefore) {
  const TempFolder folder;
  SqliteStore store({.path = (folder.path / "a.db").string()});
  const std::string first = insert_id(store), second = insert_id(store), urgent = insert_id(store, new_job(5));
  ManualTime time;
  QueuePlaces places(store, time);
  EXPECT_FALSE(places.ahead(first));
  places.look();
  EXPECT_EQ(places.ahead(urgent), 0U);
  EXPECT_EQ(places.ahead(first), 1U);
  EXPECT_EQ(places.ahead(second), 2U);
  EXPECT_FALSE(places.ahead("another"));
}

TEST(QueuePlaces, LookAtMostOnceASecond) {
  const TempFolder folder;
  SqliteStore store({.path = (folder.path / "a.db").string()});
  const std::string first = insert_id(store);
  ManualTime time;
  QueuePlaces places(store, time);
  places.look();
  store.cancel(first, 1);
  places.look();
  EXPECT_EQ(places.ahead(first), 0U);
  time.advance(std::chrono::milliseconds(1001));
  EXPECT_TRUE(places.outdated());
  places.look();
  EXPECT_FALSE(places.ahead(first));
}

}  // namespace
}  // namespace bahnwerk::server
