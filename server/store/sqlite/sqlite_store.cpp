#include "server/store/sqlite/sqlite_store.hpp"

#include <nlohmann/json.hpp>

#include "api/problem.hpp"
#include "server/runtime/clock.hpp"
#include "server/store/codec.hpp"
#include "server/store/sqlite/migrate.hpp"
#include "server/store/sqlite/reader.hpp"

namespace bahnwerk::server {
namespace {

/// Clients may have seen revisions of a running job that were never stored; after a restart it continues far above
/// them.
constexpr std::int64_t recovery_leap = 1 << 20;

std::string cancelled_error(const std::string& id) {
  return api::Problem("cancelled", "The job was cancelled.").document("/v1/jobs/" + id).dump();
}

std::string deadline_error(const std::string& id) {
  return api::Problem("deadline-exceeded", "The deadline passed while the job waited in the queue.")
      .document("/v1/jobs/" + id)
      .dump();
}

std::string lost_error(const std::string& id, std::int64_t attempts) {
  return api::Problem("worker-lost", "The process ended " + std::to_string(attempts) +
                                         " times while it planned this job; it is not tried again.")
      .document("/v1/jobs/" + id)
      .dump();
}

}  // namespace

SqliteStore::SqliteStore(SqliteOptions options)
    : options_(std::move(options)),
      lock_(options_.path + ".lock"),
      connection_(options_.path, true, options_.max_pages),
      reserve_(options_.path + ".reserve", options_.reserve),
      writer_(connection_, reserve_, options_.observer) {
  writer_.outside(migrate);  // each migration is a transaction of its own
  recover(now_ms());
}

SqliteStore::~SqliteStore() = default;

void SqliteStore::recover(std::int64_t now) {
  writer_.run([&](Connection& connection) {
    struct Orphan {
      std::string id;
      std::int64_t attempt;
      bool cancelled;
    };
    std::vector<Orphan> orphans;
    {
      Query running = connection.query("SELECT id, attempt, cancel_requested FROM jobs WHERE state = 'running'");
      while (running.step()) orphans.push_back({running.text(0), running.integer(1), running.integer(2) != 0});
    }
    for (const Orphan& orphan : orphans) {
      if (!orphan.cancelled && orphan.attempt < options_.max_attempts) {
        (connection.query(
             "UPDATE jobs SET state = 'queued', started_at = NULL, fraction = 0, stage = '', message = '', "
             "revision = revision + ? WHERE id = ?")
         << recovery_leap << orphan.id)
            .run();
        continue;  // rows that the lost attempt stored go when the next one begins
      }
      const std::string error = orphan.cancelled ? cancelled_error(orphan.id) : lost_error(orphan.id, orphan.attempt);
      (connection.query("UPDATE jobs SET state = ?, error = ?, finished_at = ?, revision = revision + ? WHERE id = ?")
       << std::string_view(orphan.cancelled ? "cancelled" : "failed") << error << now << recovery_leap << orphan.id)
          .run();
      (connection.query("DELETE FROM chunks WHERE seq = (SELECT seq FROM jobs WHERE id = ?)") << orphan.id).run();
    }
    Query last = connection.query("SELECT max(id) FROM jobs");
    if (last.step() && !last.null(0)) ids_.advance_past(last.text(0));
  });
}

bool SqliteStore::write_flag(const std::function<bool(Connection&)>& work, Writer::Bytes adds) {
  bool result = false;
  writer_.run([&](Connection& connection) { result = work(connection); }, adds);
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
  const Writer::Bytes adds = call->packed.size() + Writer::row;
  writer_.post(
      [this, call](Connection& connection) { call->outcome = insert_one(connection, call->job, call->packed); },
      [call, done = std::move(done)](const std::exception_ptr& error) { done(call->outcome, error); }, adds);
}

Inserted SqliteStore::insert_one(Connection& connection, const NewJob& job, const std::string& packed_document) {
  const bool keyed = !job.idempotency_key.empty();
  if (keyed) {
    Query known =
        connection.query("SELECT jobs.id, body_hash FROM idempotency_keys JOIN jobs USING (seq) WHERE key = ?");
    known << job.idempotency_key;
    if (known.step()) {
      if (known.text(1) != job.body_hash) return {Inserted::What::conflict, ""};
      return {Inserted::What::replayed, known.text(0)};
    }
  }
  Query waiting = connection.query("SELECT jobs FROM job_counts WHERE state = 'queued'");
  if (static_cast<std::size_t>(waiting.one_int()) >= job.max_queued) return {Inserted::What::full, ""};

  const std::string id = ids_.next(job.now);
  const api::JobRequest& r = job.request;
  Query insert = connection.query(
      "INSERT INTO jobs (id, kind, name, reference, callback, priority, deadline, time_budget, state, created_at) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, 'queued', ?) RETURNING seq");
  insert << id << r.kind << r.name << r.reference << r.callback << std::int64_t{r.priority} << r.deadline
         << r.time_budget << job.now;
  insert.step();
  const std::int64_t seq = insert.integer(0);
  insert.step();
  (connection.query("INSERT INTO specs (seq, spec, whole) VALUES (?, ?, 1)") << seq).blob(packed_document).run();
  if (keyed) {
    (connection.query("INSERT INTO idempotency_keys (key, body_hash, seq) VALUES (?, ?, ?)")
     << job.idempotency_key << job.body_hash << seq)
        .run();
  }
  return {Inserted::What::created, id};
}

Expired SqliteStore::expire(std::int64_t now) {
  constexpr std::size_t most = 256;  // of one transaction: others wait for it
  constexpr auto earliest =
      "SELECT id, deadline FROM jobs WHERE state = 'queued' AND deadline IS NOT NULL ORDER BY deadline LIMIT ?";
  Expired expired;
  {
    Reader reader(*this);
    Query next = reader.query(earliest);
    next << std::int64_t{1};
    if (!next.step()) return expired;
    expired.next = next.integer(1);
    if (*expired.next > now) return expired;
  }
  writer_.run([&](Connection& connection) {
    expired = {};
    {
      Query due = connection.query(earliest);
      due << static_cast<std::int64_t>(most + 1);
      while (due.step()) {
        if (due.integer(1) > now || expired.ids.size() == most) {
          expired.next = due.integer(1);
          break;
        }
        expired.ids.push_back(due.text(0));
      }
    }
    for (const std::string& id : expired.ids)
      (connection.query("UPDATE jobs SET state = 'failed', error = ?, finished_at = ?, revision = revision + 1 "
                        "WHERE id = ? AND state = 'queued'")
       << deadline_error(id) << now << id)
          .run();
  });
  return expired;
}

std::optional<api::Job> SqliteStore::cancel(const std::string& id, std::int64_t now) {
  writer_.run([&](Connection& connection) {
    const int queued = (connection.query("UPDATE jobs SET state = 'cancelled', error = ?, finished_at = ?, "
                                         "revision = revision + 1 WHERE id = ? AND state = 'queued'")
                        << cancelled_error(id) << now << id)
                           .run();
    if (queued == 0)
      (connection.query(
           "UPDATE jobs SET cancel_requested = 1 WHERE id = ? AND state = 'running' AND cancel_requested = 0")
       << id)
          .run();
  });
  return get(id, false);
}

Removed SqliteStore::remove(const std::string& id) {
  Removed outcome = Removed::unknown;
  writer_.run([&](Connection& connection) {
    outcome = Removed::unknown;
    Query state = connection.query("SELECT state FROM jobs WHERE id = ?");
    state << id;
    if (!state.step()) return;
    outcome = state.text(0) == "running" ? Removed::running : Removed::yes;
    if (outcome == Removed::yes) (connection.query("DELETE FROM jobs WHERE id = ?") << id).run();
  });
  return outcome;
}

void SqliteStore::checkpoint() {
  writer_.outside([](Connection& connection) { connection.execute("PRAGMA wal_checkpoint(TRUNCATE)"); });
}

}  // namespace bahnwerk::server
