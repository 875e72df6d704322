/// Jobs moved from one store into another: from an SQLite file into each form of store, and back into a file.
#include "server/runtime/clock.hpp"
#include "server/store/codec.hpp"
#include "server/store/open.hpp"
#include "server/store/open/move_store.hpp"
#include "server/store/postgres/moving.hpp"
#include "server/store/sqlite/connection.hpp"
#include "server/store/sqlite/moving.hpp"
#include "server/store/store_url.hpp"
#include "stores.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

std::unique_ptr<MoveReader> source_of(const std::string& url) {
  return names_postgres(url) ? postgres::move_source(url) : sqlite::move_source(url);
}
std::unique_ptr<MoveTarget> target_of(const std::string& url) {
  return names_postgres(url) ? postgres::move_target(url) : sqlite::move_target(url);
}

void ignore(const MoveProgress&) {}

MoveReport move_all(const std::string& from, const std::string& to,
                    const std::function<void(const MoveProgress&)>& tell = ignore, const MoveBatch& batch = {}) {
  const auto source = source_of(from);
  const auto target = target_of(to);
  return move_jobs(*source, without_secrets(from), *target, tell, batch);
}

std::string all_of(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& each : list) text += each + "\n";
  return text;
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const StoreError& error) {
    return error.what();
  }
  return "";
}

struct IntoSqlite {
  static constexpr const char* name = "Sqlite";
  static bool missing() { return false; }
  std::string url() const { return "sqlite:" + (folder.path / "target.db").string(); }
  std::unique_ptr<Store> open() const {
    return open_store(url(), [](double, std::size_t) {});
  }
  TempFolder folder;
};
struct IntoPostgres {
  static constexpr const char* name = "Postgres";
  static bool missing() { return PostgresServer::missing(); }
  ~IntoPostgres() { PostgresServer::one().drop_database(database); }
  std::string url() const { return database; }
  std::unique_ptr<Store> open() const {
    return std::make_unique<PostgresStore>(
        PostgresOptions{.url = database, .patience = PostgresServer::patient(), .times_of_callers = true});
  }
  const std::string database = PostgresServer::one().make_database();
};

template <class Target>
struct Moves : testing::Test {
  void SetUp() override {
    if (Target::missing()) GTEST_SKIP() << "its server is not installed";
    target.emplace();
  }

  std::string path(const std::string& file) const { return (folder.path / file).string(); }
  std::string url(const std::string& file) const { return "sqlite:" + path(file); }
  void change(const std::string& sql, const std::string& file = "source.db") const {
    SqliteConnection(path(file), true).execute(sql.c_str());
  }

