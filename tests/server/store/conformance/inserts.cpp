#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct Inserts : Conformance<S> {};
TYPED_TEST_SUITE(Inserts, Stores, StoreNames);

TYPED_TEST(Inserts, KeepsEverythingOfAJob) {
  auto& store = this->here;
  NewJob job = new_job(7);
  job.request.name = "name \"quoted\"";
  job.request.reference = "WO-1";
  job.request.callback = api::Callback{"http://x/y", "secret"};
  job.callback_receiver = "http://x:80";
  job.request.tags = {"b", "a"};
  job.request.deadline = 1'800'000'000'000;
  job.request.time_budget = 2.5;
  job.request.document = "{\"text\":\"" + std::string(100'000, 'a') + "\"}";
  const std::string id = insert_id(*store, job);
  for (int round = 0; round < 2; ++round, this->restart()) {
    const auto kept = store->get(id);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->request.name, job.request.name);
    EXPECT_EQ(kept->request.reference, job.request.reference);
    EXPECT_EQ(kept->request.callback, job.request.callback);
    EXPECT_EQ(kept->request.tags, job.request.tags);
    EXPECT_EQ(kept->request.priority, 7);
    EXPECT_EQ(kept->request.deadline, job.request.deadline);
    EXPECT_EQ(kept->request.time_budget, job.request.time_budget);
    EXPECT_EQ(kept->request.document, job.request.document);
    EXPECT_EQ(kept->state, JobState::queued);
    EXPECT_EQ(kept->created_at, job.now);
    EXPECT_FALSE(kept->started_at || kept->finished_at || kept->error);
  }
  EXPECT_FALSE(store->get("no such job"));
}

TYPED_TEST(Inserts, HonoursKeys) {
  auto& store = this->here;
  const Inserted first = insert(*store, new_job(0, "k", "hash"));
  EXPECT_EQ(first.what, Inserted::What::created);
  const Inserted again = insert(*store, new_job(0, "k", "hash"));
  EXPECT_EQ(again.what, Inserted::What::replayed);
  EXPECT_EQ(again.id, first.id);
  EXPECT_EQ(insert(*store, new_job(0, "k", "other")).what, Inserted::What::conflict);
  EXPECT_EQ(store->remove(first.id), Removed::yes);
  EXPECT_EQ(insert(*store, new_job(0, "k", "other")).what, Inserted::What::created);
}

TYPED_TEST(Inserts, RefusesWhenTooManyWait) {
  auto& store = this->here;
  NewJob job = new_job();
  job.max_queued = 3;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(insert(*store, job).what, Inserted::What::created);
  EXPECT_EQ(insert(*store, job).what, Inserted::What::full);
  claim(*store, 1);
  EXPECT_EQ(insert(*store, job).what, Inserted::What::created);
}

}  // namespace
}  // namespace bahnwerk::server
