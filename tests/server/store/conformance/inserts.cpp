#include <map>
#include <random>

#include "server/store/rules.hpp"
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
  const api::Job light = store->get(id, false).value(), accepted = accepted_job(job, id);
  EXPECT_EQ(api::job_resource(accepted), api::job_resource(light)) << "what is answered without a question";
  EXPECT_EQ(accepted.revision, light.revision);
  EXPECT_EQ(accepted.state_revision, light.state_revision);
  EXPECT_EQ(accepted.owner, light.owner);
}

TYPED_TEST(Inserts, KeepPostsThatAreStoredTogetherApart) {
  auto& store = this->here;
  std::vector<NewJob> jobs;
  for (std::size_t k = 0; k < 150; ++k) {
    NewJob job = new_job(static_cast<int>(k % 3), k % 5 == 0 ? "key " + std::to_string(k % 25) : "", "body");
    if (k % 2 == 0) job.request.name = "name " + std::to_string(k);
    if (k % 4 == 1) job.owner = k % 8 == 1 ? "acme" : "other";
    for (std::size_t t = 0; t < k % 4; ++t) job.request.tags.push_back("tag" + std::to_string(t));
    if (k % 7 == 0) job.request.deadline = 1'800'000'000'000 + static_cast<std::int64_t>(k);
    if (k % 6 == 0) job.request.time_budget = 0.5 * static_cast<double>(k);
    job.request.checked = k % 9 != 0;
    std::string text = "{\"n\":" + std::to_string(k) + ",\"text\":\"";
    std::mt19937 letters(static_cast<unsigned>(k));  // some documents are large when they are packed, too
    for (std::size_t c = 0; c < (k % 50 == 7 ? 300'000 : 1'000); ++c) text += static_cast<char>('0' + letters() % 75);
    std::erase(text, '\\');
    job.request.document = text + "\"}";
    jobs.push_back(std::move(job));
  }
  std::vector<std::promise<Inserted>> promises(jobs.size());
  for (std::size_t k = 0; k < jobs.size(); ++k)
    store->insert(jobs[k], [&promises, k](const Inserted& inserted, const std::exception_ptr& error) {
      error ? promises[k].set_exception(error) : promises[k].set_value(inserted);
    });
  std::map<std::string, std::string> keyed;  // owner and key, id
  std::size_t created = 0, tagged = 0;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const NewJob& job = jobs[k];
    const Inserted inserted = promises[k].get_future().get();
    if (!job.idempotency_key.empty()) {
      const std::string key = job.owner.value_or("") + "\n" + job.idempotency_key;
      EXPECT_EQ(keyed.emplace(key, inserted.id).first->second, inserted.id) << "a key is used once";
    }
    if (inserted.what != Inserted::What::created) continue;
    ++created;
    tagged += job.request.tags.size() == 3 ? 1 : 0;
    const api::Job found = this->other->get(inserted.id, true).value();
    EXPECT_EQ(found.request.document, job.request.document);
    EXPECT_EQ(api::job_resource(found), api::job_resource(accepted_job(job, inserted.id)));
    EXPECT_EQ(found.owner, job.owner);
  }
  EXPECT_EQ(created, 150 - 30 + keyed.size());
  EXPECT_EQ(store->counts()[JobState::queued], created);
  EXPECT_EQ(store->list({.tag = "tag2", .limit = 1000}).size(), tagged);
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
