#include "server/jobs/change_feed.hpp"

#include "../store/fixture.hpp"
#include "server/jobs/notifier.hpp"
#include "server/store/sqlite/change_log.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

/// What another process sees of the store: a connection of its own, no callbacks.
class SecondView final : public ChangeSource {
 public:
  explicit SecondView(const std::filesystem::path& path) : connection_(path.string(), false) {}
  bool shared() const override { return true; }
  void listen(std::function<void(const std::vector<Changed>&)>) override {}
  Changes changes_since(std::uint64_t sequence, std::size_t limit, const std::optional<std::string>& owner) override {
    if (away) throw StoreAway("away");
    return cut_off ? Changes{} : server::changes_since(connection_, sequence, limit, owner);
  }
  std::uint64_t last_change() override {
    if (away) throw StoreAway("away");
    return server::last_change(connection_);
  }
  void listen_to_others(std::function<void()> call) override { signal = std::move(call); }
  std::atomic<bool> cut_off{false}, away{false};
  std::function<void()> signal;

 private:
  SqliteConnection connection_;
};

struct ChangeFeedTest : StoreTest {
  Notifier notifier;
  ChangeFeed::Hooks hooks{[this](const std::vector<Changed>& changes) {
                            for (const Changed& change : changes) notifier.changed(change.id);
                          },
                          [this] { notifier.all_changed(); }};
  std::future<void> wait(const std::string& id) {
    const auto woken = std::make_shared<std::promise<void>>();
    notifier.wait(id, Notifier::Clock::now() + 1h, [woken] { woken->set_value(); });
    return woken->get_future();
  }
};

TEST_F(ChangeFeedTest, WakesAtOnceByLocalCommits) {
  const ChangeFeed feed(*store, hooks);
  const std::string id = insert_id(*store), other = insert_id(*store);
  for (const std::string step : {"claim", "cancel", "end", "remove"}) {
    const auto woken = wait(id), asleep = wait(other);
    if (step == "claim") claim(*store, 1);
    if (step == "cancel") store->cancel(id, 2);
    if (step == "end") store->end({id, 1}, {api::JobState::cancelled, "{}", 2, 0});
    if (step == "remove") store->remove(id);
    EXPECT_EQ(woken.wait_for(0s), std::future_status::ready) << step;
    EXPECT_EQ(asleep.wait_for(0s), std::future_status::timeout) << step;
  }
}

TEST_F(ChangeFeedTest, WakesByAskingWhereAnotherProcessCommits) {
  const std::string id = insert_id(*store), other = insert_id(*store);
  SecondView view(folder.path / "store.db");
  const ChangeFeed feed(view, hooks, 10ms);
  const auto asleep = wait(other);
  for (const std::string step : {"claim", "cancel", "end", "remove"}) {
    const auto woken = wait(id);
    EXPECT_EQ(woken.wait_for(50ms), std::future_status::timeout) << "before " << step;
    if (step == "claim") claim(*store, 1);
    if (step == "cancel") store->cancel(id, 2);
    if (step == "end") store->end({id, 1}, {api::JobState::cancelled, "{}", 2, 0});
    if (step == "remove") store->remove(id);
    EXPECT_EQ(woken.wait_for(10s), std::future_status::ready) << step;
  }
  EXPECT_EQ(asleep.wait_for(0s), std::future_status::timeout);
}

TEST_F(ChangeFeedTest, AsksAtOnceWhenOthersSignal) {
  const std::string id = insert_id(*store);
  SecondView view(folder.path / "store.db");
  const ChangeFeed feed(view, hooks, 24h);
  const auto woken = wait(id);
  EXPECT_EQ(woken.wait_for(50ms), std::future_status::timeout);
  store->cancel(id, 2);
  view.signal();
  EXPECT_EQ(woken.wait_for(30s), std::future_status::ready);
}

TEST_F(ChangeFeedTest, WakesAllWhenASourceIsBackThatWasAwayAtTheStart) {
  const std::string id = insert_id(*store);
  SecondView view(folder.path / "store.db");
  view.away = true;
  const ChangeFeed feed(view, hooks, 10ms);
  const auto woken = wait(id);
  EXPECT_EQ(woken.wait_for(50ms), std::future_status::timeout);
  view.away = false;
  EXPECT_EQ(woken.wait_for(30s), std::future_status::ready);
}

TEST_F(ChangeFeedTest, TellsWhenItKnowsAllChanges) {
  insert_id(*store);
  SecondView view(folder.path / "store.db");
  view.away = true;
  std::promise<void> known;
  std::atomic<int> told{0};
  hooks.caught_up = [&] {
    EXPECT_FALSE(view.away);
    if (++told == 2) known.set_value();
  };
  const ChangeFeed feed(view, hooks, 10ms);
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(told, 0) << "while it is away nothing is known";
  view.away = false;
  EXPECT_EQ(known.get_future().wait_for(30s), std::future_status::ready) << "again and again";
}

TEST_F(ChangeFeedTest, WakesAllWhenRemovalsAreForgotten) {
  const auto ids = insert_many(*store, 1100);
  SecondView view(folder.path / "store.db");
  view.cut_off = true;
  const ChangeFeed feed(view, hooks, 10ms);
  const auto first = wait(ids.front());
  const std::uint64_t before = store->last_change();
  for (const auto& id : ids) store->remove(id);
  for (const Changed& change : store->changes_since(before, 10'000).list)
    EXPECT_NE(change.id, ids.front()) << "else nothing was forgotten";
  EXPECT_EQ(first.wait_for(50ms), std::future_status::timeout);
  view.cut_off = false;
  EXPECT_EQ(first.wait_for(10s), std::future_status::ready);
}

}  // namespace
}  // namespace bahnwerk::server
