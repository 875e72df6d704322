#include "server/store/sqlite/sqlite_store.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include "fixture.hpp"
#include "server/store/codec.hpp"
#include "server/store/open.hpp"
#include "server/store/sqlite/migrate.hpp"

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

TEST_F(StoreTest, ReadsDocumentsOfTheFirstVersion) {
  const std::string id = insert_id(*store);
  store.reset();
  {
    SqliteConnection connection((folder.path / "store.db").string(), true);
    const std::string spec = pack_text(R"({"n":2})");
    connection.query("UPDATE specs SET whole = 0, spec = ?").blob(spec).run();
  }
  open();
  EXPECT_EQ(store->get(id)->request.document, R"({"kind":"ramp","spec":{"n":2}})");
  EXPECT_EQ(claim(*store, 1)->request.document, R"({"kind":"ramp","spec":{"n":2}})");
}

TEST_F(StoreTest, PutsOrphansBackUntilTheyWereLostThreeTimes) {
  const std::string id = insert_id(*store);
  claim(*store, 1);
  const auto before = store->get(id)->revision;
  open();
  auto job = store->get(id);
  EXPECT_EQ(job->state, JobState::queued);
  EXPECT_EQ(job->attempt, 1);
  EXPECT_FALSE(job->started_at);
  EXPECT_GT(job->revision, before + 1000);
  EXPECT_EQ(claim(*store, 2)->attempt, 2);
  open();
  EXPECT_EQ(claim(*store, 3)->attempt, 3);
  open();
  job = store->get(id);
  EXPECT_EQ(job->state, JobState::failed);
  EXPECT_EQ(nlohmann::json::parse(*job->error)["type"], "/problems/worker-lost");
  EXPECT_FALSE(claim(*store, 3));
}

TEST_F(StoreTest, KeepsAPromisedCancellationOverARestart) {
  const std::string id = insert_id(*store);
  claim(*store, 1);
  EXPECT_EQ(store->cancel(id, 5)->state, JobState::running);
  open();
  EXPECT_EQ(store->get(id)->state, JobState::cancelled);
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
  std::thread checkpoint([&] { dynamic_cast<SqliteStore&>(*store).checkpoint(); });
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

/// A file as the version before leases and changes left it, with a job of every kind, one of them running.
void write_version_3(const std::filesystem::path& path) {
  SqliteConnection connection(path.string(), true);
  for (const Migration& migration : migrations().first(3)) connection.execute(migration.sql);
  connection.execute(R"sql(
    PRAGMA user_version = 3;
    INSERT INTO jobs (id, kind, priority, state, attempt, created_at, started_at, finished_at, error, cancel_requested,
                      revision)
      VALUES ('01-done', 'ramp', 0, 'succeeded', 1, 1, 2, 3, NULL, 0, 7),
             ('02-orphan', 'ramp', 1, 'running', 1, 1, 2, NULL, NULL, 0, 5),
             ('03-lost', 'ramp', 0, 'running', 2, 1, 2, NULL, NULL, 0, 5),
             ('04-unwanted', 'ramp', 0, 'running', 1, 1, 2, NULL, NULL, 1, 5),
             ('05-queued', 'ramp', 0, 'queued', 0, 1, NULL, NULL, NULL, 0, 1);
    INSERT INTO idempotency_keys VALUES ('k', 'hash', 5);)sql");
  const std::string document = pack_text(R"({"n":3})"), result = pack_text(R"({"kind":"ramp"})");
  std::vector<double> rows(20);
  Ramp(10).read(0, 10, rows.data());
  const std::string packed = Compressor().rows(rows.data(), 10, 2);
  for (std::int64_t seq = 1; seq <= 5; ++seq)
    (connection.query("INSERT INTO specs (seq, spec, whole) VALUES (?, ?, 1)") << seq).blob(document).run();
  connection
      .query(R"(INSERT INTO results VALUES (1, ?, '[{"name":"x","unit":"mm"},{"name":"y","unit":"mm"}]', 10, 4096,)"
             " 0.001)")
      .blob(result)
      .run();
  connection.query("INSERT INTO chunks VALUES (1, 0, 10, ?)").blob(packed).run();
}

TEST_F(StoreTest, TakesOverAFileOfTheVersionBefore) {
  store.reset();
  std::filesystem::remove_all(folder.path);
  std::filesystem::create_directory(folder.path);
  write_version_3(folder.path / "store.db");
  for (int start = 0; start < 2; ++start) {
    open();
    EXPECT_EQ(store->get("01-done")->state, JobState::succeeded);
    EXPECT_EQ(store->get("01-done")->revision, 7U);
    EXPECT_EQ(store->result("01-done"), R"({"kind":"ramp"})");
    std::vector<double> stored, expected(20);
    store->read_chunk(store->series("01-done").value(), 0, stored);
    Ramp(10).read(0, 10, expected.data());
    EXPECT_EQ(stored, expected);
    EXPECT_EQ(store->get("02-orphan")->state, JobState::queued);
    EXPECT_EQ(store->get("02-orphan")->attempt, 1);
    EXPECT_EQ(store->get("03-lost")->state, JobState::queued) << "it did not run alone";
    EXPECT_EQ(store->get("03-lost")->attempt, 2);
    EXPECT_EQ(store->get("04-unwanted")->state, JobState::cancelled);
    EXPECT_EQ(store->counts()[JobState::queued], 3U);
    std::vector<std::string> changed;
    for (const Changed& change : store->changes_since(0, 100).list) changed.push_back(change.id);
    EXPECT_EQ(changed, (std::vector<std::string>{"02-orphan", "03-lost", "04-unwanted"}));
  }
  EXPECT_EQ(insert(*store, new_job(0, "k", "hash")).id, "05-queued");
  EXPECT_EQ(claim(*store, 9)->id, "02-orphan");
  EXPECT_FALSE(claim(*store, 9)) << "it runs alone";
  EXPECT_TRUE(store->end({"02-orphan", 2}, {JobState::failed, "{}", 9, 0}));
  EXPECT_EQ(claim(*store, 9)->request.document, R"({"n":3})");
  EXPECT_EQ(store->remove("01-done"), Removed::yes);
  EXPECT_EQ(store->changes_since(0, 100).list.back().id, "01-done");
}

TEST_F(StoreTest, RefusesANewerSchema) {
  store.reset();
  {
    SqliteConnection connection((folder.path / "store.db").string(), true);
    connection.execute("PRAGMA user_version = 1000");
  }
  EXPECT_THROW(open(), StoreError);
}

TEST(OpenStore, SpeaksClearly) {
  const auto ignore = [](double, std::size_t) {};
  for (const char* url : {"postgresql:x/y", "sqlite:", "mysql:x", "", "sqlite:/proc/x/y.db", "sqlite:/"})
    EXPECT_THROW(open_store(url, ignore), StoreError) << url;
  TempFolder folder;
  EXPECT_NO_THROW(open_store("sqlite:" + (folder.path / "a" / "b" / "store.db").string(), ignore));
}

}  // namespace
}  // namespace bahnwerk::server
