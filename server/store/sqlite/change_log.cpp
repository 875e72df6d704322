#include "server/store/sqlite/change_log.hpp"

#include "server/store/rules.hpp"
#include "server/store/sqlite/connection.hpp"
#include "server/store/values.hpp"

namespace bahnwerk::server {
void ChangeLog::open(SqliteConnection& connection) { last_ = static_cast<std::int64_t>(last_change(connection)); }

void ChangeLog::note(std::int64_t number, const std::string& id, std::optional<api::JobState> state, bool cancelled) {
  pending_.push_back({static_cast<std::uint64_t>(number), id, state, cancelled, 0});
}

void ChangeLog::committed() {
  if (pending_.empty()) return;
  const std::lock_guard lock(mutex_);
  if (listener_) listener_(pending_);
  pending_.clear();
}

void ChangeLog::listen(std::function<void(const std::vector<Changed>&)> call) {
  const std::lock_guard lock(mutex_);
  listener_ = std::move(call);
}

std::uint64_t last_change(SqliteConnection& connection) {
  // The last removal is always stored, so no number is used twice.
  Query row = connection.query(
      "SELECT max(coalesce((SELECT max(changed) FROM jobs WHERE changed > 0), 0), "
      "coalesce((SELECT max(changed) FROM removals), 0))");
  row.step();
  return static_cast<std::uint64_t>(row.integer(0));
}

Changes changes_since(SqliteConnection& connection, std::uint64_t sequence, std::size_t limit,
                      const std::optional<std::string>& owner) {
  Changes changes;
  const auto from = static_cast<std::int64_t>(sequence);
  Query rows = connection.query(
      "SELECT changed, id, state, cancel_requested, revision, (SELECT n > 1 AND changed > ?1 FROM removals ORDER BY n "
      "LIMIT 1) FROM jobs WHERE changed > 0 AND changed > ?1 AND (?2 IS NULL OR owner = ?2) UNION ALL "
      "SELECT changed, id, NULL, 0, 0, (SELECT n > 1 AND changed > ?1 FROM removals ORDER BY n LIMIT 1) FROM removals "
      "WHERE changed > ?1 AND (?2 IS NULL OR owner = ?2) ORDER BY changed LIMIT ?3");
  rows << from << owner << static_cast<std::int64_t>(limit);
  while (rows.step()) {
    Changed changed;
    changed.sequence = static_cast<std::uint64_t>(rows.integer(0));
    changed.id = rows.text(1);
    if (!rows.null(2)) {
      changed.state = api::job_state(rows.text(2));
      if (!changed.state) throw StoreError("store: unknown state " + rows.text(2), false);
    }
    changed.cancel_requested = changed.state == api::JobState::running && rows.integer(3) != 0;
    changed.revision = static_cast<std::uint64_t>(rows.integer(4));
    changes.gap = rows.integer(5) != 0;
    changes.list.push_back(std::move(changed));
  }
  return changes;
}

void keep_removal(SqliteConnection& connection, std::int64_t number, const std::string& id,
                  const std::optional<std::string>& owner) {
  Query kept = connection.query("INSERT INTO removals (changed, id, owner) VALUES (?, ?, ?) RETURNING n");
  kept << number << id << owner;
  kept.step();
  const std::int64_t n = kept.integer(0);
  kept.step();
  (connection.query("DELETE FROM removals WHERE n <= ?") << n - kept_removals).run();
}

}  // namespace bahnwerk::server
