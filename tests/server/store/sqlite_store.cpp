#include "server/store/sqlite/sqlite_store.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include "fixture.hpp"
#include "server/store/codec.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

/// Text that does not compress.
std::string noise(unsigned size) {
  std::string text;
  for (unsigned i = 0, x = 1; i < size; ++i)
    text += static_cast<char>('a' + ((x = x * 1664525U + 1013904223U) >> 24) % 26);
  return text;
}

TEST_F(StoreTest, KeepsEverythingOfAJob) {
  NewJob job = new_job(7);
  job.request.name = "name \"quoted\"";
  job.request.reference = "WO-1";
  job.request.callback = "http://x/y";
  job.request.deadline = 1'800'000'000'000;
  job.request.time_budget = 2.5;
  job.request.document = "{\"text\":\"" + std::string(100'000, 'a') + "\"}";
  const std::string id = insert_id(*store, job);
  for (int round = 0; round < 2; ++round, open()) {
    const auto kept = store->get(id);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->request.name, job.request.name);
    EXPECT_EQ(kept->request.reference, job.request.reference);
    EXPECT_EQ(kept->request.callback, job.request.callback);
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

TEST_F(StoreTest, ReadsDocumentsOfTheFirstVersion) {
  const std::string id = insert_id(*store);
  store.reset();
  {
    Connection connection((folder.path / "store.db").string(), true);
    const std::string spec = pack_text(R"({"n":2})");
    connection.query("UPDATE specs SET whole = 0, spec = ?").blob(spec).run();
  }
  open();
  EXPECT_EQ(store->get(id)->request.document, R"({"kind":"ramp","spec":{"n":2}})");
  EXPECT_EQ(store->claim(1)->request.document, R"({"kind":"ramp","spec":{"n":2}})");
}

TEST_F(StoreTest, EndsQueuedJobsWhoseDeadlinePassed) {
  EXPECT_FALSE(store->expire(1000).next);
  const auto with_deadline = [&](std::optional<std::int64_t> deadline) {
    NewJob job = new_job();
    job.request.deadline = deadline;
    return insert_id(*store, job);
  };
  const std::string running = with_deadline(500);
  store->claim(1);
  const std::string never = with_deadline(std::nullopt), late = with_deadline(3000), due = with_deadline(1000);
  EXPECT_EQ(store->expire(999).next, 1000);
  const auto revision = store->get(due)->revision;
  const Expired expired = store->expire(1000);
  EXPECT_EQ(expired.ids, std::vector<std::string>{due});
  EXPECT_EQ(expired.next, 3000);
  const auto job = store->get(due);
  EXPECT_EQ(job->state, JobState::failed);
  EXPECT_EQ(job->finished_at, 1000);
  EXPECT_EQ(job->attempt, 0);
  EXPECT_GT(job->revision, revision);
  EXPECT_NE(job->error->find("/problems/deadline-exceeded"), std::string::npos);
  EXPECT_NE(job->error->find("/v1/jobs/" + due), std::string::npos);
  for (const auto& id : {never, late}) EXPECT_EQ(store->get(id)->state, JobState::queued);
  EXPECT_EQ(store->get(running)->state, JobState::running) << "its planner holds the deadline";
  EXPECT_EQ(store->counts()[JobState::failed], 1U);
  for (int i = 0; i < 600; ++i) with_deadline(2000 + i % 2);
  std::size_t ended = 0;
  for (Expired part = store->expire(2001); !part.ids.empty(); part = store->expire(2001)) ended += part.ids.size();
  EXPECT_EQ(ended, 600U);
}

TEST_F(StoreTest, ClaimsByPriorityThenInOrder) {
  const std::string first = insert_id(*store, new_job(0)), second = insert_id(*store, new_job(0)),
                    urgent = insert_id(*store, new_job(5)), late = insert_id(*store, new_job(-1));
  for (const auto& expected : {urgent, first, second, late}) {
    const auto job = store->claim(1);
    ASSERT_TRUE(job);
    EXPECT_EQ(job->id, expected);
    EXPECT_EQ(job->state, JobState::running);
    EXPECT_EQ(job->attempt, 1);
    EXPECT_EQ(job->request.document, R"({"n":1})");
  }
  EXPECT_FALSE(store->claim(1));
}

TEST_F(StoreTest, TakesAResultOnceAndFromTheRightAttempt) {
  const std::string id = insert_id(*store);
  EXPECT_FALSE(store->succeed(id, 1, ramp_plan(10), 2, 0, silent)) << "not running yet";
  store->claim(1);
  EXPECT_FALSE(store->succeed(id, 2, ramp_plan(10), 2, 0, silent)) << "another attempt";
  EXPECT_FALSE(store->result(id));
  EXPECT_TRUE(store->succeed(id, 1, ramp_plan(10), 2, 40, silent));
  EXPECT_FALSE(store->succeed(id, 1, ramp_plan(99), 3, 0, silent)) << "twice";
  EXPECT_FALSE(store->end(id, 1, {JobState::failed, "{}", 3, 0}));
  EXPECT_FALSE(store->requeue(id, 1, 3, 0));
  const auto job = store->get(id);
  EXPECT_EQ(job->state, JobState::succeeded);
  EXPECT_EQ(job->finished_at, 2);
  EXPECT_EQ(job->revision, 41U);
  EXPECT_EQ(store->result(id), R"({"kind":"ramp","rows":10})");
  EXPECT_EQ(store->series(id)->count, 10U);
}

TEST_F(StoreTest, GivesBackEveryRowAcrossChunks) {
  constexpr std::size_t count = 3 * 4096 + 17;
  const std::string id = insert_id(*store);
  store->claim(1);
  ASSERT_TRUE(store->succeed(id, 1, ramp_plan(count), 2, 0, silent));
  const auto series = store->series(id);
  ASSERT_TRUE(series);
  EXPECT_EQ(series->count, count);
  ASSERT_EQ(series->columns.size(), 2U);
  EXPECT_EQ(series->columns[1].name, "y");
  std::vector<double> all, chunk;
  for (std::size_t first = 0; first < count; first += series->chunk_rows) {
    store->read_chunk(*series, first, chunk);
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  std::vector<double> expected(count * 2);
  Ramp(count).read(0, count, expected.data());
  EXPECT_EQ(all, expected);
  EXPECT_EQ(store->remove(id), Removed::yes);
  EXPECT_THROW(store->read_chunk(*series, 0, chunk), StoreError);
  EXPECT_FALSE(store->result(id));
}

TEST_F(StoreTest, KnowsPlansWithoutSetpoints) {
  const std::string id = insert_id(*store);
  store->claim(1);
  ASSERT_TRUE(store->succeed(id, 1, ramp_plan(0), 2, 0, silent));
  EXPECT_TRUE(store->result(id));
  EXPECT_FALSE(store->series(id));
}

TEST_F(StoreTest, PutsOrphansBackUntilTheirAttemptsAreUsedUp) {
  const std::string id = insert_id(*store);
  store->claim(1);
  const auto before = store->get(id)->revision;
  open();
  auto job = store->get(id);
  EXPECT_EQ(job->state, JobState::queued);
  EXPECT_EQ(job->attempt, 1);
  EXPECT_FALSE(job->started_at);
  EXPECT_GT(job->revision, before + 1000);
  EXPECT_EQ(store->claim(2)->attempt, 2);
  open();
  job = store->get(id);
  EXPECT_EQ(job->state, JobState::failed);
  EXPECT_EQ(nlohmann::json::parse(*job->error)["type"], "/problems/worker-lost");
  EXPECT_FALSE(store->claim(3));
}

TEST_F(StoreTest, RequeuesWithoutCountingTheAttempt) {
  const std::string id = insert_id(*store);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(store->claim(1)->attempt, 1);
    EXPECT_TRUE(store->requeue(id, 1, 2, 0));
  }
  store->claim(1);
  store->cancel(id, 2);
  EXPECT_TRUE(store->requeue(id, 1, 2, 0));
  EXPECT_EQ(store->get(id)->state, JobState::cancelled) << "the wish to cancel is not forgotten";
}

TEST_F(StoreTest, Cancels) {
  const std::string queued = insert_id(*store), running = insert_id(*store, new_job(1));
  store->claim(1);
  EXPECT_EQ(store->cancel(queued, 5)->state, JobState::cancelled);
  EXPECT_EQ(store->get(queued)->finished_at, 5);
  const auto revision = store->get(queued)->revision;
  EXPECT_EQ(store->cancel(queued, 6)->revision, revision) << "again changes nothing";
  EXPECT_EQ(store->cancel(running, 5)->state, JobState::running);
  EXPECT_TRUE(store->cancel_requested(running));
  EXPECT_FALSE(store->cancel_requested(queued));
  EXPECT_FALSE(store->cancel("none", 5));
  open();
  EXPECT_EQ(store->get(running)->state, JobState::cancelled);
}

TEST_F(StoreTest, HonoursKeys) {
  const Inserted first = insert(*store, new_job(0, "k", "hash"));
  EXPECT_EQ(first.what, Inserted::What::created);
  const Inserted again = insert(*store, new_job(0, "k", "hash"));
  EXPECT_EQ(again.what, Inserted::What::replayed);
  EXPECT_EQ(again.id, first.id);
  EXPECT_EQ(insert(*store, new_job(0, "k", "other")).what, Inserted::What::conflict);
  EXPECT_EQ(store->remove(first.id), Removed::yes);
  EXPECT_EQ(insert(*store, new_job(0, "k", "other")).what, Inserted::What::created);
}

TEST_F(StoreTest, RefusesWhenTooManyWait) {
  NewJob job = new_job();
  job.max_queued = 3;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(insert(*store, job).what, Inserted::What::created);
  EXPECT_EQ(insert(*store, job).what, Inserted::What::full);
  store->claim(1);
  EXPECT_EQ(insert(*store, job).what, Inserted::What::created);
}

TEST_F(StoreTest, PagesFromTheNewest) {
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

TEST_F(StoreTest, SharesCommitsAmongManyPosts) {
  std::atomic<std::size_t> commits{0}, writes{0};
  SqliteOptions options;
  options.observer = [&](double, std::size_t count) {
    ++commits;
    writes += count;
  };
  open(options);
  constexpr std::size_t jobs = 400;
  std::atomic<std::size_t> done{0};
  std::promise<void> all;
  for (std::size_t i = 0; i < jobs; ++i)
    store->insert(new_job(), [&](const Inserted& inserted, const std::exception_ptr& error) {
      EXPECT_FALSE(error);
      EXPECT_EQ(inserted.what, Inserted::What::created);
      if (++done == jobs) all.set_value();
    });
  all.get_future().wait();
  EXPECT_GE(writes, jobs);
  EXPECT_LT(commits, jobs / 2);
}

TEST_F(StoreTest, SurvivesAFullDisk) {
  SqliteOptions options;
  options.max_pages = 120;
  open(options);
  NewJob big = new_job();
  big.request.document = "\"" + noise(20'000) + "\"";
  std::vector<std::string> accepted;
  bool full = false;
  for (int i = 0; i < 200 && !full; ++i) {
    try {
      accepted.push_back(insert_id(*store, big));
    } catch (const StoreError& error) {
      EXPECT_TRUE(error.full);
      full = true;
    }
  }
  EXPECT_TRUE(full);
  ASSERT_GT(accepted.size(), 3U);
  EXPECT_THROW(store->ping(), StoreError) << "nobody should send more";
  EXPECT_EQ(store->counts()[JobState::queued], accepted.size());
  for (const auto& id : accepted) EXPECT_EQ(store->get(id)->request.document, big.request.document);
  EXPECT_EQ(store->remove(accepted.front()), Removed::yes);
  EXPECT_NO_THROW(insert_id(*store, big)) << "space was freed";
  EXPECT_NO_THROW(store->ping());
}

/// A group of works that fails is tried again one by one: what a work before a checkpoint wrote must not be kept twice.
TEST_F(StoreTest, CheckpointsBetweenTransactionsNotInsideOne) {
  SqliteOptions options;
  options.max_pages = 120;
  open(options);
  std::promise<void> entered, go;
  store->insert(new_job(), [&](const Inserted&, const std::exception_ptr&) {
    entered.set_value();  // on the writer's thread: what follows waits, and then shares a group
    go.get_future().wait();
  });
  entered.get_future().wait();
  std::promise<void> small, large;
  store->insert(new_job(), [&](const Inserted&, const std::exception_ptr& error) {
    EXPECT_FALSE(error);
    small.set_value();
  });
  std::thread checkpoint([&] { store->checkpoint(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // it waits for the writer now
  NewJob job = new_job();
  job.request.document = noise(2'000'000);
  store->insert(job, [&](const Inserted&, const std::exception_ptr& error) {
    EXPECT_TRUE(error) << "larger than the file may be";
    large.set_value();
  });
  go.set_value();
  large.get_future().wait();
  small.get_future().wait();
  checkpoint.join();
  EXPECT_EQ(store->counts()[JobState::queued], 2U);
  EXPECT_EQ(store->list({}).size(), 2U);
}

TEST_F(StoreTest, IsOwnedByOneProcess) {
  try {
    SqliteStore second({.path = (folder.path / "store.db").string()});
    FAIL() << "a second owner";
  } catch (const StoreError& error) {
    EXPECT_NE(std::string(error.what()).find("another bahnwerk"), std::string::npos);
  }
}

TEST_F(StoreTest, RefusesANewerSchema) {
  store.reset();
  {
    Connection connection((folder.path / "store.db").string(), true);
    connection.execute("PRAGMA user_version = 1000");
  }
  EXPECT_THROW(open(), StoreError);
}

TEST(OpenStore, SpeaksClearly) {
  const auto ignore = [](double, std::size_t) {};
  for (const char* url : {"postgresql://x/y", "sqlite:", "mysql:x", "", "sqlite:/proc/x/y.db", "sqlite:/"})
    EXPECT_THROW(open_store(url, ignore), StoreError) << url;
  TempFolder folder;
  EXPECT_NO_THROW(open_store("sqlite:" + (folder.path / "a" / "b" / "store.db").string(), ignore));
}

}  // namespace
}  // namespace bahnwerk::server
