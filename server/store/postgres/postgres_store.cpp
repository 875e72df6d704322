#include "server/store/postgres/postgres_store.hpp"

#include "server/store/postgres/migrate.hpp"
#include "server/store/postgres/post.hpp"

namespace bahnwerk::server {

PostgresStore::PostgresStore(PostgresOptions options)
    : options_(std::move(options)), connections_(options_.url, options_.patience, options_.connections) {
  {
    PostgresConnections::Borrowed connection(connections_);
    migrate(*connection);
    const auto last = connection->run("SELECT id FROM jobs ORDER BY id DESC LIMIT 1");
    if (!last.empty()) ids_.advance_past(last.uuid(0, 0));
  }
  maintain();  // the partition of today comes before its first row
  for (std::size_t k = 0; k < options_.writers; ++k) writers_.emplace_back([this] { write(); });
}

PostgresStore::~PostgresStore() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& writer : writers_) writer.join();
  try {
    writing([&](PostgresConnection& connection) {
      return connection.run("DELETE FROM duties WHERE process = $1", PostgresParameters() << process_);
    });
  } catch (const std::exception&) {  // duties end in their time
  }
}

void PostgresStore::listen(std::function<void(const std::vector<Changed>&)> call) {
  const std::lock_guard lock(listener_mutex_);
  listener_ = std::move(call);
}

void PostgresStore::publish(const std::vector<Changed>& changes) {
  if (changes.empty()) return;
  const std::lock_guard lock(listener_mutex_);
  if (listener_) listener_(changes);
}

}  // namespace bahnwerk::server
