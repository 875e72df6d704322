#include "server/store/sqlite/leftovers.hpp"

#include "server/store/sqlite/connection.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::int64_t piece_bytes = 2 << 20;

}  // namespace

void leave_chunks(SqliteConnection& connection, const std::string& id) {
  (connection.query("INSERT OR IGNORE INTO leftovers (seq) SELECT seq FROM jobs "
                    "WHERE id = ? AND EXISTS (SELECT 1 FROM chunks WHERE chunks.seq = jobs.seq)")
   << id)
      .run();
}

bool has_leftovers(SqliteConnection& connection, std::int64_t seq) {
  Query row = connection.query("SELECT 1 FROM leftovers WHERE seq = ?");
  row << seq;
  return row.step();
}

std::optional<std::int64_t> next_leftovers(SqliteConnection& connection) {
  Query row = connection.query("SELECT seq FROM leftovers LIMIT 1");
  return row.step() ? std::optional(row.integer(0)) : std::nullopt;
}

bool free_leftovers(SqliteConnection& connection, std::int64_t seq) {
  std::int64_t last = -1, bytes = 0;
  {
    Query rows = connection.query("SELECT first_row, length(data) FROM chunks WHERE seq = ? ORDER BY first_row");
    rows << seq;
    while (bytes < piece_bytes && rows.step()) {
      last = rows.integer(0);
      bytes += rows.integer(1);
    }
  }
  (connection.query("DELETE FROM chunks WHERE seq = ? AND first_row <= ?") << seq << last).run();
  if (bytes >= piece_bytes) return true;
  (connection.query("DELETE FROM leftovers WHERE seq = ?") << seq).run();
  return false;
}

}  // namespace bahnwerk::server
