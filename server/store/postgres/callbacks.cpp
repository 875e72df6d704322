/// PostgresStore: the outbox of callbacks. The statement that ends a job makes its callback due. One process delivers
/// them, for all: its duty is renewed while it looks, and passes to another a minute after its last look.
#include "server/store/postgres/job_rows.hpp"
#include "server/store/postgres/postgres_store.hpp"

namespace bahnwerk::server {

std::vector<std::pair<std::string, std::int64_t>> PostgresStore::callback_receivers() {
  // From each receiver to the next one in the index: the cost does not depend on the number of callbacks.
  const auto rows = with_connection(true, [&](PostgresConnection& connection) -> PostgresRows {
    const auto receivers = connection.run(
        "WITH RECURSIVE names (receiver) AS ("
        "SELECT min(callback_receiver) FROM jobs WHERE callback_due IS NOT NULL UNION ALL "
        "SELECT (SELECT min(callback_receiver) FROM jobs WHERE callback_due IS NOT NULL AND callback_receiver > "
        "receiver) FROM names WHERE receiver IS NOT NULL) "
        "SELECT receiver, (SELECT min(callback_due) FROM jobs WHERE callback_due IS NOT NULL AND callback_receiver = "
        "receiver) AS due FROM names WHERE receiver IS NOT NULL ORDER BY due");
    if (receivers.empty()) return receivers;
    const auto mine = connection.run(
        "SELECT 1 FROM duties WHERE name = 'callbacks' AND process = $1 AND until > clock_timestamp() + interval "
        "'30 s'",
        PostgresParameters() << process_);
    if (!mine.empty()) return receivers;
    const auto taken = connection.run(
        "INSERT INTO duties (name, process, until) VALUES ('callbacks', $1, clock_timestamp() + interval '60 s') "
        "ON CONFLICT (name) DO UPDATE SET process = excluded.process, until = excluded.until WHERE duties.process = $1 "
        "OR duties.until < clock_timestamp() RETURNING 1",
        PostgresParameters() << process_);
    return taken.empty() ? PostgresRows() : receivers;
  });
  std::vector<std::pair<std::string, std::int64_t>> receivers;
  for (std::size_t row = 0; row < rows.size(); ++row) receivers.emplace_back(rows.text(row, 0), rows.time(row, 1));
  return receivers;
}

std::vector<DueCallback> PostgresStore::due_callbacks(const std::string& receiver, std::int64_t now,
                                                      std::size_t limit) {
  static const std::string sql =
      std::string("SELECT ")
          .append(postgres_job_columns)
          .append(
              ", j.callback_secret FROM jobs AS j LEFT JOIN runs AS r ON r.id = j.id WHERE callback_due IS NOT "
              "NULL AND callback_receiver = $1 AND callback_due <= $2 ORDER BY callback_due, j.id LIMIT $3");
  const auto rows = reading([&](PostgresConnection& connection) {
    PostgresParameters values;
    (values << receiver).time(now) << static_cast<std::int64_t>(limit);
    return connection.run(sql, values);
  });
  std::vector<DueCallback> due;
  for (std::size_t row = 0; row < rows.size(); ++row)
    due.push_back({job_from(rows, row), rows.optional_text(row, postgres_job_column_count).value_or("")});
  return due;
}

void PostgresStore::called_back(const CallbackAttempt& attempt) {
  const auto delivered = attempt.error ? std::nullopt : std::optional(attempt.now);
  const auto rows = writing([&](PostgresConnection& connection) {
    PostgresParameters values;
    values.uuid(attempt.id).time(attempt.next_at).time(delivered) << attempt.error;
    return connection.run(
        "WITH job AS (UPDATE jobs SET callback_attempts = callback_attempts + 1, callback_due = $2, "
        "callback_delivered = $3, callback_error = $4, revision = revision + 1 WHERE id = $1 AND callback_due IS NOT "
        "NULL RETURNING id, owner, state), told AS (INSERT INTO changes (id, owner) SELECT id, owner FROM job) "
        "SELECT state FROM job",
        values);
  });
  if (!rows.empty()) publish({{.id = attempt.id, .state = api::job_state(rows.text(0, 0))}});
}

}  // namespace bahnwerk::server
