#pragma once
/// Numbers the changes of the writer, and reports them to the listener after the commit.
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "server/store/changes.hpp"

namespace bahnwerk::server {

class SqliteConnection;

/// Numbers of changes. The writer's thread uses them; any thread may call listen(). One writer commits one transaction
/// after the other, so numbers become visible in their order; those of a failed transaction are not used again.
class ChangeLog {
 public:
  void open(SqliteConnection& connection);  ///< continues after the last number in the database
  void begin() { pending_.clear(); }        ///< a transaction begins, perhaps in place of one that failed
  std::int64_t next() { return ++last_; }
  /// Records that the job now has change `number` (from next).
  void note(std::int64_t number, const std::string& id, std::optional<api::JobState> state, bool cancelled = false);
  void committed();
  void listen(std::function<void(const std::vector<Changed>&)> call);

 private:
  std::int64_t last_ = 0;
  std::vector<Changed> pending_;
  std::mutex mutex_;
  std::function<void(const std::vector<Changed>&)> listener_;
};

/// Implements ChangeSource's queries on any connection to the database.
Changes changes_since(SqliteConnection& connection, std::uint64_t sequence, std::size_t limit,
                      const std::optional<std::string>& owner);
std::uint64_t last_change(SqliteConnection& connection);
/// Records within a transaction that the job's row was removed, with this number.
void keep_removal(SqliteConnection& connection, std::int64_t number, const std::string& id,
                  const std::optional<std::string>& owner);

}  // namespace bahnwerk::server
