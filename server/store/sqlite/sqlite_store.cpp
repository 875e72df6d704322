#include "server/store/sqlite/sqlite_store.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "server/runtime/clock.hpp"
#include "server/store/codec.hpp"
#include "server/store/sqlite/leftovers.hpp"
#include "server/store/sqlite/migrate.hpp"
#include "server/store/sqlite/moving.hpp"
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"

namespace bahnwerk::server {
namespace {

/// Returns which of its owner's quotas refuses a job, if any.
std::optional<Inserted::What> over_quota(SqliteConnection& connection, const NewJob& job) {
  if (job.owner && job.max_owned) {
    Query queued = connection.query("SELECT jobs FROM job_counts WHERE state = 'queued' AND owner = ?");
    queued << *job.owner;
    if (queued.step() && queued.integer(0) >= *job.max_owned) return Inserted::What::owner_full;
  }
  if (job.owner && job.max_planning_ms) {
    Query spent = connection.query("SELECT ms FROM planning_use WHERE owner = ? AND day = ?");
    spent << *job.owner << job.now / ms_per_day;
    if (spent.step() && spent.integer(0) >= *job.max_planning_ms) return Inserted::What::planning_spent;
  }
  return std::nullopt;
}

/// Returns the turn of a job among those of its priority: after the last one of its owner, and not before those that
/// are at their turn now. Owners with many jobs and owners with one are thus served alternately, and a claim takes the
/// first entry of an index whatever their number is [start-time fair queueing: Goyal, Vin, Cheng 1996].
std::int64_t next_turn(SqliteConnection& connection, const NewJob& job) {
  if (!job.owner) return 0;
  Query turns = connection.query(
      "SELECT max(coalesce((SELECT max(turn) + 1 FROM jobs WHERE state = 'queued' AND owner = ?1 AND priority = ?2), "
      "0), coalesce((SELECT min(turn) FROM jobs WHERE state = 'queued' AND priority = ?2), 0))");
  turns << *job.owner << std::int64_t{job.request.priority};
  turns.step();
  return turns.integer(0);
}

}  // namespace

SqliteStore::SqliteStore(SqliteOptions options)
    : options_(std::move(options)),
      lock_(options_.path + ".lock"),
      file_lock_(options_.path, FileLock::Holder::unnamed),
      connection_(options_.path, true, options_.max_pages),
      reserve_(options_.path + ".reserve", options_.reserve),
      writer_(connection_, reserve_,
              {.begin = [this] { changes_.begin(); },
               .committed =
                   [this](double seconds, std::size_t works) {
                     options_.observer(seconds, works);
                     changes_.committed();
                   }}) {
  writer_.outside(options_.migrate ? migrate : require_up_to_date);  // each migration is a transaction of its own
  writer_.run(sqlite::refuse_unfinished_move);
  recover(now_ms());
}

SqliteStore::~SqliteStore() = default;  // SQLite empties the log when the last connection closes

void SqliteStore::recover(std::int64_t now) {
  writer_.run([&](SqliteConnection& connection) {
    changes_.open(connection);
    Query last = connection.query("SELECT max(id) FROM jobs");
    if (last.step() && !last.null(0)) ids_.advance_past(last.text(0));
    lose(connection, Lease::forever, now, std::numeric_limits<std::int32_t>::max());
  });
}

bool SqliteStore::write_flag(const std::function<bool(SqliteConnection&)>& work, Writer::Bytes adds) {
  bool result = false;
  writer_.run([&](SqliteConnection& connection) { result = work(connection); }, adds);
  return result;
}

void SqliteStore::insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) {
  struct Call {
    NewJob job;
    std::string packed;
    Inserted outcome;
  };
  const auto call = std::make_shared<Call>();
  call->packed = pack_text(job.request.document);
  call->job = std::move(job);
  call->job.request.document = std::string();
  const Writer::Bytes adds = call->packed.size() + Writer::row;
  writer_.post(
      [this, call](SqliteConnection& connection) { call->outcome = insert_one(connection, call->job, call->packed); },
      [call, done = std::move(done)](const std::exception_ptr& error) { done(call->outcome, error); }, adds);
}

