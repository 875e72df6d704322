#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct StoredCallbacks : Conformance<S> {
  std::string insert_with(const std::string& receiver, std::optional<std::int64_t> deadline = std::nullopt) {
    NewJob job = new_job();
    job.request.callback = api::Callback{receiver + "/done", "secret of " + receiver};
    job.request.deadline = deadline;
    job.callback_receiver = receiver;
    return insert_id(*this->here, job);
  }
  std::vector<std::string> due(const std::string& receiver) {
    std::vector<std::string> ids;
    for (const auto& each : this->here->due_callbacks(receiver, std::numeric_limits<std::int64_t>::max(), 1000))
      ids.push_back(each.job.id);
    return ids;
  }
  std::vector<std::string> due() { return due("r"); }
};
TYPED_TEST_SUITE(StoredCallbacks, Stores, StoreNames);

TYPED_TEST(StoredCallbacks, AreDueWithTheEndOfTheJobWhateverEndsIt) {
  using Ids = std::vector<std::string>;
  const auto without = insert_id(*this->here);
  const auto succeeded = this->insert_with("r");
  EXPECT_TRUE(this->due().empty());
  EXPECT_TRUE(this->here->callback_receivers().empty());
  claim(*this->here, 0);
  auto attempt = claim(*this->here, 0);
  EXPECT_EQ(attempt->id, succeeded);
  EXPECT_TRUE(this->due().empty());
  ASSERT_TRUE(this->here->succeed({succeeded, 1}, ramp_plan(10), 7, nothing_seen, this->silent));
  EXPECT_EQ(this->due(), Ids{succeeded});
  EXPECT_EQ(this->here->callback_receivers(), (std::vector<std::pair<std::string, std::int64_t>>{{"r", 7}}));

  const auto failed = this->insert_with("r");
  claim(*this->here, 0);
  ASSERT_TRUE(this->here->end({failed, 1}, {.error = "{}", .now = 8, .revision = 1}));
  const auto cancelled = this->insert_with("r"), in_bulk = this->insert_with("r");
  this->here->cancel(cancelled, 9);
  EXPECT_EQ(this->here->cancel_all({.kind = "ramp"}, 10), 2U);  // and asks the one without
  const auto late = this->insert_with("r", 11);
  EXPECT_EQ(this->here->expire(11).ids, Ids{late});
  const auto asked = this->insert_with("r");
  claim(*this->here, 0);
  this->here->cancel(asked, 12);
  ASSERT_TRUE(this->here->requeue({asked, 1}, 12, 1));
  EXPECT_EQ(this->due(), (Ids{succeeded, failed, cancelled, in_bulk, late, asked}));
  this->restart();
  EXPECT_EQ(this->due(), (Ids{succeeded, failed, cancelled, in_bulk, late, asked}));
  EXPECT_EQ(this->here->status().callbacks, 6U);
}

TYPED_TEST(StoredCallbacks, OfAJobWhoseWorkersWereLostAreDue) {
  const auto id = this->insert_with("r");
  for (int k = 0; k < max_losses_alone; ++k) {
    ASSERT_TRUE(claim(*this->here, 0, "worker", 500));
    this->restart();
    this->here->expire(std::numeric_limits<std::int64_t>::max() - 1);
  }
  EXPECT_EQ(this->here->get(id, false)->state, JobState::failed);
  EXPECT_EQ(this->due(), std::vector<std::string>{id});
}

TYPED_TEST(StoredCallbacks, KeepTheirAttemptsAndEndWithTheLastOne) {
  const auto id = this->insert_with("r");
  this->here->cancel(id, 5);
  const auto revision = this->here->get(id, false)->revision;
  const auto change = this->here->last_change();
  const auto callback = this->here->due_callbacks("r", 5, 9).at(0);
  EXPECT_EQ(callback.secret, "secret of r");
  EXPECT_FALSE(callback.job.request.callback->secret);
  this->here->called_back({.id = id, .now = 6, .error = "answered 500", .next_at = 20});
  EXPECT_TRUE(this->here->due_callbacks("r", 19, 9).empty());
  EXPECT_EQ(this->here->due_callbacks("r", 20, 9).size(), 1U);
  const auto job = this->here->get(id, false);
  EXPECT_EQ(job->delivery.attempts, 1);
  EXPECT_EQ(job->delivery.error, "answered 500");
  EXPECT_EQ(job->delivery.next_at, 20);
  EXPECT_GT(job->revision, revision);
  EXPECT_EQ(this->here->changes_since(change, 9).list.at(0).id, id);
  this->here->called_back({.id = id, .now = 21});
  EXPECT_TRUE(this->due().empty());
  const auto last = this->here->get(id, false)->delivery;
  EXPECT_EQ(last.attempts, 2);
  EXPECT_EQ(last.delivered_at, 21);
  EXPECT_FALSE(last.error || last.next_at);
  this->here->called_back({.id = id, .now = 22, .error = "too late"});
  EXPECT_EQ(this->here->get(id, false)->delivery.attempts, 2);
}

TYPED_TEST(StoredCallbacks, OfOneReceiverAreFoundWithoutThoseOfOthers) {
  for (const char* receiver : {"b", "a", "b", "c"}) this->here->cancel(this->insert_with(receiver), 5);
  std::string names;
  for (const auto& [name, due] : this->here->callback_receivers()) names += name;
  EXPECT_EQ(names, "abc");
  EXPECT_EQ(this->due("b").size(), 2U);
  EXPECT_EQ(this->here->due_callbacks("b", 5, 1).size(), 1U);
}

TYPED_TEST(StoredCallbacks, AreWithdrawnWithTheJob) {
  const auto id = this->insert_with("r");
  this->here->cancel(id, 5);
  EXPECT_EQ(this->here->remove(id), Removed::yes);
  EXPECT_TRUE(this->due().empty());
  EXPECT_TRUE(this->here->callback_receivers().empty());
}

TYPED_TEST(StoredCallbacks, SecretsAreReadWithTheDocumentAlone) {
  const auto id = this->insert_with("r");
  EXPECT_FALSE(this->here->get(id, false)->request.callback->secret);
  EXPECT_EQ(this->here->get(id)->request.callback->secret, "secret of r");
  EXPECT_FALSE(this->here->list({}).at(0).request.callback->secret);
}

}  // namespace
}  // namespace bahnwerk::server
