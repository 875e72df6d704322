// Each call of the store to its files fails once: nothing acknowledged is lost, and the store goes on.
#include <gmock/gmock.h>

#include "failing_vfs.hpp"
#include "fixture.hpp"
#include "server/store/open.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {
namespace {

/// What clients were told by one pass of the script.
struct Told {
  std::vector<std::string> posted, finished, removed;
  int failures = 0;

  /// Runs `work`; returns whether it was acknowledged.
  template <class Work>
  bool acknowledged(Work&& work) {
    try {
      work();
      return true;
    } catch (const StoreError&) {
      ++failures;
      return false;
    }
  }
};

struct IoFaults : testing::Test {
  test::FailingVfs vfs;
  Progress silent;

  std::unique_ptr<SqliteStore> open(const TempFolder& folder) {
    SqliteOptions options;
    options.path = (folder.path / "store.db").string();
    return std::make_unique<SqliteStore>(std::move(options));
  }

  void post(Store& store, Told& told) {
    told.acknowledged([&] { told.posted.push_back(insert_id(store)); });
  }

  /// Posts, claims, finishes, deletes, cancels and empties the log; each step goes on where the one before failed.
  Told script(const TempFolder& folder) {
    Told told;
    std::unique_ptr<SqliteStore> store;
    if (!told.acknowledged([&] { store = open(folder); })) store = open(folder);
    for (int i = 0; i < 3; ++i) post(*store, told);
    for (int i = 0; i < 2; ++i) {
      std::optional<api::Job> job;
      if (!told.acknowledged([&] { job = claim(*store, 1); })) continue;  // a worker claims again
      const auto finish = [&] {
        if (store->succeed({job->id, job->token}, ramp_plan(9000), 2, nothing_seen, silent))
          told.finished.push_back(job->id);
      };
      if (job && !told.acknowledged(finish)) told.acknowledged(finish);
    }
    if (!told.finished.empty()) {
      const std::string id = told.finished.front();
      told.acknowledged([&] {
        if (store->remove(id) == Removed::yes) told.removed.push_back(id);
      });
    }
    post(*store, told);
    told.acknowledged([&] { store->cancel(told.posted.back(), 3); });
    told.acknowledged([&] { store->expire(1'700'000'000'000); });
    told.acknowledged([&] { EXPECT_FALSE(store->list({}).empty()); });
    told.acknowledged([&] { store->checkpoint(); });
    return told;
  }

  void verify(const TempFolder& folder, const Told& told, int call) {
    EXPECT_EQ(inspect("sqlite:" + (folder.path / "store.db").string()), std::vector<std::string>{}) << "call " << call;
    const std::unique_ptr<Store> store = open(folder);
    const auto contains = [](const std::vector<std::string>& ids, const std::string& id) {
      return std::find(ids.begin(), ids.end(), id) != ids.end();
    };
    for (const std::string& id : told.posted) {
      const bool removed = contains(told.removed, id);
      // The first one's removal may have failed towards the client only.
      if (!removed && !told.finished.empty() && id == told.finished.front()) continue;
      EXPECT_EQ(store->get(id).has_value(), !removed) << id << ", call " << call;
      if (!removed && contains(told.finished, id)) {
        EXPECT_EQ(store->get(id)->state, api::JobState::succeeded) << "call " << call;
        const auto series = store->series(id);
        ASSERT_TRUE(series) << "call " << call;
        std::vector<double> rows;
        store->read_chunk(*series, 8192, rows);
        EXPECT_EQ(rows.front(), 8192) << "call " << call;
      }
    }
    EXPECT_FALSE(insert_id(*store).empty());
  }
};

TEST_F(IoFaults, NothingAcknowledgedIsLostWhicheverCallFails) {
  int call = 1;
  for (;; ++call) {
    const TempFolder folder;
    test::FailingVfs::fail_at(call);
    const Told told = script(folder);
    const bool failed = test::FailingVfs::failed();
    test::FailingVfs::fail_at(0);
    EXPECT_LE(told.failures, 1) << "one fault is one failure, call " << call;
    verify(folder, told, call);
    if (!failed || HasFailure()) break;
  }
  EXPECT_GT(call, 100) << "calls were made";
  RecordProperty("calls", call);
}

}  // namespace
}  // namespace bahnwerk::server