Inserted SqliteStore::insert_one(SqliteConnection& connection, const NewJob& job, const std::string& packed_document) {
  const bool keyed = !job.idempotency_key.empty();
  // Each owner has idempotency keys of its own. They contain no line feed.
  const std::string idempotency = job.owner ? *job.owner + "\n" + job.idempotency_key : job.idempotency_key;
  if (keyed) {
    Query known =
        connection.query("SELECT jobs.id, body_hash FROM idempotency_keys JOIN jobs USING (seq) WHERE key = ?");
    known << idempotency;
    if (known.step()) {
      if (known.text(1) != job.body_hash) return {Inserted::What::conflict, ""};
      return {Inserted::What::replayed, known.text(0)};
    }
  }
  Query waiting = connection.query("SELECT sum(jobs) FROM job_counts WHERE state = 'queued'");
  if (static_cast<std::size_t>(waiting.one_int()) >= job.max_queued) return {Inserted::What::full, ""};
  if (const auto refused = over_quota(connection, job)) return {*refused, ""};

  const std::string id = ids_.next(job.now);
  const api::JobRequest& r = job.request;
  Query insert = connection.query(
      "INSERT INTO jobs (id, kind, name, reference, callback, priority, deadline, time_budget, state, created_at, "
      "changed, owner, turn, callback_secret, callback_receiver, tags, needs) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, 'queued', ?, ?, ?, ?, ?, ?, ?, ?) RETURNING seq");
  const std::int64_t change = changes_.next();
  insert << id << r.kind << r.name << r.reference << (r.callback ? std::optional(r.callback->url) : std::nullopt)
         << std::int64_t{r.priority} << r.deadline << r.time_budget << job.now << change << job.owner
         << next_turn(connection, job) << (r.callback ? r.callback->secret : std::nullopt) << job.callback_receiver
         << (r.tags.empty() ? std::nullopt : std::optional(nlohmann::json(r.tags).dump()))
         << std::int64_t{options_.engine};
  insert.step();
  const std::int64_t seq = insert.integer(0);
  insert.step();
  Query spec = connection.query("INSERT INTO specs (seq, spec, whole) VALUES (?, ?, ?)");
  ((spec << seq).blob(packed_document) << spec_form(r.checked)).run();
  if (keyed) {
    (connection.query("INSERT INTO idempotency_keys (key, body_hash, seq) VALUES (?, ?, ?)")
     << idempotency << job.body_hash << seq)
        .run();
  }
  changes_.note(change, id, api::JobState::queued);
  return {Inserted::What::created, id};
}

bool SqliteStore::cancel_one(SqliteConnection& connection, const std::string& id, std::int64_t now) {
  if (leave(connection, {.id = id, .from = api::JobState::queued, .to = after_cancel(id), .now = now})) return true;
  const std::int64_t change = changes_.next();
  const int asked = (connection.query("UPDATE jobs SET cancel_requested = 1, changed = ? "
                                      "WHERE id = ? AND state = 'running' AND cancel_requested = 0")
                     << change << id)
                        .run();
  if (asked == 1) changes_.note(change, id, api::JobState::running, true);
  return asked == 1;
}

std::optional<api::Job> SqliteStore::cancel(const std::string& id, std::int64_t now) {
  writer_.run([&](SqliteConnection& connection) { cancel_one(connection, id, now); });
  return get(id, false);
}

SqliteStore::Gone SqliteStore::remove_one(SqliteConnection& connection, const std::string& id) {
  Gone gone;
  {
    Query job = connection.query("SELECT state, seq, owner FROM jobs WHERE id = ?");
    job << id;
    if (!job.step()) return gone;
    gone = {job.text(0) == "running" ? Removed::running : Removed::yes, job.integer(1), job.optional_text(2)};
  }
  if (gone.outcome != Removed::yes) return gone;
  const std::int64_t change = changes_.next();
  leave_chunks(connection, id);
  for (const char* sql : {"DELETE FROM idempotency_keys WHERE seq = ?", "DELETE FROM results WHERE seq = ?",
                          "DELETE FROM specs WHERE seq = ?", "DELETE FROM jobs WHERE seq = ?"})
    (connection.query(sql) << gone.seq).run();
  keep_removal(connection, change, id, gone.owner);
  changes_.note(change, id, std::nullopt);
  return gone;
}

Removed SqliteStore::remove(const std::string& id, const std::function<bool(const api::Job&)>& condition) {
  static const std::string light = std::string("SELECT ") + job_columns + " FROM jobs WHERE id = ?";
  const auto holds = [&](SqliteConnection& connection) {
    Query row = connection.query(light);
    row << id;
    if (!row.step()) return true;
    const api::Job job = job_from_row(row);
    return job.state == api::JobState::running || condition(job);
  };
  Gone gone;
  writer_.run([&](SqliteConnection& connection) {
    gone = {};
    if (condition && !holds(connection))
      gone.outcome = Removed::refused;
    else
      gone = remove_one(connection, id);
  });
  try {
    while (gone.outcome == Removed::yes && free_piece(gone.seq)) {
    }
  } catch (const StoreError&) {  // the job is gone; expire() frees the rest
  }
  return gone.outcome;
}

bool SqliteStore::free_piece(std::int64_t seq) {
  return write_flag([&](SqliteConnection& connection) { return free_leftovers(connection, seq); }, Writer::frees);
}

void SqliteStore::checkpoint() {
  connection_.patience(std::chrono::seconds(1));  // for what waits before it, too: the process ends
  writer_.outside([](SqliteConnection& connection) {
    connection.patience(std::chrono::seconds(1));
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  });
}

}  // namespace bahnwerk::server
