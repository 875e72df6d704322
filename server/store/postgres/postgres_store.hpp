#pragma once
/// The store in a PostgreSQL database (schema `bahnwerk`), which any number of processes share. All transactions are
/// READ COMMITTED; what a call decides on is locked, or a condition of the statement that writes. Rows of `jobs` are
/// locked before those of `runs`. The state machine is that of rules.hpp.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "api/engine_level.hpp"
#include "server/runtime/uuid7.hpp"
#include "server/store/packed_text.hpp"
#include "server/store/postgres/connections.hpp"
#include "server/store/postgres/signals.hpp"
#include "server/store/rules.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

struct SeriesPiece;

struct PostgresOptions {
  std::string url;
  Retention retention = {};
  std::function<void(double, std::size_t)> observer = [](double, std::size_t) {};  ///< seconds and posts of a commit
  PostgresPatience patience = {};
  std::size_t connections =
      8;                    ///< most connections of the process: one for leases, one for signals, the others for all
  std::size_t writers = 2;  ///< threads that commit posted jobs
  bool signals = true;      ///< whether processes tell each other of changes (LISTEN, NOTIFY)
  PostgresSession session = PostgresSession::own;
  std::string listen_url = {};  ///< where signals come from, which a pooler does not pass on; empty: `url`
  /// Called, from any thread and maybe again, where a server that was away at the start refuses this process, or has a
  /// store that is too new for the program.
  std::function<void(const std::string&)> refused = [](const std::string&) {};
  /// Called, from any thread, with the jobs whose attempt a claim has found lost; expire() returns those that it finds.
  std::function<void(const std::vector<std::string>&)> lost = [](const std::vector<std::string>&) {};
  bool migrate = true;          ///< whether an older schema is brought up to date and partitions are made, or refused
  std::string planned_by = {};  ///< version of the program, which jobs keep that it has ended
  int engine = api::engine_level;  ///< jobs that need a higher one are left to others
  /// Whether leases and deadlines are measured by the times that callers give, for tests. Otherwise the database's
  /// clock is the one of all processes.
  bool times_of_callers = false;
};

class PostgresStore final : public Store {
 public:
  /// Connects and brings the schema up to date; where the server is away, the first call that reaches it does. Throws
  /// StoreRefused, with a sentence for the operator, where waiting does not help.
  explicit PostgresStore(PostgresOptions options);
  ~PostgresStore() override;

  bool shared() const override { return true; }
  void listen(std::function<void(const std::vector<Changed>&)> call) override;
  void listen_to_others(std::function<void()> call) override;
  Changes changes_since(std::uint64_t sequence, std::size_t limit, const std::optional<std::string>& owner) override;
  std::uint64_t last_change() override;

