#pragma once
/// The interface of a store of jobs. Every call that changes something returns (or calls back) only when the change is
/// durable. Calls may come from any thread, and, where the store is shared, from several processes: each is one
/// transaction. Requirements of every implementation are in tests/server/store/conformance.
#include <exception>
#include <functional>
#include <map>
#include <memory>

#include "server/store/changes.hpp"
#include "server/store/keys.hpp"
#include "server/store/values.hpp"

namespace bahnwerk::server {

/// A stored text, read in pieces in order.
class StoredText {
 public:
  virtual ~StoredText() = default;
  virtual std::size_t size() const = 0;  ///< bytes of the whole text
  /// Appends the next piece, about 128 KiB; returns false, without a change, at the end. Throws StoreError if the job
  /// was deleted meanwhile. Calls may come from several threads, one after the other.
  virtual bool next(std::string& out) = 0;
};

class Store : public ChangeSource {
 public:
  // Insertion.

  /// Accepts a job; `done` is called once, from any thread, after the commit or with the StoreError. Waiting calls
  /// share a commit.
  virtual void insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) = 0;

  // Queries.

  /// Returns the job without its document if it is up to date in memory, without disk access: for threads that must not
  /// wait.
  virtual std::optional<api::Job> at_hand(const std::string&) { return std::nullopt; }
  /// `with_document` false leaves JobRequest::document empty, and the callback without its secret.
  virtual std::optional<api::Job> get(const std::string& id, bool with_document = true) = 0;
  virtual std::vector<api::Job> list(const JobFilter& filter) = 0;  ///< without documents
  virtual std::vector<std::string> queue(std::size_t limit) = 0;    ///< the first jobs of the queue, in its order
  /// Returns how many jobs are in each state, all or those of one owner; without counting them.
  virtual std::map<api::JobState, std::size_t> counts(const std::optional<std::string>& owner = std::nullopt) = 0;
  /// Returns the jobs that run, in the order of their ids.
  virtual std::vector<Running> running() = 0;
  virtual StoreStatus status() = 0;
  virtual StoreState state() const { return StoreState::up; }  ///< without disk access
  virtual StoreConnections connections() const { return {}; }  ///< without disk access
  virtual void ping() = 0;  ///< a real query; throws StoreError, also when there is no space for another job

  // Attempts: from claim to one of end, succeed, requeue. Each of these changes nothing and returns false when the job
  // is not running any more, or runs another attempt. Where a call of the same attempt has already ended the job in the
  // same state, end and succeed change nothing and return true: a caller whose answer was lost calls again. Any of
  // these calls, or a heartbeat, of an attempt that was lost shows that its worker lives: the loss counts no longer.

  /// Claims the next job: highest priority, then first come; it becomes `running`, and its attempt number and its
  /// token increase by one. No job is given to two callers. Jobs that need planners of a later version are left.
  /// Attempts whose lease ran out before `lease.now` are lost first, as in `expire`. A job with a lost attempt is given
  /// to a worker that runs no other one, and that gets none until it has ended.
  virtual std::optional<api::Job> claim(const Lease& lease) = 0;
  /// Extends the attempts that this worker still has to `lease.until`, also those whose lease ran out unnoticed, and
  /// stores their progress where its revision is not below the stored one. Returns these attempts; the others ended or
  /// were lost, and their planners may stop. A crash of the store's server may undo it.
  virtual std::vector<Held> heartbeat(const Lease& lease, const std::vector<Progressed>& attempts) = 0;
  virtual bool end(const Attempt& attempt, const Ending& ending) = 0;
  /// Stores the result, all setpoints and their views. Long series are stored piece by piece before the state changes,
  /// so that neither memory nor other writers suffer from their length; `progress` is asked between the pieces and may
  /// throw Stopped. `seen` is called when all pieces are stored, because clients see that progress, too, and the
  /// job's revision exceeds it. After a StoreError a further call continues where this one ended.
  virtual bool succeed(const Attempt& attempt, const api::PlannedJob& planned, std::int64_t now,
                       const SeenRevision& seen, Progress progress) = 0;
  /// Puts a running job back as if the attempt had not been made; a job with a requested cancellation is cancelled
  /// instead.
  virtual bool requeue(const Attempt& attempt, std::int64_t now, std::uint64_t revision) = 0;

