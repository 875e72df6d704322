#pragma once
/// Where jobs live. Every call that changes something returns (or calls back) only when the change is durable.
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "api/job.hpp"
#include "api/setpoints.hpp"

namespace bahnwerk::server {

/// The store could not do it; nothing of the call was kept. `full`: no space left.
struct StoreError : std::runtime_error {
  StoreError(const std::string& what, bool no_space) : std::runtime_error(what), full(no_space) {}
  bool full;
};

struct NewJob {
  api::JobRequest request;
  std::string idempotency_key;  ///< empty = none
  std::string body_hash;        ///< of the posted body; compared when the key was used before
  std::int64_t now = 0;         ///< ms since 1970 UTC
  std::size_t max_queued = 0;   ///< refuse when so many wait already
};
struct Inserted {
  enum class What { created, replayed, conflict, full };
  What what = What::created;
  std::string id;  ///< created, replayed
};

struct JobFilter {
  std::optional<api::JobState> state;
  std::optional<std::string> kind, reference;
  std::string before;  ///< only ids smaller than this; empty = from the newest
  std::size_t limit = 50;
};

/// How an attempt ended. `revision` is the last one shown to clients while it ran.
struct Ending {
  api::JobState state = api::JobState::failed;  ///< failed or cancelled
  std::string error;                            ///< problem document
  std::int64_t now = 0;
  std::uint64_t revision = 0;
};

/// What a stored series looks like; its rows come through Store::read_chunk.
struct SeriesInfo {
  std::int64_t key = 0;
  std::vector<Column> columns;
  std::size_t count = 0, chunk_rows = 0;
  double cycle_time = 0;
};

struct Progressed {
  std::string id;
  int attempt = 0;
  double fraction = 0;
  std::string stage, message;
  std::uint64_t revision = 0;
};

enum class Removed { yes, running, unknown };

/// The queued jobs that were ended because their deadline had passed, and the next deadline in the queue.
struct Expired {
  std::vector<std::string> ids;
  std::optional<std::int64_t> next;  ///< ms since 1970 UTC
};

class Store {
 public:
  virtual ~Store() = default;

  /// Accepts a job; `done` is called once, from any thread, after the commit or with the StoreError. Waiting calls
  /// share a commit.
  virtual void insert(NewJob job, std::function<void(Inserted, std::exception_ptr)> done) = 0;

  /// The job without its document, if it is known without a look at the disk: for threads that must not wait.
  virtual std::optional<api::Job> at_hand(const std::string&) { return std::nullopt; }
  /// `with_document` false leaves JobRequest::document empty.
  virtual std::optional<api::Job> get(const std::string& id, bool with_document = true) = 0;
  virtual std::vector<api::Job> list(const JobFilter& filter) = 0;  ///< newest first, without documents
  virtual std::map<api::JobState, std::size_t> counts() = 0;
  virtual void ping() = 0;  ///< a real query; throws StoreError, also when there is no space for another job

  /// The next job: highest priority, then first come; it becomes `running` and its attempt grows by one.
  virtual std::optional<api::Job> claim(std::int64_t now) = 0;
  /// Stores progress some time soon; `done` is called from any thread. Without effect when the attempt is over.
  virtual void progress(Progressed progress, std::function<void()> done) = 0;
  /// Ends attempt `attempt` of a running job. False: it is not running any more, or is another attempt; nothing
  /// changed.
  virtual bool end(const std::string& id, int attempt, const Ending& ending) = 0;
  /// The same for success: from then on the result and all setpoints are there. Long series go in piece by piece
  /// before that, so that neither memory nor other writers suffer from their length; `progress` is asked between the
  /// pieces and may throw Stopped. After a StoreError a further call goes on where this one ended.
  virtual bool succeed(const std::string& id, int attempt, const api::PlannedJob& planned, std::int64_t now,
                       std::uint64_t revision, Progress& progress) = 0;
  /// Puts a running job back as if the attempt had not been made; a job whose cancellation was asked for is cancelled
  /// instead.
  virtual bool requeue(const std::string& id, int attempt, std::int64_t now, std::uint64_t revision) = 0;

  /// Ends queued jobs whose deadline has passed as deadline-exceeded. Writes only when there are any.
  virtual Expired expire(std::int64_t now) = 0;

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
