#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct Looks : Conformance<S> {};
TYPED_TEST_SUITE(Looks, Stores);

TYPED_TEST(Looks, PagesFromTheNewest) {
  auto& store = this->here;
  std::vector<std::string> ids;
  for (int i = 0; i < 23; ++i) {
    NewJob job = new_job();
    job.request.reference = i % 2 ? "odd" : "even";
    ids.insert(ids.begin(), insert_id(*store, job));
  }
  JobFilter filter;
  filter.limit = 5;
  std::vector<std::string> paged;
  for (;;) {
    const auto page = store->list(filter);
    if (page.empty()) break;
    for (const auto& job : page) paged.push_back(job.id);
    filter.before = paged.back();
  }
  EXPECT_EQ(paged, ids);
  JobFilter odd;
  odd.reference = "odd";
  odd.state = JobState::queued;
  odd.kind = "ramp";
  EXPECT_EQ(store->list(odd).size(), 11U);
  odd.kind = "other";
  EXPECT_TRUE(store->list(odd).empty());
}

TYPED_TEST(Looks, CountsTheJobsOfEveryState) {
  auto& store = this->here;
  const auto expect = [&](std::size_t queued, std::size_t running, std::size_t succeeded, std::size_t failed,
                          std::size_t cancelled) {
    const std::map<JobState, std::size_t> expected{{JobState::queued, queued},
                                                   {JobState::running, running},
                                                   {JobState::succeeded, succeeded},
                                                   {JobState::failed, failed},
                                                   {JobState::cancelled, cancelled}};
    EXPECT_EQ(store->counts(), expected);
    EXPECT_EQ(this->other->counts(), expected);
  };
  expect(0, 0, 0, 0, 0);
  this->queue(5);
  expect(5, 0, 0, 0, 0);
  const auto good = claim(*store, 1)->id, bad = claim(*store, 1)->id, back = claim(*store, 1)->id;
  expect(2, 3, 0, 0, 0);
  EXPECT_TRUE(store->succeed(good, 1, ramp_plan(1), 2, 0, this->silent));
  EXPECT_TRUE(store->end(bad, 1, {JobState::failed, "{}", 2, 0}));
  EXPECT_TRUE(store->requeue(back, 1, 2, 0));
  expect(3, 0, 1, 1, 0);
  EXPECT_EQ(store->cancel(back, 3)->state, JobState::cancelled);
  expect(2, 0, 1, 1, 1);
  for (const auto& id : {good, bad, back}) EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_EQ(store->remove(good), Removed::unknown);
  expect(2, 0, 0, 0, 0);
  this->restart();
  expect(2, 0, 0, 0, 0);
}

TYPED_TEST(Looks, RemovesWhatDoesNotRun) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  claim(*store, 1);
  EXPECT_EQ(store->remove(id), Removed::running);
  EXPECT_TRUE(store->succeed(id, 1, ramp_plan(10), 2, 0, this->silent));
  EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_FALSE(store->get(id));
  EXPECT_FALSE(store->result(id));
  EXPECT_FALSE(store->series(id));
  EXPECT_EQ(store->remove(id), Removed::unknown);
  EXPECT_TRUE(store->list({}).empty());
}

}  // namespace
}  // namespace bahnwerk::server
