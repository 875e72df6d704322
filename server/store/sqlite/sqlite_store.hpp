#pragma once
/// The store in one SQLite file, owned by one process. Writes go through one thread with group commit, reads through
/// their own connections and never wait for a write (WAL).
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/runtime/uuid7.hpp"
#include "server/store/sqlite/connection.hpp"
#include "server/store/sqlite/file_lock.hpp"
#include "server/store/sqlite/job_cache.hpp"
#include "server/store/sqlite/reserve.hpp"
#include "server/store/sqlite/writer.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

struct SqliteOptions {
  std::string path;
  int max_pages = 0;        ///< > 0 caps the file's size in pages of 4 KiB: a full disk on demand
  std::size_t reserve = 0;  ///< bytes of disk set aside, so that a full disk can be emptied
  int max_attempts = 2;     ///< a job that was running when the process died so often ends as worker-lost
  Writer::Observer observer = [](double, std::size_t) {};
};

class SqliteStore final : public Store {
 public:
  /// Opens or creates; brings the schema up to date; puts orphaned `running` jobs back to `queued`. Throws StoreError
  /// with a sentence.
  explicit SqliteStore(SqliteOptions options);
  ~SqliteStore() override;

  void insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) override;
  std::optional<api::Job> at_hand(const std::string& id) override;
  std::optional<api::Job> get(const std::string& id, bool with_document) override;
  std::vector<api::Job> list(const JobFilter& filter) override;
  std::map<api::JobState, std::size_t> counts() override;
  void ping() override;
  std::optional<api::Job> claim(std::int64_t now) override;
  void progress(Progressed progress, std::function<void()> done) override;
  bool end(const std::string& id, int attempt, const Ending& ending) override;
  bool succeed(const std::string& id, int attempt, const api::PlannedJob& planned, std::int64_t now,
               std::uint64_t revision, Progress& progress) override;
  bool requeue(const std::string& id, int attempt, std::int64_t now, std::uint64_t revision) override;
  Expired expire(std::int64_t now) override;
  std::optional<api::Job> cancel(const std::string& id, std::int64_t now) override;
  bool cancel_requested(const std::string& id) override;
  Removed remove(const std::string& id) override;
  std::optional<std::string> result(const std::string& id) override;
  std::optional<SeriesInfo> series(const std::string& id) override;
  void read_chunk(const SeriesInfo& series, std::size_t first_row, std::vector<double>& out) override;
  void checkpoint() override;

 private:
  class Reader;  ///< a reading connection on loan
  Inserted insert_one(Connection& connection, const NewJob& job, const std::string& packed_document);
  void recover(std::int64_t now);
  /// Runs it on the writer, returns what it returned.
  bool write_flag(const std::function<bool(Connection&)>& work, Writer::Bytes adds);

  SqliteOptions options_;
  FileLock lock_;
  Connection connection_;  ///< the writer's
  Reserve reserve_;        ///< the writer's
  Uuid7 ids_;              ///< the writer's
  JobCache cache_;
  std::mutex readers_mutex_;
  std::vector<std::unique_ptr<Connection>> readers_;
  Writer writer_;  ///< last: its thread ends before anything it uses
};

}  // namespace bahnwerk::server
