/// The keys in a PostgreSQL store: read by the store, written by commands beside it.
#include "server/runtime/clock.hpp"
#include "server/store/postgres/commands.hpp"
#include "server/store/postgres/migrate.hpp"
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {
namespace {

std::vector<Key> read_keys(const PostgresRows& rows) {
  std::vector<Key> keys;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Key key;
    key.id = rows.text(row, 0);
    key.name = rows.text(row, 1);
    const auto scopes = parse_scopes(rows.text(row, 2));
    if (!scopes) throw StoreError("store: unknown scopes " + rows.text(row, 2), false);
    key.scopes = *scopes;
    key.hash = rows.text(row, 3);
    key.max_queued = rows.optional_integer(row, 4);
    key.max_planning_ms = rows.optional_integer(row, 5);
    key.created_at = rows.time(row, 6);
    key.removed_at = rows.optional_time(row, 7);
    keys.push_back(std::move(key));
  }
  return keys;
}

constexpr auto all_keys =
    "SELECT id, name, scopes, hash, max_queued, max_planning_ms, created_at, removed_at FROM keys ORDER BY created_at, "
    "id";
constexpr auto new_version = "UPDATE key_version SET version = version + 1";

}  // namespace

std::optional<Keys> PostgresStore::keys(std::uint64_t known) {
  return reading([&](PostgresConnection& connection) -> std::optional<Keys> {
    Keys keys;
    keys.version = static_cast<std::uint64_t>(connection.run("SELECT version FROM key_version").integer(0, 0));
    if (keys.version == known) return std::nullopt;
    keys.list = read_keys(connection.run(all_keys));  // maybe with later changes: then they are read once more
    return keys;
  });
}

namespace postgres {

void add_key(const std::string& url, const Key& key) {
  PostgresConnection connection(url);
  migrate(connection);
  PostgresParameters values;
  (values << key.id << key.name << to_string(key.scopes) << key.hash << key.max_queued << key.max_planning_ms)
      .time(key.created_at);
  connection.run_all({{"INSERT INTO keys (id, name, scopes, hash, max_queued, max_planning_ms, created_at) VALUES "
                       "($1, $2, $3, $4, $5, $6, $7)",
                       std::move(values)},
                      {new_version}});
}

std::vector<Key> remove_keys(const std::string& url, const std::string& name_or_id) {
  PostgresConnection connection(url);
  migrate(connection);
  const auto rows = connection.run_all(
      {{"UPDATE keys SET removed_at = $2 WHERE removed_at IS NULL AND (name = $1 OR id = $1) RETURNING id, name, "
        "scopes, hash, max_queued, max_planning_ms, created_at, removed_at",
        (PostgresParameters() << name_or_id).time(now_ms())},
       {new_version}});
  return read_keys(rows[0]);
}

std::vector<Key> list_keys(const std::string& url, bool pooled) {
  PostgresConnection connection(url, {}, pooled ? PostgresSession::pooled : PostgresSession::own);
  if (postgres_version(connection) == 0) return {};
  return read_keys(connection.run(all_keys));
}

std::vector<std::string> inspect(const std::string& url) {
  PostgresConnection connection(url, {.lengthy = std::chrono::minutes(10)});
  if (postgres_version(connection) == 0) throw StoreError("there is no store in this database", false);
  std::vector<std::string> faults;
  const auto none = [&](const char* sql, const std::string& fault) {
    if (const auto count = connection.run_lengthy(sql).integer(0, 0); count > 0)
      faults.push_back(std::to_string(count) + " " + fault);
  };
  connection.script("SET statement_timeout = 0; BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY");
  none("SELECT count(*) FROM jobs WHERE NOT EXISTS (SELECT FROM specs WHERE specs.id = jobs.id)",
       "jobs without their document");
  none(
      "SELECT count(*) FROM jobs WHERE state = 'succeeded' AND NOT EXISTS (SELECT FROM results WHERE results.id = "
      "jobs.id)",
      "succeeded jobs without a result");
  none(
      "SELECT count(*) FROM results WHERE columns IS NOT NULL AND row_count <> (SELECT coalesce(sum(chunks.row_count), "
      "0) FROM chunks WHERE chunks.id = results.id AND chunks.token = results.token)",
      "results whose setpoints are not complete");
  none(
      "SELECT count(*) FROM jobs WHERE (state = 'running') <> EXISTS (SELECT FROM runs WHERE runs.id = jobs.id AND "
      "runs.token = jobs.token)",
      "jobs whose attempt does not match their state");
  none(
      "SELECT count(*) FROM (SELECT state, coalesce(owner, '') AS owner, count(*) AS jobs FROM jobs GROUP BY 1, 2) AS "
      "counted FULL JOIN (SELECT state, owner, sum(jobs) AS jobs FROM count_deltas GROUP BY 1, 2 HAVING sum(jobs) <> "
      "0) AS kept USING (state, owner) WHERE counted.jobs IS DISTINCT FROM kept.jobs",
      "states whose jobs are counted wrongly");
  connection.commit();
  return faults;
}

}  // namespace postgres
}  // namespace bahnwerk::server
