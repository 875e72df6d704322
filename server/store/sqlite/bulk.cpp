/// SqliteStore: calls that act on many jobs, a few hundred in each transaction.
#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {

std::size_t SqliteStore::for_all(JobFilter filter, Writer::Bytes adds,
                                 const std::function<bool(SqliteConnection&, const std::string& id)>& work) {
  std::size_t count = 0;
  for (filter.limit = max_expired_at_once;;) {
    const auto jobs = list(filter);
    if (jobs.empty()) return count;
    std::size_t changed = 0;
    writer_.run(
        [&](SqliteConnection& connection) {
          changed = 0;  // the transaction may be repeated
          for (const api::Job& job : jobs) changed += work(connection, job.id) ? 1 : 0;
        },
        adds);
    count += changed;
    filter.before = jobs.back().id;
  }
}

std::size_t SqliteStore::cancel_all(const JobFilter& filter, std::int64_t now) {
  std::size_t count = 0;
  for (const api::JobState state : {api::JobState::queued, api::JobState::running}) {
    if (filter.state && *filter.state != state) continue;
    JobFilter active = filter;
    active.state = state;
    count +=
        for_all(active, Writer::row * max_expired_at_once,
                [&](SqliteConnection& connection, const std::string& id) { return cancel_one(connection, id, now); });
  }
  return count;
}

std::size_t SqliteStore::remove_all(const JobFilter& filter) {
  return for_all(filter, Writer::frees, [&](SqliteConnection& connection, const std::string& id) {
    return remove_one(connection, id).outcome == Removed::yes;
  });
}

}  // namespace bahnwerk::server
