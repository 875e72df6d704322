#include "server/store/postgres/postgres_store.hpp"

#include <algorithm>

#include "server/store/postgres/migrate.hpp"
#include "server/store/postgres/moving.hpp"
#include "server/store/postgres/partitions.hpp"
#include "server/store/postgres/post.hpp"
#include "server/store/postgres/requirements.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t own_connections = 2;  ///< that of leases, and that of signals

}  // namespace

PostgresStore::PostgresStore(PostgresOptions options)
    : options_(std::move(options)),
      state_(options_.patience.silence),
      listen_state_(options_.patience.silence, "signals"),
      connections_(options_.url, options_.patience,
                   std::max(options_.connections, own_connections + 2) - own_connections, state_, options_.session),
      leases_(options_.url, options_.patience, 1, state_, options_.session),
      listeners_(options_.listen_url.empty() ? options_.url : options_.listen_url, options_.patience, 1,
                 options_.listen_url.empty() ? state_ : listen_state_) {
  try {
    PostgresConnections::Borrowed connection(connections_);
    prepare(*connection);
  } catch (const StoreRefused&) {
    throw;
  } catch (const StoreError& error) {  // the first call that reaches it prepares it
    if (!error.busy) throw;
  }
  for (std::size_t k = 0; k < options_.writers; ++k) writers_.emplace_back([this] { write(); });
  if (options_.signals) signals_.emplace(listeners_, process_);
}

PostgresStore::~PostgresStore() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& writer : writers_) writer.join();
  signals_.reset();
  try {
    writing([&](PostgresConnection& connection) {
      return connection.run("DELETE FROM duties WHERE process = $1", PostgresParameters() << process_);
    });
  } catch (const std::exception&) {  // duties end in their time
  }
}

void PostgresStore::prepare(PostgresConnection& connection) {
  const std::lock_guard lock(prepare_mutex_);
  if (prepared_) return;
  require_capabilities(connection);
  options_.migrate ? migrate(connection) : require_up_to_date(connection);
  require_queue(connection);
  postgres::refuse_unfinished_move(connection);
  const auto last = connection.run("SELECT id FROM jobs ORDER BY id DESC LIMIT 1");
  if (!last.empty()) {
    const std::lock_guard ids_lock(ids_mutex_);
    ids_.advance_past(last.uuid(0, 0));
  }
  if (options_.migrate) keep_partitions(connection);  // that of today comes before its first row
  prepared_ = true;
}

/// Heartbeats are not waited for until they are on the disk, nor on a standby: after a crash of the server, and after
/// the promotion of a standby, the revision of a running job may be below one that clients have seen. So whoever
/// connects first raises it, before it reads anything, where no heartbeat has come since the server's start; the
/// attempt then counts as renewed at that start. A promotion leaves no time, but a new timeline: each process raises
/// all revisions once when it meets one. A process that begins knows of the first timeline alone.
void PostgresStore::raise_revisions(PostgresConnection& connection) {
  if (options_.times_of_callers) return connection.use();
  if (connection.read_only()) connection.run("SELECT 1");  // it says whether it has been promoted
  if (connection.read_only()) return;
  const std::lock_guard lock(timeline_mutex_);
  const std::int64_t timeline =
      connection.run("SELECT ('x' || left(pg_walfile_name(pg_current_wal_insert_lsn()), 8))::bit(32)::int::bigint")
          .integer(0, 0);
  connection.run(
      "UPDATE runs SET revision = revision + $1, lease_until = greatest(lease_until, pg_postmaster_start_time() + "
      "lease_ms * interval '1 ms') WHERE $2 <> $3 OR lease_until - lease_ms * interval '1 ms' < "
      "pg_postmaster_start_time()",
      PostgresParameters() << lost_leap << timeline << timeline_);
  timeline_ = timeline;
  connection.use();
}

void PostgresStore::listen(std::function<void(const std::vector<Changed>&)> call) {
  const std::lock_guard lock(listener_mutex_);
  listener_ = std::move(call);
}

void PostgresStore::listen_to_others(std::function<void()> call) {
  if (signals_) signals_->listen(std::move(call));
}

void PostgresStore::publish(const std::vector<Changed>& changes) {
  if (changes.empty()) return;
  if (std::any_of(changes.begin(), changes.end(), [](const Changed& c) { return c.state == api::JobState::queued; }))
    ++queue_changes_;
  if (signals_) signals_->tell();
  const std::lock_guard lock(listener_mutex_);
  if (listener_) listener_(changes);
}

}  // namespace bahnwerk::server
