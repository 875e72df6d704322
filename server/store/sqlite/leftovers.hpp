#pragma once
/// Rows of setpoints, and their views, whose job was removed, or whose attempt ended without them. A long series has
/// hundreds of megabytes: it is freed in pieces, each in a transaction of its own, so that other writes proceed in
/// between.
#include <cstdint>
#include <optional>
#include <string>

namespace bahnwerk::server {

class SqliteConnection;

/// Marks the stored rows of the job, if there are any, as left over.
void leave_chunks(SqliteConnection& connection, const std::string& id);
bool has_leftovers(SqliteConnection& connection, std::int64_t seq);
/// Returns the series that is freed next.
std::optional<std::int64_t> next_leftovers(SqliteConnection& connection);
/// Frees about 2 MB of the series; returns whether there are more.
bool free_leftovers(SqliteConnection& connection, std::int64_t seq);

}  // namespace bahnwerk::server
