#include <thread>

#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

template <class S>
struct ChangesSince : Conformance<S> {};
TYPED_TEST_SUITE(ChangesSince, Stores, StoreNames);

using State = std::optional<JobState>;

/// Asked of the other process: what changed since, and `sequence` moves there.
std::vector<std::pair<std::string, State>> news(Store& store, std::uint64_t& sequence, std::size_t limit = 1000) {
  std::vector<std::pair<std::string, State>> list;
  for (const Changed& changed : store.changes_since(sequence, limit).list) {
    EXPECT_GT(changed.sequence, sequence);
    sequence = changed.sequence;
    list.emplace_back(changed.id, changed.state);
    if (changed.state) {
      EXPECT_GT(changed.revision, 0U);
    }
  }
  return list;
}

using List = std::vector<std::pair<std::string, State>>;

TYPED_TEST(ChangesSince, ShowEveryKindOfChangeOnce) {
  auto& store = this->here;
  std::uint64_t sequence = this->other->last_change();
  const auto expect = [&](const List& expected) {
    EXPECT_EQ(news(*this->other, sequence), expected);
    EXPECT_EQ(sequence, store->last_change());
    EXPECT_TRUE(news(*store, sequence).empty());
  };
  expect({});
  NewJob with_deadline = new_job(-1);
  with_deadline.request.deadline = 5000;
  const std::string a = insert_id(*store), b = insert_id(*store), c = insert_id(*store, with_deadline);
  expect({{a, JobState::queued}, {b, JobState::queued}, {c, JobState::queued}});
  insert(*store, new_job(0, "key", "x"));
  const std::string keyed = store->list({}).front().id;
  expect({{keyed, JobState::queued}});
  insert(*store, new_job(0, "key", "x"));
  insert(*store, new_job(0, "key", "y"));
  expect({});  // a replay and a conflict change nothing
  claim(*store, 1, "w", 1000);
  expect({{a, JobState::running}});
  store->heartbeat({"w", 2, 1500}, {{{a, 1}, 0.5, "half", "", 9}});
  expect({});  // progress is no change of a job's state
  store->cancel(a, 2);
  const auto cancelled = this->other->changes_since(sequence, 10);
  ASSERT_EQ(cancelled.list.size(), 1U);
  EXPECT_TRUE(cancelled.list.front().cancel_requested);
  expect({{a, JobState::running}});
  store->cancel(a, 3);
  store->cancel("none", 3);
  store->heartbeat({"w", 3, 1500}, {{{a, 1}}});
  EXPECT_EQ(store->remove(a), Removed::running);
  EXPECT_FALSE(store->end({a, 2}, {JobState::failed, "{}", 4, 0}));
  expect({});
  EXPECT_TRUE(store->end({a, 1}, {JobState::cancelled, "{}", 4, 0}));
  expect({{a, JobState::cancelled}});
  claim(*store, 5);
  store->requeue({b, 1}, 6, 0);
  expect({{b, JobState::queued}});  // twice, but its last state is what counts
  claim(*store, 7);
  EXPECT_TRUE(store->succeed({b, 2}, ramp_plan(5000), 8, nothing_seen, this->silent));
  expect({{b, JobState::succeeded}});
  EXPECT_EQ(store->remove(b), Removed::yes);
  expect({{b, std::nullopt}});
  store->expire(5000);
  expect({{c, JobState::failed}});
  claim(*store, 6000, "w", 10);
  store->expire(6010);
  expect({{keyed, JobState::queued}});
  store->cancel(keyed, 6020);
  expect({{keyed, JobState::cancelled}});
  this->restart();
  EXPECT_EQ(this->here->last_change(), sequence) << "numbers are not given twice";
  const std::string late = insert_id(*this->here);
  EXPECT_EQ(news(*this->other, sequence), (List{{late, JobState::queued}}));
}