  /// Ends queued jobs whose deadline has passed as deadline-exceeded. Running jobs whose lease has run out have lost
  /// their attempt: they return to the queue with its number, so that the next one differs; they end as cancelled when
  /// that was requested, or as worker-lost after max_losses_alone. Removes ended jobs beyond the
  /// store's retention, frees what removed jobs have left, and gives space back to the disk. A few hundred jobs or some
  /// megabytes per call; writes only when there are any.
  virtual Expired expire(std::int64_t now) = 0;

  // Callbacks. The call that ends a job makes its callback due, in the same transaction; the removal of the job
  // withdraws it.

  /// Returns the receivers to whom callbacks are to be delivered, each with the time when the first one is due.
  virtual std::vector<std::pair<std::string, std::int64_t>> callback_receivers() = 0;
  /// Returns the callbacks of a receiver that are due at `now`, in this order, at most `limit`.
  virtual std::vector<DueCallback> due_callbacks(const std::string& receiver, std::int64_t now, std::size_t limit) = 0;
  /// Records an attempt; without effect if the job was removed.
  virtual void called_back(const CallbackAttempt& attempt) = 0;

  // Requests of clients.

  /// Cancels a queued job at once and records the request for a running one; finished jobs are unchanged. Returns the
  /// job afterwards, without its document.
  virtual std::optional<api::Job> cancel(const std::string& id, std::int64_t now) = 0;
  virtual bool cancel_requested(const std::string& id) = 0;
  /// Removes the job at once, with a callback that was not delivered, then its rows piece by piece, so that other
  /// writes proceed in between. A job that is not running is kept where `condition`, called within the transaction with
  /// the job without its document, is false.
  virtual Removed remove(const std::string& id, const std::function<bool(const api::Job&)>& condition) = 0;
  Removed remove(const std::string& id) { return remove(id, {}); }
  /// Act on all jobs that match the filter, in pieces, so that other writes proceed in between; return how many were
  /// cancelled (queued, or running and asked to stop), or removed (running ones are not). `limit` is not used.
  virtual std::size_t cancel_all(const JobFilter& filter, std::int64_t now) = 0;
  virtual std::size_t remove_all(const JobFilter& filter) = 0;

  /// Opens the document as it was posted, and the result document; nullptr if there is none.
  virtual std::unique_ptr<StoredText> open_document(const std::string& id) = 0;
  virtual std::unique_ptr<StoredText> open_result(const std::string& id) = 0;
  std::optional<std::string> result(const std::string& id);             ///< the whole result document
  virtual std::optional<SeriesInfo> series(const std::string& id) = 0;  ///< nullopt: no result, or none with setpoints
  /// Reads the rows of chunk `first_row` (a multiple of chunk_rows), row-major. Throws StoreError when it was removed.
  virtual void read_chunk(const SeriesInfo& series, std::size_t first_row, std::vector<double>& out) = 0;

  /// Returns the bytes of a part of a view (api/views/views.hpp); nullopt if there is none.
  virtual std::optional<std::string> read_view(const SeriesInfo& series, std::string_view name, std::size_t part) = 0;
  /// Stores parts of the views of a job that succeeded without them, and replaces those that exist; with the `last`
  /// ones the series has views. Throws StoreError when the job was removed.
  virtual void put_views(const SeriesInfo& series, const std::vector<api::ViewPart>& parts, bool last) = 0;

  /// Returns all keys, or nullopt if their version is `known`; 0 is that of a store that never had one.
  virtual std::optional<Keys> keys(std::uint64_t known) = 0;
};

inline std::optional<std::string> Store::result(const std::string& id) {
  const auto text = open_result(id);
  if (!text) return std::nullopt;
  std::string whole;
  whole.reserve(text->size());
  while (text->next(whole)) {
  }
  return whole;
}

}  // namespace bahnwerk::server