  void insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) override;
  std::optional<api::Job> get(const std::string& id, bool with_document) override;
  std::vector<api::Job> list(const JobFilter& filter) override;
  std::vector<std::string> queue(std::size_t limit) override;
  std::map<api::JobState, std::size_t> counts(const std::optional<std::string>& owner) override;
  std::vector<Running> running() override;
  StoreStatus status() override;
  StoreState state() const override { return state_.now(); }
  StoreConnections connections() const override { return connections_.counts(); }
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

 private:
  using Statements = std::vector<PostgresStatement>;
  static constexpr std::size_t at_once = 256;  ///< largest number of jobs that a transaction ends or removes
  /// A posted job on its way into the database. Its id was given before, so that a commit whose answer is lost can be
  /// asked for again.
  struct Post;
  /// A place in the queue, in whose order jobs are claimed; before all of them unless said otherwise.
  struct QueuePlace {
    std::int64_t rank = std::numeric_limits<std::int32_t>::min(), turn = std::numeric_limits<std::int64_t>::min();
    std::string id = "00000000-0000-0000-0000-000000000000";
    bool operator==(const QueuePlace&) const = default;
  };
  /// The step of a job out of the queue or out of its attempt.
  struct Step {
    std::string id;
    api::JobState from;
    std::optional<std::int64_t> token = {};     ///< token of the attempt that the step is conditional on
    std::optional<bool> cancel_requested = {};  ///< what it is conditional on, too
    Fate to;
    std::int64_t now = 0;
    std::uint64_t seen = 0;                      ///< last revision that clients were shown
    std::int64_t leap = 1;                       ///< increase of the revision
    std::int64_t not_made = 0;                   ///< attempts that are not counted
    std::optional<std::int64_t> losses = {};     ///< losses after a lost attempt
    std::optional<std::string> ended_by = {};    ///< name of the call
    std::optional<std::string> result = {};      ///< packed result document
    std::optional<std::string> planned_by = {};  ///< version of the program that planned
  };

  /// Calls `work` with a connection. It is called again where two transactions were in each other's way, or, if `again`
  /// says that this is safe, on another connection where the first one was lost.
  template <class Work>
  auto with_connection(bool again, Work&& work) {
    return with_connection_of(connections_, again, std::forward<Work>(work));
  }
  template <class Work>
  auto with_connection_of(PostgresConnections& connections, bool again, Work&& work);
  template <class Work>
  auto reading(Work&& work) {
    return with_connection(true, std::forward<Work>(work));
  }
  template <class Work>
  auto writing(Work&& work) {
    return with_connection(false, std::forward<Work>(work));
  }

  /// Returns the time by which statements measure: the caller's, or none for the database's.
  std::optional<std::int64_t> clock(std::int64_t now) const {
    return options_.times_of_callers ? std::optional(now) : std::nullopt;
  }
  void prepare(PostgresConnection& connection);
  void raise_revisions(PostgresConnection& connection);
  void publish(const std::vector<Changed>& changes);
  void forget(const Attempt& attempt);  ///< the attempt is over
  std::vector<std::string> given();     ///< returns the jobs of given_
  std::optional<api::Job> adopt(PostgresConnection& connection, const std::string& worker);
  std::uint64_t number_changes(PostgresConnection& connection);
  std::uint64_t numbered(PostgresConnection& connection);

  void write();
  void store_posts(std::vector<Post>& group);
  void store_group(PostgresConnection& connection, std::vector<Post*> group);
  PostgresStatement statement_of(std::span<Post* const> posts) const;
  std::optional<std::size_t> queued_count(std::size_t posts, std::size_t most);
  std::size_t counted(std::size_t queued);
  void counted_more(std::size_t posts);

  PostgresStatement statement_of(const Step& step) const;
  static PostgresStatement lock_of(const std::string& id);
  /// Returns whether a call of the attempt has ended its job in that state.
  static bool ended(PostgresConnection& connection, const Attempt& attempt, api::JobState state);
  /// Takes back the losses of attempts whose workers live, where they count.
  static void take_back_losses(PostgresConnection& connection, const std::vector<Attempt>& attempts);
  Statements cancel_of(const std::string& id, std::int64_t now) const;
  static PostgresStatement removal_of(const std::string& id);
  void store_piece(Statements& statements, const Attempt& attempt, const SeriesPiece& piece) const;
  std::vector<std::string> lose(std::int64_t now);
  std::vector<std::string> end_late(std::int64_t now);
  std::vector<std::string> too_old(PostgresConnection& connection, std::int64_t now, std::size_t most) const;
  bool sweep(const std::string& id, std::int64_t token);
  void maintain();
  std::size_t for_all(JobFilter filter, const std::function<void(Statements&, const std::string& id)>& add,
                      const std::function<std::optional<Changed>(const PostgresRows*, const std::string& id)>& told);
  PackedPart part_of(std::string_view select, const std::string& id);

  const PostgresOptions options_;
  const std::string process_ = random_id();  ///< names this process among those that share the store
  PostgresServerState state_;
  PostgresServerState listen_state_;                      ///< of the server of `listen_url`, where there is one
  PostgresConnections connections_, leases_, listeners_;  ///< heartbeats do not wait for others
  std::mutex timeline_mutex_;
  std::int64_t timeline_ = 1;  ///< the server's, as this process has met it last; guarded by timeline_mutex_
  std::mutex prepare_mutex_;
  std::atomic<bool> prepared_{false};  ///< whether the schema is up to date
  std::mutex ids_mutex_;
  Uuid7 ids_;
  std::mutex queued_mutex_;
  std::size_t queued_ = 0;  ///< jobs in the queue when they were counted, and own posts since; guarded by queued_mutex_
  std::chrono::steady_clock::time_point queued_known_ =
      std::chrono::steady_clock::time_point::min();  ///< when that was
  std::mutex claim_mutex_;                           ///< one claim at a time: suspects run alone in a process
  bool claim_unknown_ = false;     ///< whether a claim failed that may have been carried out; guarded by claim_mutex_
  QueuePlace claimed_up_to_;       ///< the last claim; guarded by claim_mutex_, as the two below
  std::uint64_t known_queue_ = 0;  ///< value of queue_changes_ before it
  std::chrono::steady_clock::time_point searched_all_{};  ///< the last claim that began at the head of the queue
  std::atomic<std::uint64_t> queue_changes_{0};           ///< grows whenever a job is known to have been queued
  std::mutex given_mutex_;
  std::set<std::pair<std::string, std::int64_t>> given_;  ///< attempts (id, token) that claims have returned
  std::mutex listener_mutex_;
  std::function<void(const std::vector<Changed>&)> listener_;
  std::mutex maintenance_mutex_;
  std::chrono::steady_clock::time_point maintained_{};

  std::mutex mutex_;  ///< guards what the writers take
  std::condition_variable wake_;
  std::deque<Post> posts_;
  bool stop_ = false;
  std::vector<std::thread> writers_;
  std::optional<PostgresSignals> signals_;
};

template <class Work>
auto PostgresStore::with_connection_of(PostgresConnections& connections, bool again, Work&& work) {
  constexpr int most = 4;
  for (int attempt = 1;; ++attempt) {
    try {
      PostgresConnections::Borrowed connection(connections);
      if (!prepared_) prepare(*connection);
      if (!connection->used()) raise_revisions(*connection);
      return work(*connection);
    } catch (const StoreConflict&) {
      if (attempt == most) throw;
    } catch (const StoreRefused& error) {
      if (!prepared_) options_.refused(error.what());
      throw;
    } catch (const StoreAway&) {
      if (!again || attempt > 1) throw;
    }
  }
}

}  // namespace bahnwerk::server