TYPED_TEST(ChangesSince, ComeInPages) {
  auto& store = this->here;
  const std::uint64_t start = store->last_change();
  this->queue(25);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(store->remove(store->list({}).front().id), Removed::yes);
  std::uint64_t all = start, paged = start;
  const auto expected = news(*this->other, all);
  EXPECT_EQ(expected.size(), 25U) << "20 queued, 5 removed";
  List list;
  for (;;) {
    const auto page = news(*this->other, paged, 4);
    EXPECT_LE(page.size(), 4U);
    if (page.empty()) break;
    list.insert(list.end(), page.begin(), page.end());
  }
  EXPECT_EQ(list, expected);
}

TYPED_TEST(ChangesSince, StayFewAndSayWhenRemovalsAreForgotten) {
  auto& store = this->here;
  const std::uint64_t start = store->last_change();
  constexpr int removals = 1500;
  const auto ids = insert_many(*store, removals);
  const std::uint64_t full = store->last_change();
  EXPECT_FALSE(store->changes_since(start, 10).gap);
  for (const auto& id : ids) store->remove(id);
  const auto changes = store->changes_since(full, 10'000);
  EXPECT_TRUE(changes.gap);
  EXPECT_LT(changes.list.size(), removals);
  EXPECT_GT(changes.list.size(), 500U);
  EXPECT_EQ(changes.list.back().id, ids.back());
  EXPECT_FALSE(store->changes_since(store->last_change() - 100, 10'000).gap);
  EXPECT_EQ(store->changes_since(store->last_change() - 100, 10'000).list.size(), 100U);
}

TYPED_TEST(ChangesSince, CallBackAtOnceOfTheirOwnCommits) {
  auto& store = this->here;
  std::mutex mutex;
  List heard;
  bool cancelled = false;
  const auto take = [&] {
    const std::lock_guard lock(mutex);
    return std::exchange(heard, {});
  };
  store->listen([&](const std::vector<Changed>& changes) {
    const std::lock_guard lock(mutex);
    for (const Changed& changed : changes) {
      heard.emplace_back(changed.id, changed.state);
      cancelled = cancelled || changed.cancel_requested;
    }
  });
  const std::string id = insert_id(*store);
  EXPECT_EQ(take(), (List{{id, JobState::queued}})) << "before the call returns";
  claim(*store, 1);
  EXPECT_EQ(take(), (List{{id, JobState::running}}));
  EXPECT_FALSE(store->end({id, 2}, {JobState::failed, "{}", 2, 0}));
  EXPECT_TRUE(take().empty());
  store->cancel(id, 2);
  EXPECT_EQ(take(), (List{{id, JobState::running}}));
  EXPECT_TRUE(cancelled);
  EXPECT_TRUE(store->end({id, 1}, {JobState::cancelled, "{}", 3, 0}));
  EXPECT_EQ(take(), (List{{id, JobState::cancelled}}));
  store->remove(id);
  EXPECT_EQ(take(), (List{{id, std::nullopt}}));
  store->listen(nullptr);
  insert_id(*store);
  EXPECT_TRUE(take().empty());
}

/// A reader that follows while others write misses nothing and sees no number twice.
TYPED_TEST(ChangesSince, MissNothingWhileOthersWrite) {
  auto& store = this->here;
  constexpr int threads = 4, each = 60;
  std::uint64_t sequence = store->last_change();
  std::atomic<int> writing{threads};
  std::vector<std::thread> list;
  for (int t = 0; t < threads; ++t)
    list.emplace_back([&, t] {
      Store& mine = t % 2 ? *this->other : *store;
      for (int i = 0; i < each; ++i) {
        const std::string id = insert_id(mine);
        if (i % 2) mine.cancel(id, 5);
      }
      --writing;
    });
  std::map<std::string, State> seen;
  for (bool last = false; !last;) {
    last = writing == 0;
    for (const auto& [id, state] : news(*this->other, sequence, 7)) {
      seen[id] = state;
      last = false;
    }
  }
  for (auto& thread : list) thread.join();
  ASSERT_EQ(seen.size(), static_cast<std::size_t>(threads * each));
  for (const auto& [id, state] : seen) EXPECT_EQ(store->get(id)->state, state);
}

}  // namespace
}  // namespace bahnwerk::server
