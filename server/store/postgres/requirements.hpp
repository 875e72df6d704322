#pragma once
/// What the store needs of its PostgreSQL server beside its version, asked for once at the start: servers that speak
/// the same protocol need not have all of it.

namespace bahnwerk::server {

class PostgresConnection;

/// Throws StoreRefused, with all that is missing and why, unless the server has snapshots of transactions and advisory
/// locks of transactions. Needs no schema.
void require_capabilities(PostgresConnection& connection);
/// The same for what claims need, SKIP LOCKED; the schema has to be there.
void require_queue(PostgresConnection& connection);

}  // namespace bahnwerk::server
