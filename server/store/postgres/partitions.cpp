#include "server/store/postgres/partitions.hpp"

#include <set>
#include <string>

#include "server/runtime/uuid7.hpp"
#include "server/store/postgres/locks.hpp"

namespace bahnwerk::server {
namespace {

constexpr const char* tables[] = {"specs", "results", "chunks", "views"};
constexpr std::int64_t days_ahead = 2;

/// Runs a script that others' locks, or rows in the default partition, may be in the way of; returns whether it was
/// carried out.
bool attempt(PostgresConnection& connection, const std::string& script) {
  try {
    connection.begin();
    if (!try_lock(connection, PostgresLock::migration)) {
      connection.rollback();
      return false;
    }
    connection.script(script);
    connection.commit();
    return true;
  } catch (const StoreAway&) {
    throw;
  } catch (const StoreError&) {
    connection.rollback();
    return false;
  }
}

std::string partition(const std::string& table, std::int64_t day) { return table + "_" + std::to_string(day); }

std::string begin(std::int64_t day) { return first_id(day * ms_per_day); }

}  // namespace

void make_partitions(PostgresConnection& connection, std::int64_t day) {
  if (!connection
           .run("SELECT 1 WHERE to_regclass($1) IS NOT NULL", PostgresParameters()
                                                                  << "bahnwerk." + partition("specs", day))
           .empty())
    return;
  std::string script;
  for (const char* const table : tables) {
    const std::string name = partition(table, day);
    script.append("CREATE TABLE ").append(name).append(" (LIKE ").append(table).append(" INCLUDING ALL); ");
    script.append("ALTER TABLE ").append(table).append(" ATTACH PARTITION ").append(name);
    script.append(" FOR VALUES FROM ('").append(begin(day)).append("') TO ('").append(begin(day + 1)).append("'); ");
  }
  attempt(connection, script);
}

void keep_partitions(PostgresConnection& connection) {
  const std::int64_t today =
      connection.run("SELECT floor(extract(epoch FROM clock_timestamp()) / 86400)::bigint").integer(0, 0);
  const auto rows = connection.run(
      "SELECT substr(c.relname, 7)::bigint FROM pg_inherits AS i JOIN pg_class AS c ON c.oid = i.inhrelid WHERE "
      "i.inhparent = 'bahnwerk.specs'::regclass AND c.relname ~ '^specs_[0-9]+$'");
  std::set<std::int64_t> days;
  for (std::size_t row = 0; row < rows.size(); ++row) days.insert(rows.integer(row, 0));
  for (std::int64_t day = today; day <= today + days_ahead; ++day)
    if (!days.contains(day)) make_partitions(connection, day);
  for (const std::int64_t day : days) {
    if (day >= today - days_ahead) break;
    PostgresParameters bounds;
    bounds.uuid(begin(day)).uuid(begin(day + 1));
    if (!connection.run("SELECT 1 FROM jobs WHERE id >= $1 AND id < $2 LIMIT 1", bounds).empty()) continue;
    std::string script;
    for (const char* const table : tables) script.append("DROP TABLE ").append(partition(table, day)).append("; ");
    attempt(connection, script);
  }
}

}  // namespace bahnwerk::server
