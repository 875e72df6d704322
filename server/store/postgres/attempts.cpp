/// PostgresStore: the calls of workers, from claim to end, and the steps of the state machine. Each step is one
/// statement, whose fence is the state and the token in the job's row.
#include <algorithm>
#include <set>

#include "server/runtime/uuid7.hpp"
#include "server/store/codec.hpp"
#include "server/store/postgres/job_rows.hpp"
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

/// Time for which a claim begins its search where the last one of the process ended. The index's entries of claimed
/// jobs stay as long as any snapshot is older than their claims, and each search from the queue's head would pass all
/// of them.
constexpr std::chrono::seconds searched_for{1};

/// Isolation: READ COMMITTED; SKIP LOCKED gives no row to two. MATERIALIZED is necessary: planned into the update, the
/// query could lock more rows than its limit. A suspect waits until nothing else runs in the worker's process, and the
/// others until it has ended. $5 to $7 are the place in the queue after which the search begins. $8 are the jobs that
/// the process has: found by their ids, because `runs` keeps the rows of all that ended since the oldest snapshot.
std::string claim_statement() {
  return std::string(
             "WITH next AS MATERIALIZED (SELECT id, suspect FROM jobs WHERE state = 'queued' AND needs <= $4 "
             "AND (rank, turn, id) > ($5, $6, $7) ORDER BY rank, turn, id LIMIT 1 FOR UPDATE SKIP LOCKED), "
             "mine AS (SELECT count(*) AS number, coalesce(bool_or(held.suspect), false) AS suspects FROM unnest($8) "
             "AS m "
             "(id), LATERAL (SELECT suspect FROM runs WHERE runs.id = m.id AND worker = $1 OFFSET 0) AS held), "
             "job AS (UPDATE jobs SET state = 'running', attempt = attempt + 1, token = token + 1, started_at = "
             "coalesce($2, clock_timestamp()), "
             "revision = revision + 1 FROM next, mine WHERE jobs.id = next.id AND (mine.number = 0 OR NOT "
             "(next.suspect OR mine.suspects)) RETURNING jobs.*), "
             "run AS (INSERT INTO runs (id, token, worker, lease_until, lease_ms, suspect) SELECT id, token, $1, "
             "CASE WHEN $3 IS NULL THEN 'infinity' ELSE coalesce($2, clock_timestamp()) + $3 * interval '1 ms' END, "
             "$3, suspect FROM job), "
             "told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job), "
             "counted AS (INSERT INTO count_deltas (state, owner, jobs) SELECT s.state, coalesce(job.owner, ''), "
             "s.jobs FROM job, (VALUES ('queued', -1), ('running', 1)) AS s (state, jobs)) SELECT ")
      .append(postgres_job_columns)
      .append(", j.turn FROM job AS j LEFT JOIN runs AS r ON r.id = j.id");
}

/// What follows the update of `jobs`, which the step's `job` is: the attempt is over, others hear of it, and the counts
/// follow.
constexpr std::string_view step_end =
    "told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job), "
    "counted AS (INSERT INTO count_deltas (state, owner, jobs) SELECT s.state, coalesce(job.owner, ''), s.jobs "
    "FROM job, (VALUES ($2, -1), ($4, 1)) AS s (state, jobs)), "
    "run AS (DELETE FROM runs USING job WHERE runs.id = job.id) "
    "SELECT count(*) FROM job";

constexpr std::string_view fence =
    "FROM (SELECT $1 AS id) AS key LEFT JOIN runs AS r ON r.id = key.id WHERE jobs.id = key.id AND state = $2 AND "
    "jobs.token = coalesce($3, jobs.token) AND cancel_requested = coalesce($8 = 1, cancel_requested) ";

/// Returns a name for a call, by which its effect is known.
std::string call_name() {
  thread_local Uuid7 names;
  return names.next(0);
}

