#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct Looks : Conformance<S> {};
TYPED_TEST_SUITE(Looks, Stores, StoreNames);

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

TYPED_TEST(Looks, TellsWhichJobsRunWithTheirRevisions) {
  auto& store = this->here;
  const std::string first = insert_id(*store), second = insert_id(*store);
  EXPECT_TRUE(store->running().empty());
  const auto job = claim(*store, 1);
  ASSERT_TRUE(job);
  auto running = this->other->running();
  ASSERT_EQ(running.size(), 1U);
  EXPECT_EQ(running[0].id, first);
  EXPECT_EQ(running[0].revision, job->revision);
  store->heartbeat({"worker", 1, Lease::forever}, {{{job->id, job->token}, 0.5, "stage", "", job->revision + 7}});
  running = this->other->running();
  ASSERT_EQ(running.size(), 1U);
  EXPECT_EQ(running[0].revision, this->other->get(first, false)->revision);
  EXPECT_EQ(running[0].revision, job->revision + 7);
}

TYPED_TEST(Looks, OpensTextsInPiecesThatAreGoneWithTheirJob) {
  auto& store = this->here;
  std::string long_text = "{\"n\":[";
  while (long_text.size() < 500'000) long_text += std::to_string(long_text.size()) + ",";
  long_text += "0]}";
  for (const std::string& text : {std::string(R"({"n":1})"), long_text}) {
    NewJob job = new_job();
    job.request.document = text;
    const std::string id = insert_id(*store, job);
    EXPECT_EQ(store->open_result(id), nullptr);
    const auto document = store->open_document(id);
    ASSERT_TRUE(document);
    EXPECT_EQ(document->size(), text.size());
    std::string read;
    std::size_t longest = 0;
    for (std::string piece; document->next(piece); piece.clear()) {
      longest = std::max(longest, piece.size());
      read += piece;
    }
    EXPECT_EQ(read, text);
    EXPECT_LE(longest, std::size_t{256} << 10);
    EXPECT_EQ(store->get(id, true)->request.document, text);
    EXPECT_EQ(claim(*store, 1)->request.document, text);
    api::PlannedJob planned = ramp_plan(1);
    planned.result["text"] = text;
    ASSERT_TRUE(store->succeed({id, 1}, planned, 2, nothing_seen, this->silent));
    EXPECT_EQ(store->result(id), planned.result.dump());
    const auto result = store->open_result(id);
    store->remove(id);
    std::string piece;
    if (text.size() > 1000) {
      EXPECT_THROW(result->next(piece), StoreError);
    }
    EXPECT_EQ(store->open_document(id), nullptr);
  }
}

TYPED_TEST(Looks, RemembersWhetherADocumentWasChecked) {
  auto& store = this->here;
  NewJob job = new_job();
  job.request.checked = false;
  insert_id(*store, job);
  insert_id(*store);
  const auto unchecked = claim(*store, 1), checked = claim(*store, 1);
  EXPECT_FALSE(unchecked->request.checked);
  EXPECT_TRUE(checked->request.checked);
  EXPECT_EQ(unchecked->request.document, checked->request.document);
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
  EXPECT_TRUE(store->succeed({good, 1}, ramp_plan(1), 2, nothing_seen, this->silent));
  EXPECT_TRUE(store->end({bad, 1}, {JobState::failed, "{}", 2, 0}));
  EXPECT_TRUE(store->requeue({back, 1}, 2, 0));
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
  EXPECT_TRUE(store->succeed({id, 1}, ramp_plan(10), 2, nothing_seen, this->silent));
  EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_FALSE(store->get(id));
  EXPECT_FALSE(store->result(id));
  EXPECT_FALSE(store->series(id));
  EXPECT_EQ(store->remove(id), Removed::unknown);
  EXPECT_TRUE(store->list({}).empty());
}

TYPED_TEST(Looks, RemovesOnlyWhileTheConditionHoldsInTheSameTransaction) {
  auto& store = this->here;
  const std::string id = insert_id(*store);
  const auto revision = store->get(id)->revision;
  const auto unchanged = [&](const api::Job& job) { return job.id == id && job.revision == revision; };
  claim(*store, 1);
  EXPECT_EQ(store->remove(id, unchanged), Removed::running) << "a running job is not asked about";
  EXPECT_TRUE(store->requeue({id, 1}, 2, revision + 5));
  EXPECT_EQ(store->remove(id, unchanged), Removed::refused);
  EXPECT_TRUE(store->get(id));
  EXPECT_EQ(store->remove("unknown", unchanged), Removed::unknown);
  const auto later = store->get(id)->revision;
  EXPECT_EQ(store->remove(id, [&](const api::Job& job) { return job.revision == later; }), Removed::yes);
  EXPECT_FALSE(store->get(id));
}

}  // namespace
}  // namespace bahnwerk::server