  /// Fills source.db with jobs in every state, and ends with it as a process that is killed.
  void fill() {
    SqliteStore store(SqliteOptions{.path = path("source.db"), .planned_by = "1.2.3"});
    NewJob job = new_job(3, "key of nobody", "hash");
    job.request.name = "bracket \u00e9";
    job.request.reference = "WO-1";
    job.request.tags = {"a", "b\"c"};
    job.request.deadline = job.now + 1'000'000;
    job.request.time_budget = 0.1;
    ids["queued"] = insert_id(store, job);

    job = new_job(9, "key of acme", "other hash");
    job.owner = "acme";
    job.request.tags = {"a"};
    ids["succeeded"] = insert_id(store, job);
    claim(store, job.now + 10);
    EXPECT_TRUE(store.succeed({ids["succeeded"], 1}, ramp_plan(40 * 4096 + 17), job.now + 2000, nothing_seen, silent));

    ids["plain"] = insert_id(store, new_job(8));
    claim(store, job.now + 10);
    EXPECT_TRUE(store.succeed({ids["plain"], 1}, ramp_plan(0), job.now + 20, nothing_seen, silent));

    job = new_job(8);
    job.request.checked = false;
    job.request.callback = api::Callback{"http://r/done", "secret"};
    job.callback_receiver = "http://r";
    ids["failed"] = insert_id(store, job);
    claim(store, job.now + 10);
    EXPECT_TRUE(store.end({ids["failed"], 1},
                          {.error = R"({"type":"x"})", .now = job.now + 30, .revision = 5, .result = R"({"n":2})"}));
    store.called_back({ids["failed"], job.now + 31, "503", job.now + 99});

    job.request.checked = true;
    ids["cancelled"] = insert_id(store, job);
    store.cancel(ids["cancelled"], job.now + 40);
    store.called_back({ids["cancelled"], job.now + 41, {}, {}});

    job.owner = "acme";
    ids["asked"] = insert_id(store, job);
    claim(store, job.now + 10);
    store.cancel(ids["asked"], job.now + 50);
    ids["running"] = insert_id(store, new_job(8));
    claim(store, job.now + 10);
    EXPECT_EQ(store.heartbeat({"worker", job.now + 10}, {{{ids["running"], 1}, 0.5, "planning", "half", 77}}).size(),
              1U);

    NewJob odd = new_job();
    odd.request.name = std::string("zero \0 there", 12);
    ids["odd"] = insert_id(store, odd);
    const std::string gone = insert_id(store);
    EXPECT_EQ(store.remove(gone), Removed::yes);
    ids["old"] = insert_id(store);
    for (int k = 0; k < 29; ++k) insert_id(store);
    cursor = store.last_change();
  }
  void finish_filling() {
    Key key;
    key.id = "k1", key.name = "acme", key.scopes.submit = true, key.hash = "h", key.created_at = 5, key.max_queued = 9;
    add_key(url("source.db"), key);
    key.id = "k2";
    add_key(url("source.db"), key);
    remove_keys(url("source.db"), "k2");
    // A row of version 0.1 has the spec alone.
    SqliteConnection connection(path("source.db"), true);
    const std::string spec = pack_text(R"({"n":0})");
    Query row =
        connection.query("UPDATE specs SET whole = 0, spec = ? WHERE seq = (SELECT seq FROM jobs WHERE id = ?)");
    row.blob(spec);
    (row << ids["old"]).run();
  }

  /// Returns what a file has of all jobs but those that are changed by the move, without what is the file's own.
  std::string dump(const std::string& file) {
    SqliteConnection connection(path(file), true);
    const std::string others =
        "WHERE id NOT IN ('" + ids["asked"] + "', '" + ids["running"] + "', '" + ids["odd"] + "')";
    std::string text;
    const auto add = [&](const std::string& columns, const std::string& from) {
      std::string sql = "SELECT ";
      std::string_view rest = columns;
      while (!rest.empty()) {
        const std::size_t comma = std::min(rest.find(','), rest.size());
        sql.append(sql.size() > 7 ? " || ' ' || " : "").append("quote(").append(rest.substr(0, comma)).append(")");
        rest.remove_prefix(std::min(comma + 1, rest.size()));
      }
      Query rows = connection.query(sql + " FROM " + from);
      while (rows.step()) text += rows.text(0) + "\n";
    };
    add("id,kind,name,reference,callback,priority,deadline,time_budget,state,fraction,stage,message,attempt,"
        "cancel_requested,created_at,started_at,finished_at,error,revision,suspect,losses,owner,turn,callback_secret,"
        "callback_receiver,callback_attempts,callback_due,callback_delivered,callback_error,tags,token,planned_by",
        "jobs " + others + " ORDER BY id");
    add("id,spec,whole", "specs JOIN jobs USING (seq) " + others + " AND id <> '" + ids["old"] + "' ORDER BY id");
    add("id,document,columns,row_count,chunk_rows,cycle_time,views",
        "results JOIN jobs USING (seq) " + others + " ORDER BY id");
    add("id,first_row,row_count,data", "chunks JOIN jobs USING (seq) " + others + " ORDER BY id, first_row");
    add("id,name,part,data",
        "(SELECT id, views.name, part, data FROM views JOIN jobs USING (seq)) " + others + " ORDER BY id, name, part");
    add("id,key,body_hash", "idempotency_keys JOIN jobs USING (seq) " + others + " ORDER BY id, key");
    add("owner,tag,id", "job_tags ORDER BY id, owner, tag");
    add("id,name,scopes,hash,max_queued,max_planning_ms,created_at,removed_at", "keys ORDER BY id");
    add("owner,day,ms", "planning_use ORDER BY owner");
    return text;
  }

