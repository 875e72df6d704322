#include "server/store/postgres/moving.hpp"

#include <chrono>
#include <deque>
#include <map>
#include <thread>
#include <utility>

#include "server/store/postgres/commands.hpp"
#include "server/store/postgres/connection.hpp"
#include "server/store/postgres/migrate.hpp"
#include "server/store/postgres/partitions.hpp"
#include "server/store/store_url.hpp"

namespace bahnwerk::server::postgres {
namespace {

constexpr PostgresPatience patience{.brief = std::chrono::seconds(30), .lengthy = std::chrono::minutes(30)};
constexpr std::size_t sent_at_once = 4 << 20;  ///< bytes that wait for the server
constexpr std::int64_t own_days = 90;          ///< days until today whose jobs get a partition of their day

constexpr std::string_view moved_columns =
    "j.id, j.kind, j.name, j.reference, j.owner, j.tags, -j.rank, j.turn, j.deadline, j.time_budget, j.state, "
    "coalesce(r.fraction, j.fraction), coalesce(r.stage, j.stage), coalesce(r.message, j.message), j.attempt, j.token, "
    "j.losses, j.suspect, j.cancel_requested, j.created_at, j.started_at, j.finished_at, j.error, "
    "greatest(j.revision, r.revision), j.callback, j.callback_secret, j.callback_receiver, j.callback_attempts, "
    "j.callback_due, j.callback_delivered, j.callback_error, j.needs, j.planned_by";

MovedJob job_of(const PostgresRows& rows, std::size_t row) {
  MovedJob job;
  int at = 0;
  const auto text = [&] { return rows.text(row, at++); };
  const auto integer = [&] { return rows.integer(row, at++); };
  const auto maybe_text = [&] { return rows.optional_text(row, at++); };
  const auto maybe_time = [&] { return rows.optional_time(row, at++); };
  job.id = rows.uuid(row, at++);
  job.kind = text();
  job.name = maybe_text();
  job.reference = maybe_text();
  job.owner = maybe_text();
  if (!rows.null(row, at)) job.tags = rows.texts(row, at);
  ++at;
  job.priority = integer();
  job.turn = integer();
  job.deadline = maybe_time();
  job.time_budget = rows.optional_number(row, at++);
  const std::string name = text();
  const auto state = api::job_state(name);
  if (!state) throw StoreError("store: unknown state " + name, false);
  job.state = *state;
  job.fraction = rows.number(row, at++);
  job.stage = text();
  job.message = text();
  job.attempt = integer();
  job.token = integer();
  job.losses = integer();
  job.suspect = integer() != 0;
  job.cancel_requested = integer() != 0;
  job.created_at = rows.time(row, at++);
  job.started_at = maybe_time();
  job.finished_at = maybe_time();
  job.error = maybe_text();
  job.revision = integer();
  job.callback = maybe_text();
  job.callback_secret = maybe_text();
  job.callback_receiver = maybe_text();
  job.callback_attempts = integer();
  job.callback_due = maybe_time();
  job.callback_delivered = maybe_time();
  job.callback_error = maybe_text();
  job.needs = integer();
  job.planned_by = maybe_text();
  return job;
}

std::vector<MovedJob> read_jobs(PostgresConnection& connection, const std::string& after, std::size_t limit) {
  static const std::string sql = std::string("SELECT ")
                                     .append(moved_columns)
                                     .append(
                                         " FROM jobs AS j LEFT JOIN runs AS r ON r.id = j.id WHERE $1 IS NULL OR "
                                         "j.id > $1 ORDER BY j.id LIMIT $2");
  PostgresParameters page;
  page.uuid(after) << static_cast<std::int64_t>(limit);
  const auto rows = connection.run_lengthy(sql, page);
  std::vector<MovedJob> jobs;
  std::vector<std::string> ids;
  std::map<std::string, std::size_t> places;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    jobs.push_back(job_of(rows, row));
    ids.push_back(jobs.back().id);
    places[ids.back()] = row;
  }
  const auto keys =
      connection.run_lengthy("SELECT id, key, body_hash FROM idempotency_keys WHERE id = ANY ($1) ORDER BY owner, key",
                             PostgresParameters().uuids(ids));
  for (std::size_t row = 0; row < keys.size(); ++row)
    jobs[places.at(keys.uuid(row, 0))].idempotency_keys.emplace_back(keys.text(row, 1), keys.text(row, 2));
  return jobs;
}

// Chunks and views are those of the result's token; a page of them begins behind the last one that was read.
constexpr auto select_chunks =
    "SELECT first_row, row_count, data FROM chunks WHERE id = $1 AND token = (SELECT token FROM results WHERE id = $1 "
    "AND columns IS NOT NULL) AND first_row > $2 ORDER BY first_row LIMIT $3";
constexpr auto select_views =
    "SELECT name, part, data FROM views WHERE id = $1 AND token = (SELECT token FROM results WHERE id = $1 AND columns "
    "IS NOT NULL) AND (name, part) > ($2, $3) ORDER BY name, part LIMIT $4";
constexpr std::int64_t chunks_at_once = 16, views_at_once = 64;

PostgresStatement chunks_after(const std::string& id, std::int64_t first_row) {
  PostgresParameters values;
  values.uuid(id) << first_row << chunks_at_once;
  return {select_chunks, std::move(values)};
}
PostgresStatement views_after(const std::string& id, const std::string& name, std::int64_t part) {
  PostgresParameters values;
  values.uuid(id) << name << part << views_at_once;
  return {select_views, std::move(values)};
}

void read_content(PostgresConnection& connection, const MovedJob& job, MovedContent& to) {
  PostgresParameters id;
  id.uuid(job.id);
  const auto rows = connection.run_all_lengthy(
      {{"SELECT document, checked FROM specs WHERE id = $1", id},
       {"SELECT document, columns, row_count, chunk_rows, cycle_time, views FROM results WHERE id = $1", id},
       chunks_after(job.id, -1),
       views_after(job.id, "", -1)});
  if (!rows[0].empty()) to.document(rows[0].bytes(0, 0), rows[0].flag(0, 1));
  if (rows[1].empty()) return;
  to.result({.document = rows[1].bytes(0, 0),
             .columns = rows[1].optional_text(0, 1),
             .row_count = rows[1].integer(0, 2),
             .chunk_rows = rows[1].integer(0, 3),
             .cycle_time = rows[1].number(0, 4),
             .views = rows[1].integer(0, 5)});
  for (PostgresRows chunks = rows[2]; !chunks.empty();) {
    for (std::size_t row = 0; row < chunks.size(); ++row)
      to.chunk(chunks.integer(row, 0), chunks.integer(row, 1), chunks.bytes(row, 2));
    if (chunks.size() < static_cast<std::size_t>(chunks_at_once)) break;
    chunks = connection.run_all_lengthy({chunks_after(job.id, chunks.integer(chunks.size() - 1, 0))}).at(0);
  }
  for (PostgresRows views = rows[3]; !views.empty();) {
    for (std::size_t row = 0; row < views.size(); ++row)
      to.view(views.text(row, 0), views.integer(row, 1), views.bytes(row, 2));
    if (views.size() < static_cast<std::size_t>(views_at_once)) break;
    const std::size_t last = views.size() - 1;
    views = connection.run_all_lengthy({views_after(job.id, views.text(last, 0), views.integer(last, 1))}).at(0);
  }
}

std::int64_t count_jobs(PostgresConnection& connection) {
  return connection.run_lengthy("SELECT count(*) FROM jobs").integer(0, 0);
}

Keys read_all_keys(PostgresConnection& connection, const std::string& url) {
  Keys keys;
  keys.version = static_cast<std::uint64_t>(connection.run("SELECT version FROM key_version").integer(0, 0));
  keys.list = list_keys(url, false);
  return keys;
}

std::vector<PlanningUse> read_planning_use(PostgresConnection& connection) {
  const auto rows = connection.run("SELECT owner, day, ms FROM planning_use ORDER BY owner");
  std::vector<PlanningUse> use;
  for (std::size_t row = 0; row < rows.size(); ++row)
    use.push_back({rows.text(row, 0), rows.integer(row, 1), rows.integer(row, 2)});
  return use;
}

/// Waits until no other connection of this program is left: one of a killed process may last for some seconds.
void refuse_users(PostgresConnection& connection) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  for (;;) {
    const std::int64_t others = connection
                                    .run(
                                        "SELECT count(*) FROM pg_stat_activity WHERE datname = current_database() AND "
                                        "application_name = 'bahnwerk' AND pid <> pg_backend_pid()")
                                    .integer(0, 0);
    if (others == 0) return;
    if (std::chrono::steady_clock::now() >= until)
      throw StoreError("processes of bahnwerk use the PostgreSQL store (" + std::to_string(others) +
                           " connections); stop all of them for the time of the move",
                       false);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

class PostgresMoveSource final : public MoveReader {
 public:
  explicit PostgresMoveSource(const std::string& url) : url_(url), connection_(url, patience) {
    const int version = postgres_version(connection_), known = static_cast<int>(postgres_migrations().size());
    if (version == 0) throw StoreError("there is no store in " + without_secrets(url), false);
    if (version != known)
      throw StoreError("the store has schema version " + std::to_string(version) + ", this program moves version " +
                           std::to_string(known) +
                           (version < known ? "; run `bahnwerk migrate` on it" : ": it was written by a newer version"),
                       false);
    refuse_unfinished_move(connection_);
    refuse_users(connection_);
    connection_.script("SET statement_timeout = 0; SET idle_in_transaction_session_timeout = 0");
    // The lock comes before the snapshot: what is read then is all there is.
    connection_.script("BEGIN ISOLATION LEVEL REPEATABLE READ");
    try {
      connection_.script("LOCK TABLE jobs, results IN SHARE MODE");
    } catch (const StoreError& error) {
      if (!error.busy) throw;
      throw StoreError("the store is in use; stop all processes of bahnwerk for the time of the move", false, true);
    }
  }
  std::int64_t count() override { return count_jobs(connection_); }
  std::vector<MovedJob> jobs(const std::string& after, std::size_t limit) override {
    return read_jobs(connection_, after, limit);
  }
  void content(const MovedJob& job, MovedContent& to) override { read_content(connection_, job, to); }
  Keys keys() override { return read_all_keys(connection_, url_); }
  std::vector<PlanningUse> planning_use() override { return read_planning_use(connection_); }

 private:
  const std::string url_;
  PostgresConnection connection_;
};

class PostgresMoveTarget final : public MoveTarget {
 public:
  explicit PostgresMoveTarget(const std::string& url) : url_(url), connection_(url, patience) {
    migrate(connection_);
    refuse_users(connection_);
    connection_.script("SET statement_timeout = 0; SET idle_in_transaction_session_timeout = 0");
    today_ = connection_.run("SELECT floor(extract(epoch FROM clock_timestamp()) / 86400)::bigint").integer(0, 0);
  }

  std::int64_t count() override { return count_jobs(connection_); }
  std::vector<MovedJob> jobs(const std::string& after, std::size_t limit) override {
    return read_jobs(connection_, after, limit);
  }
  void content(const MovedJob& job, MovedContent& to) override { read_content(connection_, job, to); }
  Keys keys() override { return read_all_keys(connection_, url_); }
  std::vector<PlanningUse> planning_use() override { return read_planning_use(connection_); }

  MovedJob storable(MovedJob job) const override {
    const auto keep = [](std::string& text) { text = server::storable(text); };
    for (std::string* const text : {&job.kind, &job.stage, &job.message}) keep(*text);
    for (auto* const text : {&job.name, &job.reference, &job.owner, &job.error, &job.callback, &job.callback_secret,
                             &job.callback_receiver, &job.callback_error, &job.planned_by})
      if (*text) keep(**text);
    for (std::string& tag : job.tags) keep(tag);
    for (auto& [key, hash] : job.idempotency_keys) keep(key);
    return job;
  }

  std::optional<MoveState> unfinished() override {
    if (connection_.run("SELECT to_regclass('bahnwerk.unfinished_move') IS NULL").flag(0, 0)) return std::nullopt;
    const auto rows = connection_.run("SELECT source, begun, last_id, jobs FROM unfinished_move");
    if (rows.empty()) return std::nullopt;
    return MoveState{rows.text(0, 0), rows.integer(0, 1), rows.text(0, 2), rows.integer(0, 3)};
  }
  void begin(const MoveState& state) override {
    connection_.begin();
    connection_.script(
        "CREATE TABLE IF NOT EXISTS bahnwerk.unfinished_move (source text NOT NULL, begun bigint NOT NULL, last_id "
        "text NOT NULL, jobs bigint NOT NULL)");
    connection_.run("INSERT INTO unfinished_move VALUES ($1, $2, $3, $4)",
                    PostgresParameters() << state.source << state.begun << state.position << state.jobs);
    connection_.commit();
  }
  void resume(const MoveState& state) override {
    PostgresParameters last;
    last.uuid(state.position);
    connection_.run_all_lengthy({{"DELETE FROM chunks WHERE $1 IS NULL OR id > $1", last},
                                 {"DELETE FROM views WHERE $1 IS NULL OR id > $1", last},
                                 {"DELETE FROM results WHERE $1 IS NULL OR id > $1", last},
                                 {"DELETE FROM specs WHERE $1 IS NULL OR id > $1", last}});
  }
  void open(const MovedJob& job, const MoveState& state) override {
    id_ = job.id;
    token_ = job.token;
    const std::int64_t day = day_of(job.id);
    if (day != day_ && day > today_ - own_days) {
      if (transacting_ || !statements_.empty()) commit(state);
      make_partitions(connection_, day);
    }
    day_ = day;
  }
  void document(std::string_view packed, bool checked) override {
    PostgresParameters values;
    values.uuid(id_).bytes(held(packed)) << checked;
    add_statement("INSERT INTO specs (id, document, checked) VALUES ($1, $2, $3)", std::move(values));
  }
  void result(const MovedResult& result) override {
    PostgresParameters values;
    values.uuid(id_) << token_;
    values.bytes(held(result.document)) << result.columns << result.row_count << result.chunk_rows << result.cycle_time
                                        << result.views;
    add_statement(
        "INSERT INTO results (id, token, document, columns, row_count, chunk_rows, cycle_time, views) VALUES "
        "($1, $2, $3, $4, $5, $6, $7, $8)",
        std::move(values));
  }
  void chunk(std::int64_t first_row, std::int64_t row_count, std::string_view packed) override {
    PostgresParameters values;
    values.uuid(id_) << token_ << first_row << row_count;
    values.bytes(held(packed));
    add_statement("INSERT INTO chunks (id, token, first_row, row_count, data) VALUES ($1, $2, $3, $4, $5)",
                  std::move(values));
  }
  void view(const std::string& name, std::int64_t part, std::string_view packed) override {
    PostgresParameters values;
    values.uuid(id_) << token_ << name << part;
    values.bytes(held(packed));
    add_statement("INSERT INTO views (id, token, name, part, data) VALUES ($1, $2, $3, $4, $5)", std::move(values));
  }
  void add(const MovedJob& job) override {
    PostgresParameters values;
    values.uuid(job.id) << job.kind << job.name << job.reference << job.owner;
    values.texts(job.tags.empty() ? std::nullopt : std::optional(job.tags)) << -job.priority << job.turn;
    values.time(job.deadline) << job.time_budget << api::to_string(job.state) << job.fraction << job.stage
                              << job.message << job.attempt << job.token << job.losses << job.suspect
                              << job.cancel_requested;
    values.time(job.created_at).time(job.started_at).time(job.finished_at)
        << job.error << job.revision << job.callback << job.callback_secret << job.callback_receiver
        << job.callback_attempts;
    values.time(job.callback_due).time(job.callback_delivered) << job.callback_error << job.needs << job.planned_by;
    add_statement(
        "WITH job AS (INSERT INTO jobs (id, kind, name, reference, owner, tags, rank, turn, deadline, time_budget, "
        "state, fraction, stage, message, attempt, token, losses, suspect, cancel_requested, created_at, started_at, "
        "finished_at, error, revision, callback, callback_secret, callback_receiver, callback_attempts, callback_due, "
        "callback_delivered, callback_error, needs, planned_by) VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, "
        "$12, $13, "
        "$14, $15, $16, $17, $18, $19, $20, $21, $22, $23, $24, $25, $26, $27, $28, $29, $30, $31, $32, $33) RETURNING "
        "id, "
        "owner, tags) INSERT INTO job_tags (owner, tag, id) SELECT who.owner, tag, job.id FROM job, unnest(job.tags) "
        "AS tag, LATERAL (SELECT '' AS owner UNION SELECT job.owner WHERE job.owner IS NOT NULL) AS who",
        std::move(values));
    for (const auto& [key, hash] : job.idempotency_keys) {
      PostgresParameters kept;
      (kept << job.owner.value_or("") << key << hash).uuid(job.id);
      add_statement("INSERT INTO idempotency_keys (owner, key, body_hash, id) VALUES ($1, $2, $3, $4)",
                    std::move(kept));
    }
    ++counts_[{std::string(api::to_string(job.state)), job.owner.value_or("")}];
  }
  void commit(const MoveState& state) override {
    for (const auto& [key, jobs] : counts_)
      add_statement("INSERT INTO count_deltas (state, owner, jobs) VALUES ($1, $2, $3)",
                    PostgresParameters() << key.first << key.second << jobs);
    counts_.clear();
    add_statement("UPDATE unfinished_move SET last_id = $1, jobs = $2", PostgresParameters()
                                                                            << state.position << state.jobs);
    send();
    connection_.commit();
    transacting_ = false;
  }
  void put(const Keys& keys, const std::vector<PlanningUse>& use) override {
    for (const Key& key : keys.list) {
      PostgresParameters values;
      (values << key.id << key.name << to_string(key.scopes) << key.hash << key.max_queued << key.max_planning_ms)
          .time(key.created_at)
          .time(key.removed_at);
      add_statement(
          "INSERT INTO keys (id, name, scopes, hash, max_queued, max_planning_ms, created_at, removed_at) VALUES ($1, "
          "$2, $3, $4, $5, $6, $7, $8) ON CONFLICT (id) DO UPDATE SET name = excluded.name, scopes = excluded.scopes, "
          "hash = excluded.hash, max_queued = excluded.max_queued, max_planning_ms = excluded.max_planning_ms, "
          "created_at = excluded.created_at, removed_at = excluded.removed_at",
          std::move(values));
    }
    add_statement("UPDATE key_version SET version = greatest(version, $1)",
                  PostgresParameters() << static_cast<std::int64_t>(keys.version));
    for (const PlanningUse& each : use)
      add_statement(
          "INSERT INTO planning_use (owner, day, ms) VALUES ($1, $2, $3) ON CONFLICT (owner) DO UPDATE SET day = "
          "excluded.day, ms = excluded.ms",
          PostgresParameters() << each.owner << each.day << each.ms);
    send();
    connection_.commit();
    transacting_ = false;
  }
  void finish() override {
    // As after a crash, numbers of changes begin again, above all that clients can have seen.
    connection_.script(
        "BEGIN; DELETE FROM change_feed; DELETE FROM change_numbers; DELETE FROM changes; DROP TABLE unfinished_move; "
        "COMMIT; ANALYZE jobs");
    keep_partitions(connection_);
  }

 private:
  /// Returns the day of a UUID of version 7, since 1970 UTC: its first 48 bits are ms.
  static std::int64_t day_of(const std::string& id) {
    return std::stoll(id.substr(0, 8) + id.substr(9, 4), nullptr, 16) / ms_per_day;
  }
  const std::string& held(std::string_view bytes) {
    held_bytes_ += bytes.size();
    return held_.emplace_back(bytes);
  }
  void add_statement(std::string_view sql, PostgresParameters values) {
    statements_.push_back({sql, std::move(values)});
    if (held_bytes_ >= sent_at_once) send();
  }
  void send() {
    if (!std::exchange(transacting_, true)) connection_.begin();
    connection_.run_all_lengthy(statements_);
    statements_.clear();
    held_.clear();
    held_bytes_ = 0;
  }

  const std::string url_;
  PostgresConnection connection_;
  std::string id_;
  std::int64_t token_ = 0, day_ = 0, today_ = 0;
  bool transacting_ = false;
  std::vector<PostgresStatement> statements_;
  std::deque<std::string> held_;  ///< what the statements refer to
  std::size_t held_bytes_ = 0;
  std::map<std::pair<std::string, std::string>, std::int64_t> counts_;  ///< jobs by state and owner
};

}  // namespace

std::unique_ptr<MoveReader> move_source(const std::string& url) { return std::make_unique<PostgresMoveSource>(url); }

std::unique_ptr<MoveTarget> move_target(const std::string& url) { return std::make_unique<PostgresMoveTarget>(url); }

void refuse_unfinished_move(PostgresConnection& connection) {
  if (!connection.run("SELECT to_regclass('bahnwerk.unfinished_move') IS NULL").flag(0, 0))
    throw StoreRefused(
        "jobs are being moved into this store, and not all are there; run the same `bahnwerk migrate-store` again");
}

}  // namespace bahnwerk::server::postgres