/// $1 id, $2 state, $3 token, $4 next state, $5 time, NULL: by the clock of the database, $6 revision seen, $7 leap, $8
/// cancellation, $9 error, $10 name of the call, $11 result, $12 version of the program, both of a call alone.
const std::string& end_statement() {
  static const std::string sql =
      std::string(
          "WITH job AS (UPDATE jobs SET state = $4, error = $9, finished_at = coalesce($5, clock_timestamp()), "
          "ended_by = $10, "
          "planned_by = $12, revision = greatest(jobs.revision, r.revision, $6) + $7, fraction = coalesce(r.fraction, "
          "jobs.fraction), "
          "stage = coalesce(r.stage, jobs.stage), message = coalesce(r.message, jobs.message), "
          "callback_due = CASE WHEN callback_receiver IS NOT NULL THEN coalesce($5, clock_timestamp()) END ")
          .append(fence)
          .append(
              "RETURNING jobs.id, jobs.owner, jobs.token, started_at, finished_at), "
              "result AS (INSERT INTO results (id, token, document) SELECT id, token, $11 FROM job WHERE $11 IS NOT "
              "NULL), "
              "left_over AS (INSERT INTO leftovers (id, token) SELECT id, token FROM job WHERE $2 = 'running' "
              "ON CONFLICT DO NOTHING), "
              "spent AS (INSERT INTO planning_use (owner, day, ms) SELECT owner, floor(extract(epoch FROM finished_at) "
              "/ 86400)::bigint, greatest(0, (extract(epoch FROM finished_at - started_at) * 1000)::bigint) FROM job "
              "WHERE owner IS NOT NULL AND $2 = 'running' ON CONFLICT (owner) DO UPDATE SET ms = CASE WHEN "
              "planning_use.day = excluded.day THEN planning_use.ms ELSE 0 END + excluded.ms, day = excluded.day), ")
          .append(step_end);
  return sql;
}

/// $1 to $8 as in end_statement(), where $5 is the number of attempts that are not counted; $9 losses, more than before
/// if that of this attempt counts.
const std::string& queue_statement() {
  static const std::string sql =
      std::string(
          "WITH job AS (UPDATE jobs SET state = $4, error = NULL, started_at = NULL, attempt = attempt - $5::int, "
          "fraction = 0, stage = '', message = '', revision = greatest(jobs.revision, r.revision, $6) + $7, "
          "suspect = jobs.suspect OR $9 IS NOT NULL, losses = coalesce($9, losses), "
          "lost_tokens = CASE WHEN $9 > losses THEN array_append(lost_tokens, jobs.token) ELSE lost_tokens END ")
          .append(fence)
          .append(
              "RETURNING jobs.id, jobs.owner, jobs.token), "
              "left_over AS (INSERT INTO leftovers (id, token) SELECT id, token FROM job ON CONFLICT DO NOTHING), ")
          .append(step_end);
  return sql;
}

}  // namespace

PostgresStatement PostgresStore::lock_of(const std::string& id) {
  return {"SELECT state FROM jobs WHERE id = $1 FOR UPDATE", PostgresParameters().uuid(id)};
}

PostgresStatement PostgresStore::statement_of(const Step& step) const {
  const bool queued = step.to.state == JobState::queued;
  PostgresParameters values;
  values.uuid(step.id) << api::to_string(step.from) << step.token << api::to_string(step.to.state);
  if (queued)
    values << step.not_made;
  else
    values.time(clock(step.now));
  values << static_cast<std::int64_t>(step.seen) << step.leap;
  values << (step.cancel_requested ? std::optional<std::int64_t>(*step.cancel_requested ? 1 : 0) : std::nullopt);
  if (queued)
    values << step.losses;
  else
    (values << step.to.error).uuid(step.ended_by).bytes(step.result) << step.planned_by;
  return {queued ? queue_statement() : end_statement(), std::move(values)};
}

/// Fence: token and state; only a call of the attempt itself names itself in `ended_by`.
bool PostgresStore::ended(PostgresConnection& connection, const Attempt& attempt, JobState state) {
  PostgresParameters values;
  values.uuid(attempt.id) << attempt.token << api::to_string(state);
  return !connection
              .run("SELECT 1 FROM jobs WHERE id = $1 AND token = $2 AND state = $3 AND ended_by IS NOT NULL", values)
              .empty();
}

/// Fence: the token, which is counted once. READ COMMITTED. A job that has ended stays as it is.
void PostgresStore::take_back_losses(PostgresConnection& connection, const std::vector<Attempt>& attempts) {
  std::vector<std::string> ids;
  std::vector<std::int64_t> tokens;
  for (const Attempt& attempt : attempts) {
    ids.push_back(attempt.id);
    tokens.push_back(attempt.token);
  }
  connection.run(
      "UPDATE jobs SET losses = losses - 1, lost_tokens = array_remove(lost_tokens, lived.token) FROM unnest($1, $2) "
      "AS lived (id, token) WHERE jobs.id = lived.id AND lived.token = ANY (lost_tokens) AND state IN ('queued', "
      "'running')",
      PostgresParameters().uuids(ids).integers(tokens));
}