  void everything_is_there(Store& store) {
    const auto get = [&](const std::string& name) { return store.get(ids[name], true).value(); };
    EXPECT_EQ(get("queued").request.name, "bracket \u00e9");
    EXPECT_EQ(get("queued").request.tags, (std::vector<std::string>{"a", "b\"c"}));
    EXPECT_EQ(get("queued").request.document, new_job().request.document);
    EXPECT_EQ(get("succeeded").planned_by, "1.2.3");
    EXPECT_EQ(get("old").request.document, R"({"kind":"ramp","spec":{"n":0}})");
    EXPECT_EQ(get("running").state, JobState::queued);
    EXPECT_EQ(get("running").revision, 77U + lost_leap);
    EXPECT_EQ(get("asked").state, JobState::cancelled);
    EXPECT_EQ(store.result(ids["failed"]), R"({"n":2})");
    EXPECT_TRUE(store.result(ids["plain"]));
    const auto series = store.series(ids["succeeded"]);
    ASSERT_TRUE(series);
    EXPECT_EQ(series->views, api::views_version);
    std::vector<double> all, chunk;
    for (std::size_t first = 0; first < series->count; first += series->chunk_rows) {
      store.read_chunk(*series, first, chunk);
      all.insert(all.end(), chunk.begin(), chunk.end());
    }
    std::vector<double> expected(series->count * 2);
    Ramp(series->count).read(0, series->count, expected.data());
    EXPECT_EQ(all, expected);

    // Keys are used, for the same documents and for others, by their owners.
    EXPECT_EQ(insert(store, new_job(0, "key of nobody", "hash")).id, ids["queued"]);
    EXPECT_EQ(insert(store, new_job(0, "key of nobody", "x")).what, Inserted::What::conflict);
    NewJob owned = new_job(0, "key of acme", "other hash");
    owned.owner = "acme";
    EXPECT_EQ(insert(store, owned).id, ids["succeeded"]);
    const auto due = store.due_callbacks("http://r", now_ms(), 10);
    ASSERT_EQ(due.size(), 2U);
    EXPECT_EQ(due[0].job.id, ids["failed"]);
    EXPECT_EQ(due[0].secret, "secret");
    EXPECT_EQ(due[1].job.id, ids["asked"]);
    const auto keys = store.keys(0);
    ASSERT_EQ(keys->list.size(), 2U);
    EXPECT_TRUE(keys->list[1].removed_at);
    EXPECT_EQ(store.counts().at(JobState::queued), 33U);
    EXPECT_EQ(store.counts("acme").at(JobState::succeeded), 1U);
    EXPECT_EQ(store.list({.tag = "a"}).size(), 2U);
    const Changes changes = store.changes_since(cursor, 1000);
    EXPECT_TRUE(changes.gap || changes.list.size() == 38U) << "who asks from before hears of all jobs";

    // Whose attempt was lost is planned alone, with another token.
    EXPECT_EQ(claim(store, 1'700'000'000'000)->id, ids["running"]);
    EXPECT_FALSE(claim(store, 1'700'000'000'000));
    EXPECT_EQ(store.get(ids["running"], false)->attempt, 2);
    EXPECT_GT(insert_id(store), ids["old"]) << "ids go on";
  }

  std::map<std::string, std::string> ids;
  std::uint64_t cursor = 0;
  Progress silent;
  TempFolder folder;
  std::optional<Target> target;
};

using Targets = testing::Types<IntoSqlite, IntoPostgres>;
TYPED_TEST_SUITE(Moves, Targets, StoreNames);

