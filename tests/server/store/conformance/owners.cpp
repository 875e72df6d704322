#include "stores.hpp"

namespace bahnwerk::server {
namespace {

template <class S>
struct Owners : Conformance<S> {};
TYPED_TEST_SUITE(Owners, Stores, StoreNames);

NewJob owned(const std::string& owner, int priority = 0) {
  NewJob job = new_job(priority);
  job.owner = owner;
  return job;
}

TYPED_TEST(Owners, TakeTurnsAtEqualPriority) {
  auto& store = *this->here;
  for (int i = 0; i < 4; ++i) insert_id(store, owned("many"));
  insert_id(store, owned("few"));
  insert_id(store, owned("few"));
  insert_id(store, owned("one", -1));
  insert_id(store, owned("first", 1));
  std::string order;
  while (const auto job = claim(store, 0)) order += job->owner.value_or("-") + " ";
  EXPECT_EQ(order, "first many few many few many many one ");
}

TYPED_TEST(Owners, WhoPostsOneJobAtATimeWaitsForOneOfEachOther) {
  auto& store = *this->here;
  for (int i = 0; i < 50; ++i) insert_id(store, owned("many"));
  for (int i = 0; i < 10; ++i) claim(store, 0);
  std::string order;
  for (int i = 0; i < 3; ++i) {
    insert_id(store, owned("one"));
    for (int k = 0; k < 2; ++k) order += claim(store, 0)->owner.value() + " ";
  }
  EXPECT_EQ(order, "many one many one many one ");
}

TYPED_TEST(Owners, QuotasCountQueuedJobsAndThePlanningTimeOfTheDay) {
  auto& store = *this->here;
  NewJob job = owned("acme");
  job.max_owned = 1;
  const std::string id = insert_id(store, job);
  EXPECT_EQ(insert(store, job).what, Inserted::What::owner_full);
  job.owner = "other";
  EXPECT_EQ(insert(store, job).what, Inserted::What::created);
  const auto claimed = claim(store, job.now);
  EXPECT_TRUE(store.end({id, claimed->token}, {.error = "{}", .now = job.now + 5000, .revision = 1}));
  job = owned("acme");
  job.max_planning_ms = 5000;
  EXPECT_EQ(insert(store, job).what, Inserted::What::planning_spent);
  job.max_planning_ms = 5001;
  EXPECT_EQ(insert(store, job).what, Inserted::What::created);
  job.max_planning_ms = 5000;
  job.now += ms_per_day;
  EXPECT_EQ(insert(store, job).what, Inserted::What::created);
}

TYPED_TEST(Owners, ListsAndIdempotencyKeysAreTheirOwn) {
  auto& store = *this->here;
  NewJob job = new_job(0, "order", "hash");
  const std::string free = insert_id(store, job);
  job.owner = "acme";
  const std::string acme = insert_id(store, job);
  EXPECT_NE(free, acme);
  EXPECT_EQ(insert_id(store, job), acme);
  JobFilter filter;
  filter.owner = "acme";
  ASSERT_EQ(store.list(filter).size(), 1U);
  EXPECT_EQ(store.list(filter).front().owner, "acme");
  EXPECT_EQ(store.get(free)->owner, std::nullopt);
}

}  // namespace
}  // namespace bahnwerk::server