std::optional<api::Job> PostgresStore::claim(const Lease& lease) {
  static const std::string sql = claim_statement();
  std::optional<api::Job> job;
  const auto length = lease.until == Lease::forever ? std::nullopt : std::optional(lease.until - lease.now);
  const auto take = [&](const QueuePlace& after) {
    writing([&](PostgresConnection& connection) {
      PostgresParameters values;
      (values << lease.worker).time(clock(lease.now)) << length << std::int64_t{options_.engine};
      (values << after.rank << after.turn).uuid(after.id).uuids(given());
      const std::uint64_t known = queue_changes_;
      const auto rows = connection.run(sql, values);
      if (rows.empty()) return;
      job = job_from(rows, 0);
      // What is queued before this place meanwhile has to be found by the next claim.
      claimed_up_to_ = {rows.integer(0, 5), rows.integer(0, postgres_job_column_count), job->id};
      if (after == QueuePlace{}) searched_all_ = std::chrono::steady_clock::now();
      known_queue_ = known;
    });
  };
  const std::lock_guard lock(claim_mutex_);
  if (claim_unknown_) {
    reading([&](PostgresConnection& connection) { job = adopt(connection, lease.worker); });
    claim_unknown_ = job.has_value();  // there may be another
  }
  const bool adopted = job.has_value();
  try {
    const bool fresh =
        known_queue_ == queue_changes_ && std::chrono::steady_clock::now() < searched_all_ + searched_for;
    if (!job && fresh) take(claimed_up_to_);
    if (!job) take({});
    if (!job) {
      if (const auto lost = lose(lease.now); !lost.empty()) {
        options_.lost(lost);
        take({});
      }
    }
    if (!job) return job;
    if (!adopted) publish({{.id = job->id, .state = JobState::running}});
    // By the id alone, so that its partition is known.
    reading([&](PostgresConnection& connection) {
      const auto spec = connection.run_lengthy("SELECT document, checked FROM specs WHERE id = $1",
                                               PostgresParameters().uuid(job->id));
      if (spec.empty()) throw StoreError("store: a job without its document", false);
      job->request.document = unpack_text(spec.bytes(0, 0));
      job->request.checked = spec.flag(0, 1);
    });
  } catch (const StoreError&) {
    claim_unknown_ = true;
    throw;
  }
  const std::lock_guard given_lock(given_mutex_);
  given_.emplace(job->id, job->token);
  return job;
}

/// Returns a job that was claimed for this worker by a claim whose answer was lost.
std::optional<api::Job> PostgresStore::adopt(PostgresConnection& connection, const std::string& worker) {
  static const std::string sql = std::string("SELECT ")
                                     .append(postgres_job_columns)
                                     .append(
                                         " FROM runs AS r JOIN jobs AS j ON j.id = r.id AND j.token = r.token AND "
                                         "j.state = 'running' WHERE r.worker = $1");
  const auto rows = connection.run(sql, PostgresParameters() << worker);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    api::Job job = job_from(rows, row);
    const std::lock_guard lock(given_mutex_);
    if (!given_.contains({job.id, job.token})) return job;
  }
  return std::nullopt;
}

std::vector<std::string> PostgresStore::given() {
  std::vector<std::string> ids;
  const std::lock_guard lock(given_mutex_);
  for (const auto& [id, token] : given_) ids.push_back(id);
  return ids;
}

void PostgresStore::forget(const Attempt& attempt) {
  const std::lock_guard lock(given_mutex_);
  given_.erase({attempt.id, attempt.token});
}

