#pragma once
/// The daily partitions of documents, results, setpoints and views.
#include <cstdint>

namespace bahnwerk::server {

class PostgresConnection;

/// Makes the partitions of today and of the next two days (UTC, by the database's clock), and drops those whose
/// jobs are all gone. A day whose rows are in the default partition already gets none. Does nothing where another
/// process is doing it. Each is a transaction of its own, which gives up after 2 s where others use the table.
void keep_partitions(PostgresConnection& connection);

/// Makes the partitions of a day (since 1970 UTC), as keep_partitions() does, unless there are some.
void make_partitions(PostgresConnection& connection, std::int64_t day);

}  // namespace bahnwerk::server
