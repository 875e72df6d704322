#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct Lists : Conformance<S> {
  std::string insert_one(const std::string& name, const std::optional<std::string>& owner = std::nullopt,
                         std::vector<std::string> tags = {}) {
    NewJob job = new_job();
    if (!name.empty()) job.request.name = name;
    job.owner = owner;
    job.request.tags = std::move(tags);
    return insert_id(*this->here, job);
  }
  std::string names(const JobFilter& filter) {
    std::string names;
    for (const auto& job : this->here->list(filter)) names += job.request.name.value_or("-") + " ";
    return names;
  }
};
TYPED_TEST_SUITE(Lists, Stores, StoreNames);

TYPED_TEST(Lists, FindTagsOfAllAndOfOneOwner) {
  this->insert_one("a", {}, {"x", "y"});
  this->insert_one("b", "me", {"x"});
  const auto c = this->insert_one("c", "me", {"x", "z"});
  this->insert_one("d", "you", {"x"});
  EXPECT_EQ(this->names({.tag = "x"}), "d c b a ");
  EXPECT_EQ(this->names({.tag = "x", .owner = "me"}), "c b ");
  EXPECT_EQ(this->names({.tag = "y", .owner = "me"}), "");
  EXPECT_EQ(this->names({.tag = "x", .oldest_first = true, .limit = 2}), "a b ");
  EXPECT_EQ(this->names({.tag = "x", .before = c}), "b a ");
  EXPECT_EQ(this->here->get(c, false)->request.tags, (std::vector<std::string>{"x", "z"}));
  this->here->cancel(c, 5);
  EXPECT_EQ(this->names({.state = JobState::cancelled, .tag = "x"}), "c ");
  EXPECT_EQ(this->here->remove_all({.tag = "z"}), 1U);
  EXPECT_EQ(this->names({.tag = "x", .owner = "me"}), "b ");
}

TYPED_TEST(Lists, FindTextsByTheirBegin) {
  const auto id = this->insert_one("bracket 1");
  this->insert_one("bracket 12", "me");
  this->insert_one("Bracket 1");
  this->insert_one("a bracket");
  this->insert_one("caf\xC3\xA9", "you");
  EXPECT_EQ(this->names({.text = "bracket"}), "bracket 12 bracket 1 ");
  EXPECT_EQ(this->names({.text = "bracket", .oldest_first = true}), "bracket 1 bracket 12 ");
  EXPECT_EQ(this->names({.owner = "me", .text = "bracket"}), "bracket 12 ");
  EXPECT_EQ(this->names({.text = "caf\xC3"}), "caf\xC3\xA9 ");
  EXPECT_EQ(this->names({.text = "brac_et"}), "");
  EXPECT_EQ(this->names({.text = id}), "bracket 1 ");
  EXPECT_EQ(this->names({.text = id.substr(0, 8), .limit = 2}), "caf\xC3\xA9 a bracket ");
  NewJob job = new_job();
  job.request.reference = "bracket order";
  insert_id(*this->here, job);
  EXPECT_EQ(this->names({.text = "bracket", .limit = 2}), "- bracket 12 ");
}

TYPED_TEST(Lists, FindTextsWhereverTheJobsStand) {
  // More jobs than are looked at in their order, put in together: they share commits.
  std::vector<std::promise<void>> stored(4600);
  for (std::size_t k = 0; k < stored.size(); ++k) {
    NewJob job = new_job();
    job.max_queued = stored.size();
    job.request.name = (k < 2400 ? "part " : "other ") + std::to_string(k);
    if (k % 2 != 0) job.owner = "me";
    this->here->insert(job, [&stored, k](const Inserted&, const std::exception_ptr&) { stored[k].set_value(); });
  }
  for (auto& each : stored) each.get_future().wait();
  EXPECT_EQ(this->names({.text = "part 239", .limit = 2}), "part 2399 part 2398 ");
  EXPECT_EQ(this->names({.text = "part", .limit = 3}), "part 2399 part 2398 part 2397 ");
  EXPECT_EQ(this->names({.owner = "me", .text = "part ", .limit = 2}), "part 2399 part 2397 ");
  EXPECT_EQ(this->names({.text = "other", .limit = 2}), "other 4599 other 4598 ");
  EXPECT_EQ(this->names({.text = "other", .oldest_first = true, .limit = 2}), "other 2400 other 2401 ");
  EXPECT_EQ(this->names({.owner = "me", .text = "other", .oldest_first = true, .limit = 2}), "other 2401 other 2403 ");
  EXPECT_EQ(this->names({.state = JobState::queued, .kind = "ramp", .text = "part", .limit = 1}), "part 2399 ");
  EXPECT_EQ(this->names({.state = JobState::failed, .text = "part", .limit = 1}), "");
}

TYPED_TEST(Lists, OfAllOwnersAreInOrder) {
  std::string all;
  for (int k = 0; k < 20; ++k) {
    this->insert_one(std::to_string(k), k % 3 ? std::optional("owner " + std::to_string(k % 3)) : std::nullopt);
    all = std::to_string(k) + " " + all;
  }
  EXPECT_EQ(this->names({}), all);
  EXPECT_EQ(this->names({.state = JobState::queued}), all);
  EXPECT_EQ(this->names({.kind = "ramp"}), all);
  EXPECT_EQ(this->names({.kind = "ramp", .limit = 3}), all.substr(0, 9));
}

TYPED_TEST(Lists, CountsAreOfAllOrOfOneOwner) {
  this->insert_one("a");
  const auto b = this->insert_one("b", "me");
  this->insert_one("c", "me");
  this->here->cancel(b, 5);
  EXPECT_EQ(this->here->counts()[JobState::queued], 2U);
  EXPECT_EQ(this->here->counts("me")[JobState::queued], 1U);
  EXPECT_EQ(this->here->counts("me")[JobState::cancelled], 1U);
  EXPECT_EQ(this->here->counts("you")[JobState::queued], 0U);
  this->here->remove(b);
  EXPECT_EQ(this->here->counts("me")[JobState::cancelled], 0U);
}

TYPED_TEST(Lists, OfTheQueueAreInTheOrderOfClaims) {
  this->queue(2);
  const auto urgent = insert_id(*this->here, new_job(3));
  const auto queue = this->here->queue(9);
  ASSERT_EQ(queue.size(), 3U);
  EXPECT_EQ(queue[0], urgent);
  EXPECT_EQ(this->here->queue(2).size(), 2U);
  for (const auto& id : queue) EXPECT_EQ(claim(*this->here, 0)->id, id);
}

}  // namespace
}  // namespace bahnwerk::server