/// Fence: token and worker. One statement for all attempts, not waited for until it is on the disk: what a crash of the
/// server may undo, raise_revisions() makes up for. READ COMMITTED.
std::vector<Held> PostgresStore::heartbeat(const Lease& lease, const std::vector<Progressed>& attempts) {
  std::vector<Held> held;
  if (attempts.empty()) return held;
  std::vector<std::string> ids, stages, messages;
  std::vector<std::int64_t> tokens, revisions;
  std::vector<double> fractions;
  for (const Progressed& p : attempts) {
    ids.push_back(p.attempt.id);
    tokens.push_back(p.attempt.token);
    fractions.push_back(p.fraction);
    stages.push_back(p.stage);
    messages.push_back(p.message);
    revisions.push_back(static_cast<std::int64_t>(p.revision));
  }
  const auto length = lease.until == Lease::forever ? std::nullopt : std::optional(lease.until - lease.now);
  with_connection_of(leases_, true, [&](PostgresConnection& connection) {
    PostgresParameters values;
    values.uuids(ids).integers(tokens).time(clock(lease.now)) << length << lease.worker;
    values.numbers(fractions).texts(stages).texts(messages).integers(revisions);
    const auto rows = connection.run_all(
        {{"SELECT set_config('synchronous_commit', 'off', true)"},
         {"UPDATE runs SET lease_until = CASE WHEN $4 IS NULL THEN 'infinity' ELSE coalesce($3, clock_timestamp()) + "
          "$4 * interval '1 ms' END, lease_ms = $4, revision = greatest(runs.revision, p.revision), "
          "fraction = CASE WHEN p.revision >= runs.revision THEN p.fraction ELSE runs.fraction END, "
          "stage = CASE WHEN p.revision >= runs.revision THEN p.stage ELSE runs.stage END, "
          "message = CASE WHEN p.revision >= runs.revision THEN p.message ELSE runs.message END "
          "FROM unnest($1, $2, $6, $7, $8, $9) AS p (id, token, fraction, stage, message, revision) "
          "JOIN jobs ON jobs.id = p.id WHERE runs.id = p.id AND runs.token = p.token AND worker = $5 "
          "RETURNING runs.id, runs.token, runs.revision, jobs.cancel_requested",
          std::move(values)}});
    held.clear();
    for (std::size_t row = 0; row < rows[1].size(); ++row)
      held.push_back({{rows[1].uuid(row, 0), rows[1].integer(row, 1)},
                      static_cast<std::uint64_t>(rows[1].integer(row, 2)),
                      rows[1].flag(row, 3)});
  });
  std::vector<Attempt> lost;
  for (const Progressed& p : attempts)
    if (std::none_of(held.begin(), held.end(), [&](const Held& each) { return each.attempt == p.attempt; }))
      lost.push_back(p.attempt);
  for (const Attempt& attempt : lost) forget(attempt);
  if (!lost.empty())
    with_connection_of(leases_, true, [&](PostgresConnection& connection) { take_back_losses(connection, lost); });
  return held;
}

/// Repeated, also where an answer was lost, it finds what it has done.
bool PostgresStore::end(const Attempt& attempt, const Ending& ending) {
  const Step step{.id = attempt.id,
                  .from = JobState::running,
                  .token = attempt.token,
                  .to = {ending.state, ending.error},
                  .now = ending.now,
                  .seen = ending.revision,
                  .ended_by = call_name(),
                  .result = ending.result.empty() ? std::nullopt : std::optional(pack_text(ending.result)),
                  .planned_by = options_.planned_by};
  const bool done = with_connection(true, [&](PostgresConnection& connection) {
    if (connection.run_all({statement_of(step)}).at(0).integer(0, 0) == 1) return true;
    if (ended(connection, attempt, ending.state)) return true;
    take_back_losses(connection, {attempt});
    return false;
  });
  forget(attempt);
  if (done) publish({{.id = attempt.id, .state = ending.state}});
  return done;
}

/// Which of the two steps is made is decided under the lock of the job's row: a cancellation comes before it or after.
bool PostgresStore::requeue(const Attempt& attempt, std::int64_t now, std::uint64_t revision) {
  Statements statements{lock_of(attempt.id)};
  std::vector<Fate> fates;
  for (const bool cancelled : {false, true}) {
    fates.push_back(after_requeue(attempt.id, cancelled));
    statements.push_back(statement_of({.id = attempt.id,
                                       .from = JobState::running,
                                       .token = attempt.token,
                                       .cancel_requested = cancelled,
                                       .to = fates.back(),
                                       .now = now,
                                       .seen = revision,
                                       .not_made = 1}));
  }
  const auto rows = writing([&](PostgresConnection& connection) { return connection.run_all(statements); });
  forget(attempt);
  for (std::size_t k = 0; k < fates.size(); ++k) {
    if (rows[k + 1].integer(0, 0) == 0) continue;
    publish({{.id = attempt.id, .state = fates[k].state}});
    return true;
  }
  with_connection(true, [&](PostgresConnection& connection) { take_back_losses(connection, {attempt}); });
  return false;
}

}  // namespace bahnwerk::server
