/// PostgresStore: requests of clients, to cancel and to remove.
#include "server/store/postgres/job_rows.hpp"
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {
namespace {

/// Fence: the state. READ COMMITTED, under the lock of the job's row.
constexpr auto ask_to_stop =
    "WITH job AS (UPDATE jobs SET cancel_requested = true WHERE id = $1 AND state = 'running' AND NOT cancel_requested "
    "RETURNING id, owner), told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job) SELECT count(*) FROM "
    "job";

/// Fence: the state. What the job leaves is swept later, or by whoever removed it.
constexpr auto remove_job =
    "WITH job AS (DELETE FROM jobs WHERE id = $1 AND state <> 'running' RETURNING id, owner, state, tags, token > 0 AS "
    "was_claimed), "
    "spec AS (DELETE FROM specs WHERE id = $1 AND EXISTS (SELECT FROM job)), "
    "result AS (DELETE FROM results WHERE id = $1 AND EXISTS (SELECT FROM job)), "
    "kept AS (DELETE FROM idempotency_keys WHERE id = $1 AND EXISTS (SELECT FROM job)), "
    "tagged AS (DELETE FROM job_tags AS t USING job WHERE t.owner IN ('', job.owner) AND t.tag = ANY (job.tags) AND "
    "t.id = job.id), "
    "left_over AS (INSERT INTO leftovers (id, token) SELECT id, 0 FROM job WHERE was_claimed ON CONFLICT DO NOTHING), "
    "told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job), "
    "counted AS (INSERT INTO count_deltas (state, owner, jobs) SELECT state, coalesce(owner, ''), -1 FROM job) "
    "SELECT count(*), coalesce(bool_or(was_claimed), false) FROM job";

}  // namespace

/// The lock comes first, so that no claim and no requeue falls between the two steps.
PostgresStore::Statements PostgresStore::cancel_of(const std::string& id, std::int64_t now) const {
  return {lock_of(id),
          statement_of({.id = id, .from = api::JobState::queued, .to = after_cancel(id), .now = now}),
          {ask_to_stop, PostgresParameters().uuid(id)}};
}

PostgresStatement PostgresStore::removal_of(const std::string& id) {
  return {remove_job, PostgresParameters().uuid(id)};
}

std::optional<api::Job> PostgresStore::cancel(const std::string& id, std::int64_t now) {
  const auto rows = writing([&](PostgresConnection& connection) { return connection.run_all(cancel_of(id, now)); });
  if (rows[1].integer(0, 0) == 1) publish({{.id = id, .state = api::JobState::cancelled}});
  if (rows[2].integer(0, 0) == 1) publish({{.id = id, .state = api::JobState::running, .cancel_requested = true}});
  return get(id, false);
}

Removed PostgresStore::remove(const std::string& id, const std::function<bool(const api::Job&)>& condition) {
  static const std::string look =
      std::string("SELECT ")
          .append(postgres_job_columns)
          .append(" FROM jobs AS j LEFT JOIN runs AS r ON r.id = j.id WHERE j.id = $1 FOR UPDATE OF j");
  bool leftovers = false;
  const Removed outcome = writing([&](PostgresConnection& connection) {
    if (condition) {  // asked under the lock of the job's row
      connection.begin();
      const auto rows = connection.run(look, PostgresParameters().uuid(id));
      if (rows.empty()) return Removed::unknown;
      const api::Job job = job_from(rows, 0);
      if (job.state != api::JobState::running && !condition(job)) return Removed::refused;
    }
    const auto rows = connection.run_all({lock_of(id), removal_of(id)});
    if (condition) connection.commit_briefly();
    leftovers = rows[1].flag(0, 1);
    return rows[0].empty() ? Removed::unknown : rows[1].integer(0, 0) == 1 ? Removed::yes : Removed::running;
  });
  if (outcome != Removed::yes) return outcome;
  publish({{.id = id, .state = std::nullopt}});
  try {
    while (leftovers && sweep(id, 0)) {
    }
  } catch (const StoreError&) {  // the job is gone; expire() sweeps the rest
  }
  return outcome;
}

std::size_t PostgresStore::for_all(
    JobFilter filter, const std::function<void(Statements&, const std::string& id)>& add,
    const std::function<std::optional<Changed>(const PostgresRows*, const std::string& id)>& told) {
  std::size_t count = 0;
  for (filter.limit = at_once;;) {
    const auto jobs = list(filter);
    if (jobs.empty()) return count;
    Statements statements;
    for (const api::Job& job : jobs) add(statements, job.id);
    const std::size_t each = statements.size() / jobs.size();
    const auto rows = writing([&](PostgresConnection& connection) { return connection.run_all_lengthy(statements); });
    std::vector<Changed> changes;
    for (std::size_t k = 0; k < jobs.size(); ++k)
      if (auto changed = told(&rows[k * each], jobs[k].id)) changes.push_back(std::move(*changed));
    publish(changes);
    count += changes.size();
    filter.before = jobs.back().id;
  }
}

std::size_t PostgresStore::cancel_all(const JobFilter& filter, std::int64_t now) {
  std::size_t count = 0;
  for (const api::JobState state : {api::JobState::queued, api::JobState::running}) {
    if (filter.state && *filter.state != state) continue;
    JobFilter active = filter;
    active.state = state;
    count += for_all(
        active,
        [&](Statements& statements, const std::string& id) {
          for (PostgresStatement& each : cancel_of(id, now)) statements.push_back(std::move(each));
        },
        [](const PostgresRows* rows, const std::string& id) -> std::optional<Changed> {
          if (rows[1].integer(0, 0) == 1) return Changed{.id = id, .state = api::JobState::cancelled};
          if (rows[2].integer(0, 0) == 1)
            return Changed{.id = id, .state = api::JobState::running, .cancel_requested = true};
          return std::nullopt;
        });
  }
  return count;
}

std::size_t PostgresStore::remove_all(const JobFilter& filter) {
  return for_all(
      filter, [](Statements& statements, const std::string& id) { statements.push_back(removal_of(id)); },
      [](const PostgresRows* rows, const std::string& id) -> std::optional<Changed> {
        return rows[0].integer(0, 0) == 1 ? std::optional(Changed{.id = id, .state = std::nullopt}) : std::nullopt;
      });
}

}  // namespace bahnwerk::server
