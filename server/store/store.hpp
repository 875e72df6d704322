#pragma once
/// Where jobs live. Every call that changes something returns (or calls back) only when the change is durable. The
/// calls may come from any thread, and, where the store is shared, from several processes: each is one transaction.
/// What every implementation must hold is in tests/server/store/conformance.
#include <exception>
#include <functional>
#include <map>

#include "server/store/changes.hpp"
#include "server/store/values.hpp"

namespace bahnwerk::server {

class Store : public ChangeSource {
 public:
  // Jobs come in.

  /// Accepts a job; `done` is called once, from any thread, after the commit or with the StoreError. Waiting calls
  /// share a commit.
  virtual void insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) = 0;

  // Looks.

  /// The job without its document, if it is known without a look at the disk and is up to date: for threads that must
  /// not wait.
  virtual std::optional<api::Job> at_hand(const std::string&) { return std::nullopt; }
  /// `with_document` false leaves JobRequest::document empty.
  virtual std::optional<api::Job> get(const std::string& id, bool with_document = true) = 0;
  virtual std::vector<api::Job> list(const JobFilter& filter) = 0;  ///< newest first, without documents
  virtual std::map<api::JobState, std::size_t> counts() = 0;
  virtual void ping() = 0;  ///< a real query; throws StoreError, also when there is no space for another job

  // Attempts: from claim to one of end, succeed, requeue. Each of these changes nothing and returns false when the job
  // is not running any more, or runs another attempt.

  /// The next job: highest priority, then first come; it becomes `running` and its attempt grows by one. No job is
  /// given to two. Attempts whose lease ran out before `lease.now` are lost first, as in `expire`.
  virtual std::optional<api::Job> claim(const Lease& lease) = 0;
  /// Extends the attempts that this worker still has to `lease.until`, also those whose lease ran out unnoticed.
  /// Returns the others: they ended or were lost, and their planners may stop.
  virtual std::vector<Attempt> heartbeat(const Lease& lease, const std::vector<Attempt>& attempts) = 0;
  /// Stores progress asynchronously, within a group commit; `done` is called from any thread. Without effect when the
  /// attempt is over.
  virtual void progress(Progressed progress, std::function<void()> done) = 0;
  virtual bool end(const std::string& id, int attempt, const Ending& ending) = 0;
  /// From then on the result and all setpoints are there. Long series go in piece by piece before that, so that neither
  /// memory nor other writers suffer from their length; `progress` is asked between the pieces and may throw Stopped.
  /// After a StoreError a further call goes on where this one ended.
  virtual bool succeed(const std::string& id, int attempt, const api::PlannedJob& planned, std::int64_t now,
                       std::uint64_t revision, Progress& progress) = 0;
  /// Puts a running job back as if the attempt had not been made; a job whose cancellation was asked for is cancelled
  /// instead.
  virtual bool requeue(const std::string& id, int attempt, std::int64_t now, std::uint64_t revision) = 0;

  /// Ends queued jobs whose deadline has passed as deadline-exceeded. Running jobs whose lease has run out lost their
  /// attempt: they go back to the queue and keep its number, so that the next one is another; they end as cancelled
  /// when that was asked for, or as worker-lost after max_lost_attempts. A few hundred at a time; writes only when
  /// there are any.
  virtual Expired expire(std::int64_t now) = 0;

  // What clients ask for.

  /// A queued job is cancelled at once, of a running one the wish is kept; finished ones stay. Returns the job after
  /// that, without its document.
  virtual std::optional<api::Job> cancel(const std::string& id, std::int64_t now) = 0;
  virtual bool cancel_requested(const std::string& id) = 0;
  virtual Removed remove(const std::string& id) = 0;

  virtual std::optional<std::string> result(const std::string& id) = 0;  ///< the result document's text
  virtual std::optional<SeriesInfo> series(const std::string& id) = 0;   ///< nullopt: no result, or none with setpoints
  /// Rows of chunk `first_row` (a multiple of chunk_rows), row-major. Throws StoreError when it is gone.
  virtual void read_chunk(const SeriesInfo& series, std::size_t first_row, std::vector<double>& out) = 0;

  virtual void checkpoint() = 0;  ///< leaves nothing in side files; for an orderly end
};

}  // namespace bahnwerk::server
