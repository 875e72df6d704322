/// SqliteStore: the outbox of callbacks. A trigger of the database makes a callback due when its job ends.
#include "server/store/sqlite/reader.hpp"
#include "server/store/sqlite/rows.hpp"

namespace bahnwerk::server {

std::vector<std::pair<std::string, std::int64_t>> SqliteStore::callback_receivers() {
  Reader reader(*this);
  // From each receiver to the next one in the index: the cost does not depend on the number of callbacks.
  Query rows = reader.query(
      "WITH RECURSIVE names (receiver) AS ("
      "SELECT min(callback_receiver) FROM jobs WHERE callback_due IS NOT NULL UNION ALL "
      "SELECT (SELECT min(callback_receiver) FROM jobs WHERE callback_due IS NOT NULL AND callback_receiver > "
      "receiver) "
      "FROM names WHERE receiver IS NOT NULL) "
      "SELECT receiver, "
      "(SELECT min(callback_due) FROM jobs WHERE callback_due IS NOT NULL AND callback_receiver = receiver) AS due "
      "FROM names WHERE receiver IS NOT NULL ORDER BY due");
  std::vector<std::pair<std::string, std::int64_t>> receivers;
  while (rows.step()) receivers.emplace_back(rows.text(0), rows.integer(1));
  return receivers;
}

std::vector<DueCallback> SqliteStore::due_callbacks(const std::string& receiver, std::int64_t now, std::size_t limit) {
  static const std::string sql = std::string("SELECT ") + job_columns +
                                 ", callback_secret FROM jobs WHERE callback_due IS NOT NULL AND callback_receiver = ? "
                                 "AND callback_due <= ? ORDER BY callback_due LIMIT ?";
  Reader reader(*this);
  Query rows = reader.query(sql);
  rows << receiver << now << static_cast<std::int64_t>(limit);
  std::vector<DueCallback> due;
  while (rows.step()) due.push_back({job_from_row(rows), rows.optional_text(job_seq_column + 1).value_or("")});
  return due;
}

void SqliteStore::called_back(const CallbackAttempt& attempt) {
  const auto delivered = attempt.error ? std::nullopt : std::optional(attempt.now);
  writer_.run([&](SqliteConnection& connection) {
    const std::int64_t change = changes_.next();
    Query recorded = connection.query(
        "UPDATE jobs SET callback_attempts = callback_attempts + 1, callback_due = ?, callback_delivered = ?, "
        "callback_error = ?, revision = revision + 1, changed = ? WHERE id = ? AND callback_due IS NOT NULL "
        "RETURNING state");
    recorded << attempt.next_at << delivered << attempt.error << change << attempt.id;
    if (!recorded.step()) return;
    changes_.note(change, attempt.id, api::job_state(recorded.text(0)));
    recorded.step();
  });
}

}  // namespace bahnwerk::server