TYPED_TEST(Moves, AllOfEveryJobArrivesAndComesBack) {
  this->fill();
  this->finish_filling();
  const std::string before = this->dump("source.db");
  const MoveReport there = move_all(this->url("source.db"), this->target->url());
  EXPECT_EQ(all_of(there.faults), "");
  EXPECT_EQ(there.jobs, 38);
  EXPECT_EQ(there.results, 3);
  EXPECT_EQ(there.chunks, 41);
  EXPECT_GT(there.views, 0);
  EXPECT_EQ(there.keys, 2);
  EXPECT_EQ(this->dump("source.db"), before) << "the source stays as it is";
  const MoveReport back = move_all(this->target->url(), this->url("back.db"));
  EXPECT_EQ(all_of(back.faults), "");
  EXPECT_EQ(back.bytes, there.bytes);
  EXPECT_EQ(this->dump("back.db"), before);
  EXPECT_NE(before.find("'1.2.3'"), std::string::npos) << "results tell which version planned";
  EXPECT_EQ(all_of(inspect(this->target->url())), "");
  EXPECT_EQ(all_of(inspect(this->url("back.db"))), "");
  this->everything_is_there(*this->target->open());
  this->everything_is_there(*open_store(this->url("back.db"), [](double, std::size_t) {}));
}

