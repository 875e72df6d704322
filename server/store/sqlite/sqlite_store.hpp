#pragma once
/// The store in one SQLite file, owned by one process. Writes use one thread with group commit; reads use their own
/// connections and never wait for a write (WAL). The process that opens the file has its lock, so all earlier leases
/// are void.
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "api/engine_level.hpp"
#include "server/runtime/uuid7.hpp"
#include "server/store/packed_text.hpp"
#include "server/store/rules.hpp"
#include "server/store/sqlite/change_log.hpp"
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
  Retention retention = {};
  bool migrate = true;             ///< whether an older schema is brought up to date, or refused
  std::string planned_by = {};     ///< version of the program, which jobs keep that it has ended
  int engine = api::engine_level;  ///< jobs that need a higher one are left in the queue
  Writer::Observer observer = [](double, std::size_t) {};
};

class SqliteStore final : public Store {
 public:
  /// Opens or creates the file and brings the schema up to date; all running jobs have lost their attempts. Throws
  /// StoreError with a sentence for the operator.
  explicit SqliteStore(SqliteOptions options);
  ~SqliteStore() override;

  bool shared() const override { return false; }
  void listen(std::function<void(const std::vector<Changed>&)> call) override { changes_.listen(std::move(call)); }
  Changes changes_since(std::uint64_t sequence, std::size_t limit, const std::optional<std::string>& owner) override;
  std::uint64_t last_change() override;

  void insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) override;
  std::optional<api::Job> at_hand(const std::string& id) override;
  std::optional<api::Job> get(const std::string& id, bool with_document) override;
  std::vector<api::Job> list(const JobFilter& filter) override;
  std::vector<std::string> queue(std::size_t limit) override;
  std::map<api::JobState, std::size_t> counts(const std::optional<std::string>& owner) override;
  std::vector<Running> running() override;
  StoreStatus status() override;
  void ping() override;
  std::optional<api::Job> claim(const Lease& lease) override;
  std::vector<Held> heartbeat(const Lease& lease, const std::vector<Progressed>& attempts) override;
  bool end(const Attempt& attempt, const Ending& ending) override;
  bool succeed(const Attempt& attempt, const api::PlannedJob& planned, std::int64_t now, const SeenRevision& seen,
               Progress progress) override;
  bool requeue(const Attempt& attempt, std::int64_t now, std::uint64_t revision) override;
  Expired expire(std::int64_t now) override;
  std::vector<std::pair<std::string, std::int64_t>> callback_receivers() override;
  std::vector<DueCallback> due_callbacks(const std::string& receiver, std::int64_t now, std::size_t limit) override;
  void called_back(const CallbackAttempt& attempt) override;
  std::optional<api::Job> cancel(const std::string& id, std::int64_t now) override;
  bool cancel_requested(const std::string& id) override;
  using Store::remove;
  Removed remove(const std::string& id, const std::function<bool(const api::Job&)>& condition) override;
  std::size_t cancel_all(const JobFilter& filter, std::int64_t now) override;
  std::size_t remove_all(const JobFilter& filter) override;
  std::unique_ptr<StoredText> open_document(const std::string& id) override;
  std::unique_ptr<StoredText> open_result(const std::string& id) override;
  std::optional<SeriesInfo> series(const std::string& id) override;
  void read_chunk(const SeriesInfo& series, std::size_t first_row, std::vector<double>& out) override;
  std::optional<std::string> read_view(const SeriesInfo& series, std::string_view name, std::size_t part) override;
  void put_views(const SeriesInfo& series, const std::vector<api::ViewPart>& parts, bool last) override;
  std::optional<Keys> keys(std::uint64_t known) override;
  void checkpoint();  ///< empties the file's log, as the end does, too

 private:
  class Reader;  ///< a borrowed reading connection
  static constexpr std::size_t max_expired_at_once =
      256;  ///< largest number of expired jobs per transaction, since others wait for it
  PackedPart part_of(BlobColumn column, std::int64_t seq);  ///< reads parts of a text in a column
  Inserted insert_one(SqliteConnection& connection, const NewJob& job, const std::string& packed_document);
  void recover(std::int64_t now);
  /// Ends the attempts of running jobs whose lease ended before or at `until`, at most `most`; returns their jobs.
  std::vector<std::string> lose(SqliteConnection& connection, std::int64_t until, std::int64_t now, std::size_t most);
  /// The step of a job out of the queue or out of its attempt, but for those of claim and succeed.
  struct Step {
    std::string id;
    api::JobState from;
    std::optional<std::int64_t> token = {};  ///< token of the attempt that the step is conditional on
    Fate to;
    std::int64_t now = 0;
    std::uint64_t seen = 0;                      ///< last revision that clients were shown
    std::int64_t leap = 1;                       ///< increase of the revision
    std::int64_t not_made = 0;                   ///< attempts that are not counted
    std::optional<std::string> planned_by = {};  ///< version of the program, where a call of the attempt ends the job
  };
  /// Makes the step within a transaction; returns false, without a change, if the job is in another state or attempt.
  bool leave(SqliteConnection& connection, const Step& step);
  /// Returns whether a call of the attempt has ended its job in that state.
  static bool ended(SqliteConnection& connection, const Attempt& attempt, api::JobState state);
  /// Takes back the loss of an attempt whose worker lives, where it counts.
  static void take_back_loss(SqliteConnection& connection, const Attempt& attempt);
  /// Cancels the job within a transaction; returns whether that changed it.
  bool cancel_one(SqliteConnection& connection, const std::string& id, std::int64_t now);
  struct Gone {
    Removed outcome = Removed::unknown;
    std::int64_t seq = 0;
    std::optional<std::string> owner = {};
  };
  /// Removes the job within a transaction; its setpoints become leftovers.
  Gone remove_one(SqliteConnection& connection, const std::string& id);
  /// Calls `work` within transactions for a few hundred matching jobs at a time; returns how often it was true.
  std::size_t for_all(JobFilter filter, Writer::Bytes adds,
                      const std::function<bool(SqliteConnection&, const std::string& id)>& work);
  /// Returns ended jobs that the retention does not keep, what ended first first, at most `most`.
  std::vector<std::string> too_old(SqliteConnection& connection, std::int64_t now, std::size_t most) const;
  /// Returns how many free pages are to be given back to the disk; 0 where the file cannot shrink.
  std::int64_t spare_pages(SqliteConnection& connection) const;
  /// Frees a piece of a series that was left over; returns whether there are more.
  bool free_piece(std::int64_t seq);
  /// Runs `work` on the writer and returns its result.
  bool write_flag(const std::function<bool(SqliteConnection&)>& work, Writer::Bytes adds);

  SqliteOptions options_;
  FileLock lock_;                ///< of a file beside the database, which names the owner
  FileLock file_lock_;           ///< of the database itself, whatever name it was opened by
  SqliteConnection connection_;  ///< connection of the writer's thread
  Reserve reserve_;              ///< reserve of the writer's thread
  Uuid7 ids_;                    ///< ids of the writer's thread
  ChangeLog changes_;            ///< change log of the writer's thread
  JobCache cache_;
  std::mutex readers_mutex_;
  std::vector<std::unique_ptr<SqliteConnection>> readers_;
  Writer writer_;  ///< the last member: its thread ends before the members that it uses
};

}  // namespace bahnwerk::server
