#include "server/store/sqlite/moving.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/store/codec.hpp"
#include "server/store/open.hpp"
#include "server/store/sqlite/commands.hpp"
#include "server/store/sqlite/connection.hpp"
#include "server/store/sqlite/file_lock.hpp"
#include "server/store/sqlite/migrate.hpp"
#include "server/store/sqlite/rows.hpp"
#include "server/store/unpacking.hpp"

namespace bahnwerk::server::sqlite {
namespace {

/// The locks that a service has, too.
class StoreLocks {
 public:
  explicit StoreLocks(const std::string& path) try : process_(path + ".lock"), file_(path, FileLock::Holder::unnamed) {
  } catch (const StoreError& error) {
    throw StoreError(std::string(error.what()) + "; stop the service for the time of the move", false);
  }

 private:
  const FileLock process_, file_;
};

MovedJob job_of(const Query& row) {
  MovedJob job;
  int at = 0;
  const auto text = [&] { return row.text(at++); };
  const auto integer = [&] { return row.integer(at++); };
  const auto maybe_text = [&] { return row.optional_text(at++); };
  const auto maybe_integer = [&] { return row.optional_integer(at++); };
  job.key = integer();
  job.id = text();
  job.kind = text();
  job.name = maybe_text();
  job.reference = maybe_text();
  job.owner = maybe_text();
  if (const auto tags = maybe_text())
    job.tags = unpacking([&] { return nlohmann::json::parse(*tags).get<std::vector<std::string>>(); });
  job.priority = integer();
  job.turn = integer();
  job.deadline = maybe_integer();
  if (!row.null(at)) job.time_budget = row.number(at);
  ++at;
  const std::string name = text();
  const auto state = api::job_state(name);
  if (!state) throw StoreError("store: unknown state " + name, false);
  job.state = *state;
  job.fraction = row.number(at++);
  job.stage = text();
  job.message = text();
  job.attempt = integer();
  job.token = integer();
  job.losses = integer();
  job.suspect = integer() != 0;
  job.cancel_requested = integer() != 0;
  job.created_at = integer();
  job.started_at = maybe_integer();
  job.finished_at = maybe_integer();
  job.error = maybe_text();
  job.revision = integer();
  job.callback = maybe_text();
  job.callback_secret = maybe_text();
  job.callback_receiver = maybe_text();
  job.callback_attempts = integer();
  job.callback_due = maybe_integer();
  job.callback_delivered = maybe_integer();
  job.callback_error = maybe_text();
  job.needs = integer();
  job.planned_by = maybe_text();
  return job;
}

/// The columns of a job's row in the order in which job_of() reads them and add() writes them.
constexpr std::string_view moved_columns =
    "seq, id, kind, name, reference, owner, tags, priority, turn, deadline, time_budget, state, fraction, stage, "
    "message, attempt, token, losses, suspect, cancel_requested, created_at, started_at, finished_at, error, revision, "
    "callback, callback_secret, callback_receiver, callback_attempts, callback_due, callback_delivered, "
    "callback_error, needs, planned_by";

/// Idempotency keys of an owner stand behind the owner's name and a line feed.
std::string owner_prefix(const MovedJob& job) { return job.owner ? *job.owner + "\n" : ""; }

std::vector<MovedJob> read_jobs(SqliteConnection& connection, const std::string& after, std::size_t limit) {
  static const std::string sql =
      std::string("SELECT ").append(moved_columns).append(" FROM jobs WHERE id > ? ORDER BY id LIMIT ?");
  std::vector<MovedJob> jobs;
  Query rows = connection.query(sql);
  rows << after << static_cast<std::int64_t>(limit);
  while (rows.step()) {
    MovedJob job = job_of(rows);
    Query keys = connection.query("SELECT key, body_hash FROM idempotency_keys WHERE seq = ? ORDER BY key");
    keys << job.key;
    const std::string prefix = owner_prefix(job);
    while (keys.step()) {
      std::string key = keys.text(0);
      if (key.starts_with(prefix)) key.erase(0, prefix.size());
      job.idempotency_keys.emplace_back(std::move(key), keys.text(1));
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

void read_content(SqliteConnection& connection, const MovedJob& job, MovedContent& to) {
  {
    Query spec = connection.query("SELECT spec, whole FROM specs WHERE seq = ?");
    spec << job.key;
    if (spec.step()) {
      const std::int64_t form = spec.integer(1);
      if (form == spec_alone)  // of version 0.1: no other store has that form
        to.document(unpacking([&] { return pack_text(unpack_document(job.kind, spec.bytes(0), false)); }), true);
      else
        to.document(spec.bytes(0), form == document_checked);
    }
  }
  {
    Query row = connection.query(
        "SELECT document, columns, row_count, chunk_rows, cycle_time, views FROM results WHERE seq = ?");
    row << job.key;
    if (!row.step()) return;
    to.result({.document = row.bytes(0),
               .columns = row.optional_text(1),
               .row_count = row.integer(2),
               .chunk_rows = row.integer(3),
               .cycle_time = row.number(4),
               .views = row.integer(5)});
    if (row.null(1)) return;
  }
  Query chunks = connection.query("SELECT first_row, row_count, data FROM chunks WHERE seq = ? ORDER BY first_row");
  chunks << job.key;
  while (chunks.step()) to.chunk(chunks.integer(0), chunks.integer(1), chunks.bytes(2));
  Query views = connection.query("SELECT name, part, data FROM views WHERE seq = ? ORDER BY name, part");
  views << job.key;
  while (views.step()) to.view(views.text(0), views.integer(1), views.bytes(2));
}

std::int64_t one_integer(SqliteConnection& connection, std::string_view sql) {
  Query row = connection.query(sql);
  return row.step() ? row.integer(0) : 0;
}

Keys read_all_keys(SqliteConnection& connection, const std::string& url) {
  Keys keys;
  keys.version = static_cast<std::uint64_t>(one_integer(connection, "SELECT version FROM key_version"));
  keys.list = list_keys(url);
  return keys;
}

std::vector<PlanningUse> read_planning_use(SqliteConnection& connection) {
  std::vector<PlanningUse> use;
  Query rows = connection.query("SELECT owner, day, ms FROM planning_use ORDER BY owner");
  while (rows.step()) use.push_back({rows.text(0), rows.integer(1), rows.integer(2)});
  return use;
}

std::string existing_path(const std::string& url) {
  check_store(url);
  std::error_code error;
  const std::string given = url.substr(7);
  if (!std::filesystem::is_regular_file(given, error)) throw StoreError("there is no store " + given, false);
  return prepared_path(url);
}

class SqliteMoveSource final : public MoveReader {
 public:
  explicit SqliteMoveSource(const std::string& url)
      : url_(url), path_(existing_path(url)), locks_(path_), connection_(path_, false) {
    const int version = connection_.query("PRAGMA user_version").one_int();
    const int known = static_cast<int>(migrations().size());
    if (version != known)
      throw StoreError("the store " + path_ + " has schema version " + std::to_string(version) +
                           ", this program moves version " + std::to_string(known) + "; " +
                           (version < known ? "run `bahnwerk migrate` on it" : "it was written by a newer version"),
                       false);
    refuse_unfinished_move(connection_);
  }
  std::int64_t count() override { return one_integer(connection_, "SELECT count(*) FROM jobs"); }
  std::vector<MovedJob> jobs(const std::string& after, std::size_t limit) override {
    return read_jobs(connection_, after, limit);
  }
  void content(const MovedJob& job, MovedContent& to) override { read_content(connection_, job, to); }
  Keys keys() override { return read_all_keys(connection_, url_); }
  std::vector<PlanningUse> planning_use() override { return read_planning_use(connection_); }

 private:
  const std::string url_, path_;
  const StoreLocks locks_;
  SqliteConnection connection_;
};

class SqliteMoveTarget final : public MoveTarget {
 public:
  explicit SqliteMoveTarget(const std::string& url)
      : url_(url), path_(prepared_path(url)), locks_(path_), connection_(path_, true) {
    migrate(connection_);
    // The position is in the same file: after a loss of power both are older, and the move goes on from there.
    connection_.execute("PRAGMA synchronous = NORMAL");
  }
  ~SqliteMoveTarget() override { connection_.rollback(); }

  std::int64_t count() override { return one_integer(connection_, "SELECT count(*) FROM jobs"); }
  std::vector<MovedJob> jobs(const std::string& after, std::size_t limit) override {
    return read_jobs(connection_, after, limit);
  }
  void content(const MovedJob& job, MovedContent& to) override { read_content(connection_, job, to); }
  Keys keys() override { return read_all_keys(connection_, url_); }
  std::vector<PlanningUse> planning_use() override { return read_planning_use(connection_); }

  std::optional<MoveState> unfinished() override {
    if (one_integer(connection_, "SELECT count(*) FROM sqlite_master WHERE name = 'unfinished_move'") == 0)
      return std::nullopt;
    Query row = connection_.query("SELECT source, begun, last_id, jobs FROM unfinished_move");
    if (!row.step()) return std::nullopt;
    return MoveState{row.text(0), row.integer(1), row.text(2), row.integer(3)};
  }
  void begin(const MoveState& state) override {
    connection_.execute("BEGIN IMMEDIATE");
    connection_.execute(
        "CREATE TABLE IF NOT EXISTS unfinished_move (source TEXT NOT NULL, begun INTEGER NOT NULL, last_id TEXT NOT "
        "NULL, jobs INTEGER NOT NULL) STRICT");
    (connection_.query("INSERT INTO unfinished_move VALUES (?, ?, ?, ?)")
     << state.source << state.begun << state.position << state.jobs)
        .run();
    connection_.execute("COMMIT");
  }
  void resume(const MoveState&) override {
    const std::int64_t last = last_seq();
    connection_.execute("BEGIN IMMEDIATE");
    for (const char* sql : {"DELETE FROM chunks WHERE seq > ?", "DELETE FROM views WHERE seq > ?",
                            "DELETE FROM results WHERE seq > ?", "DELETE FROM specs WHERE seq > ?"})
      (connection_.query(sql) << last).run();
    connection_.execute("COMMIT");
  }
  void open(const MovedJob&, const MoveState& state) override {
    seq_ = seq_ == 0 ? last_seq() + 1 : seq_ + 1;
    // Greater than all numbers that clients can have seen: those of a PostgreSQL store are microseconds, too.
    changed_ = state.begun * 1000 + state.jobs + 1;
    transact();
  }
  void document(std::string_view packed, bool checked) override {
    transact();
    Query row = connection_.query("INSERT INTO specs (seq, spec, whole) VALUES (?, ?, ?)");
    ((row << seq_).blob(packed) << spec_form(checked)).run();
  }
  void result(const MovedResult& result) override {
    transact();
    Query row = connection_.query(
        "INSERT INTO results (seq, document, columns, row_count, chunk_rows, cycle_time, views) "
        "VALUES (?, ?, ?, ?, ?, ?, ?)");
    (row << seq_).blob(result.document);
    (row << result.columns << result.row_count << result.chunk_rows << result.cycle_time << result.views).run();
  }
  void chunk(std::int64_t first_row, std::int64_t row_count, std::string_view packed) override {
    transact();
    Query row = connection_.query("INSERT INTO chunks (seq, first_row, row_count, data) VALUES (?, ?, ?, ?)");
    (row << seq_ << first_row << row_count).blob(packed).run();
  }
  void view(const std::string& name, std::int64_t part, std::string_view packed) override {
    transact();
    Query row = connection_.query("INSERT INTO views (seq, name, part, data) VALUES (?, ?, ?, ?)");
    (row << seq_ << name << part).blob(packed).run();
  }
  void add(const MovedJob& job) override {
    transact();
    static const std::string sql =
        std::string("INSERT INTO jobs (")
            .append(moved_columns)
            .append(
                ", changed) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
                "?, ?, ?, ?, ?, ?, ?, ?)");
    Query row = connection_.query(sql);
    row << seq_ << job.id << job.kind << job.name << job.reference << job.owner
        << (job.tags.empty() ? std::nullopt : std::optional(nlohmann::json(job.tags).dump())) << job.priority
        << job.turn << job.deadline << job.time_budget << api::to_string(job.state) << job.fraction << job.stage
        << job.message << job.attempt << job.token << job.losses << std::int64_t{job.suspect}
        << std::int64_t{job.cancel_requested} << job.created_at << job.started_at << job.finished_at << job.error
        << job.revision << job.callback << job.callback_secret << job.callback_receiver << job.callback_attempts
        << job.callback_due << job.callback_delivered << job.callback_error << job.needs << job.planned_by << changed_;
    row.run();
    for (const auto& [key, hash] : job.idempotency_keys)
      (connection_.query("INSERT INTO idempotency_keys (key, body_hash, seq) VALUES (?, ?, ?)")
       << owner_prefix(job) + key << hash << seq_)
          .run();
  }
  void commit(const MoveState& state) override {
    transact();
    (connection_.query("UPDATE unfinished_move SET last_id = ?, jobs = ?") << state.position << state.jobs).run();
    connection_.execute("COMMIT");
    transacting_ = false;
  }
  void put(const Keys& keys, const std::vector<PlanningUse>& use) override {
    connection_.execute("BEGIN IMMEDIATE");
    for (const Key& key : keys.list)
      (connection_.query(
           "INSERT INTO keys (id, name, scopes, hash, max_queued, max_planning_ms, created_at, removed_at) VALUES (?, "
           "?, ?, ?, ?, ?, ?, ?) ON CONFLICT (id) DO UPDATE SET name = excluded.name, scopes = excluded.scopes, hash = "
           "excluded.hash, max_queued = excluded.max_queued, max_planning_ms = excluded.max_planning_ms, created_at = "
           "excluded.created_at, removed_at = excluded.removed_at")
       << key.id << key.name << to_string(key.scopes) << key.hash << key.max_queued << key.max_planning_ms
       << key.created_at << key.removed_at)
          .run();
    (connection_.query("UPDATE key_version SET version = max(version, ?)") << static_cast<std::int64_t>(keys.version))
        .run();
    for (const PlanningUse& each : use)
      (connection_.query(
           "INSERT INTO planning_use VALUES (?, ?, ?) ON CONFLICT (owner) DO UPDATE SET day = excluded.day, ms = "
           "excluded.ms")
       << each.owner << each.day << each.ms)
          .run();
    connection_.execute("COMMIT");
  }
  void finish() override {
    connection_.execute("PRAGMA synchronous = FULL");
    connection_.execute("DROP TABLE unfinished_move");
    connection_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  }

 private:
  /// Returns the last number that a row of a job has had.
  std::int64_t last_seq() {
    return one_integer(connection_,
                       "SELECT max(coalesce((SELECT max(seq) FROM jobs), 0), coalesce((SELECT seq FROM sqlite_sequence "
                       "WHERE name = 'jobs'), 0))");
  }
  void transact() {
    if (!std::exchange(transacting_, true)) connection_.execute("BEGIN IMMEDIATE");
  }

  const std::string url_, path_;
  const StoreLocks locks_;
  SqliteConnection connection_;
  std::int64_t seq_ = 0, changed_ = 0;
  bool transacting_ = false;
};

}  // namespace

std::unique_ptr<MoveReader> move_source(const std::string& url) { return std::make_unique<SqliteMoveSource>(url); }

std::unique_ptr<MoveTarget> move_target(const std::string& url) { return std::make_unique<SqliteMoveTarget>(url); }

void refuse_unfinished_move(SqliteConnection& connection) {
  if (one_integer(connection, "SELECT count(*) FROM sqlite_master WHERE name = 'unfinished_move'") > 0)
    throw StoreError(
        "jobs are being moved into this store, and not all are there; run the same `bahnwerk migrate-store` again",
        false);
}

}  // namespace bahnwerk::server::sqlite