TYPED_TEST(Moves, GoOnAfterEachInterruption) {
  struct Killed : std::exception {};
  this->fill();
  this->finish_filling();
  const std::string before = this->dump("source.db");
  const auto with_interruptions = [](const std::string& from, const std::string& to) {
    std::int64_t done = 0;  // jobs that are there
    std::size_t stuck = 0;  // interruptions within the next one, each after one commit more
    for (std::size_t interruptions = 0;; ++interruptions) {
      std::size_t commits = 0;
      try {
        const MoveReport report = move_all(from, to,
                                           [&](const MoveProgress& progress) {
                                             if (progress.comparing) return;
                                             EXPECT_GE(progress.jobs, done);
                                             if (progress.jobs == done && ++commits <= stuck) return;
                                             stuck = progress.jobs == done ? stuck + 1 : 0;
                                             done = progress.jobs;
                                             throw Killed();
                                           },
                                           {.jobs = 3, .bytes = 2'000});
        EXPECT_EQ(all_of(report.faults), "");
        EXPECT_EQ(report.jobs, 38);
        return interruptions;
      } catch (const Killed&) {
        EXPECT_NE(refusal([&] { open_store(to, [](double, std::size_t) {}); }).find("migrate-store"), std::string::npos)
            << "no service begins with a part";
      }
    }
  };
  EXPECT_GT(with_interruptions(this->url("source.db"), this->target->url()), 15U);
  EXPECT_EQ(all_of(inspect(this->target->url())), "");
  EXPECT_GT(with_interruptions(this->target->url(), this->url("back.db")), 15U);
  EXPECT_EQ(this->dump("back.db"), before);
  this->everything_is_there(*this->target->open());
}

TYPED_TEST(Moves, RefuseAStoreThatHasJobsOrIsFilledFromElsewhere) {
  struct Killed : std::exception {};
  this->fill();
  const auto begin = [&](const std::string& from) {
    move_all(from, this->target->url(), [](const MoveProgress&) { throw Killed(); }, {.jobs = 2, .bytes = 1 << 20});
  };
  EXPECT_THROW(begin(this->url("source.db")), Killed);
  std::filesystem::copy_file(this->path("source.db"), this->path("copy.db"));
  EXPECT_NE(refusal([&] { begin(this->url("copy.db")); }).find("source.db"), std::string::npos) << "it is named";
  EXPECT_NE(refusal([&] { move_all(this->target->url(), this->url("third.db")); }).find("not all are there"),
            std::string::npos)
      << "a part is no source";
  EXPECT_EQ(all_of(move_all(this->url("source.db"), this->target->url()).faults), "");
  EXPECT_NE(refusal([&] { move_all(this->url("source.db"), this->target->url()); }).find("has 38 jobs already"),
            std::string::npos);
}

TYPED_TEST(Moves, RefuseStoresInUse) {
  this->fill();
  {
    SqliteStore user(SqliteOptions{.path = this->path("source.db")});
    EXPECT_NE(refusal([&] { move_all(this->url("source.db"), this->target->url()); }).find("stop the service"),
              std::string::npos);
  }
  {
    const auto user = this->target->open();
    EXPECT_NE(refusal([&] { move_all(this->url("source.db"), this->target->url()); }).find("stop "), std::string::npos);
    EXPECT_NE(refusal([&] { move_all(this->target->url(), this->url("back.db")); }).find("stop "), std::string::npos);
  }
  EXPECT_NE(refusal([&] { move_all(this->url("none.db"), this->target->url()); }).find("there is no store"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(this->path("none.db")));
}

TYPED_TEST(Moves, FindWhatDiffersOrIsDamaged) {
  this->fill();
  const std::string of_series = " WHERE seq = (SELECT seq FROM jobs WHERE id = '" + this->ids["succeeded"] + "')";
  bool changed = false;
  const MoveReport report = move_all(this->url("source.db"), this->target->url(), [&](const MoveProgress& progress) {
    if (progress.jobs < progress.of || std::exchange(changed, true)) return;
    this->change("UPDATE chunks SET data = zeroblob(length(data))" + of_series + " AND first_row = 4096");
    this->change("UPDATE jobs SET name = 'other' WHERE id = '" + this->ids["plain"] + "'");
    this->change("DELETE FROM specs WHERE seq = (SELECT seq FROM jobs WHERE id = '" + this->ids["cancelled"] + "')");
    this->change("DELETE FROM jobs WHERE id = '" + this->ids["old"] + "'");
  });
  const std::string faults = all_of(report.faults);
  const auto job = [&](const std::string& name) { return "job " + this->ids[name] + ": "; };
  for (const std::string& each :
       {job("succeeded") + "in the source, its setpoints from row 4096 on cannot be unpacked",
        job("succeeded") + "both differ in its setpoints from row 4096 on", job("plain") + "both differ in its row",
        job("cancelled") + "in the source, it has no document",
        job("old") + "it is in the store that was filled alone"})
    EXPECT_NE(faults.find(each), std::string::npos) << each << "\nis not in\n" << faults;
  EXPECT_NE(refusal([&] { this->target->open(); }).find("migrate-store"), std::string::npos) << "nobody uses it so";
}

TYPED_TEST(Moves, FindThatSetpointsAreMissing) {
  this->fill();
  this->change("DELETE FROM chunks WHERE first_row = 8192");
  const MoveReport report = move_all(this->url("source.db"), this->target->url());
  ASSERT_EQ(report.faults.size(), 1U);
  EXPECT_NE(report.faults[0].find("some of its setpoints are missing before row 12288"), std::string::npos);
}

TEST(MoveStore, TakesOneStoreOfEachForm) {
  EXPECT_EQ(store_url("var/a.db"), "sqlite:var/a.db");
  EXPECT_EQ(store_url("sqlite:a.db"), "sqlite:a.db");
  EXPECT_EQ(store_url("postgresql://h/d"), "postgresql://h/d");
  const auto why = [](const std::string& from, const std::string& to) {
    return refusal([&] { move_store(from, to, ignore); });
  };
  EXPECT_NE(why("sqlite:a.db", "sqlite:b.db").find("backup"), std::string::npos);
  EXPECT_NE(why("postgresql://h/d", "postgresql://h/e").find("pg_dump"), std::string::npos);
  EXPECT_NE(why("mysql://h/d", "postgresql://h/e").find("unsupported"), std::string::npos);
}

TEST(MoveToPostgres, JobsOfTheLastDaysHavePartitionsOfTheirOwn) {
  if (IntoPostgres::missing()) GTEST_SKIP() << "its server is not installed";
  const IntoPostgres target;
  const TempFolder folder;
  const std::string path = (folder.path / "source.db").string();
  {
    SqliteStore store(SqliteOptions{.path = path});
    for (const std::int64_t age : {200, 30, 30, 1}) {
      NewJob job = new_job();
      job.now = now_ms() - age * ms_per_day;
      insert_id(store, job);
    }
  }
  EXPECT_EQ(all_of(move_store("sqlite:" + path, target.url(), ignore).faults), "");
  const auto rows = [&](const std::string& table) {
    return PostgresServer::run(target.url(), "SELECT count(*) FROM bahnwerk." + table);
  };
  EXPECT_EQ(rows("specs"), "4");
  EXPECT_EQ(rows("specs_rest"), "1");
  EXPECT_EQ(rows("specs_" + std::to_string(now_ms() / ms_per_day - 30)), "2");
}

}  // namespace
}  // namespace bahnwerk::server
