#pragma once
/// Values that go into a store and come out of it, independent of its implementation. Times are ms since 1970 UTC.
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "api/documents/job.hpp"
#include "api/setpoints/setpoints.hpp"
#include "api/views/views.hpp"

namespace bahnwerk::server {

/// The store failed; no part of the call was stored, but for a server that went away during it. `full`: no space left;
/// `busy`: another program has it locked, or its server is away.
struct StoreError : std::runtime_error {
  StoreError(const std::string& what, bool no_space, bool locked = false)
      : std::runtime_error(what), full(no_space), busy(locked) {}
  bool full, busy;
};

/// The store's server cannot be reached, or did not answer in time: whether the call was carried out is unknown.
struct StoreAway : StoreError {
  explicit StoreAway(const std::string& what) : StoreError(what, false, true) {}
};

/// The store's server is a standby, which can only be read; the call had no effect.
struct StoreReadOnly : StoreError {
  explicit StoreReadOnly(const std::string& what) : StoreError(what, false, true) {}
};

/// What can be done with a store, as far as its last call showed.
enum class StoreState { up, read_only, away };

/// An attempt that runs, in any process, and the job's revision with its stored progress.
struct Running {
  std::string id;
  std::uint64_t revision = 0;
};

/// The disk space that a store takes, and the age of its queue.
struct StoreStatus {
  double bytes = 0, log_bytes = 0;            ///< of the jobs, and of what was not moved to them yet
  double free_bytes = 0;                      ///< bytes that may still be written; infinity: unknown
  std::optional<std::int64_t> oldest_queued;  ///< when the job that waits longest was posted, ms since 1970 UTC
  std::size_t callbacks = 0;                  ///< callbacks that are to be delivered
  std::size_t beyond_engine = 0;              ///< queued jobs that need a later engine than this process has
  /// Rows of the queue's tables that nobody sees any more and the server has not freed yet: claims walk over them.
  double dead_rows = 0;
  /// Age of the oldest snapshot, for which the server keeps such rows: in transactions, and in seconds as far as its
  /// user lets this one see it.
  double snapshot_transactions = 0, snapshot_seconds = 0;
};

/// The connections to a store's server that requests and plans of this process share. All 0: there is no server.
struct StoreConnections {
  std::size_t busy = 0, idle = 0, most = 0;
};

inline constexpr std::int64_t ms_per_day = 86'400'000;

struct NewJob {
  api::JobRequest request;
  std::string idempotency_key;  ///< key of an idempotent request; empty: none
  std::string body_hash;        ///< hash of the posted body; compared when the key was used before
  std::int64_t now = 0;
  std::size_t max_queued = 0;             ///< refuses the job when this many already wait
  std::optional<std::string> owner = {};  ///< name of the key that posts it
  /// Who is called, of which calls do not wait for those of others; given where the request has a callback.
  std::optional<std::string> callback_receiver = {};
  /// Refuses the job when so many of its owner wait, or planners spent so many ms on the owner's jobs on this day
  /// (UTC).
  std::optional<std::int64_t> max_owned = {}, max_planning_ms = {};
};
struct Inserted {
  enum class What { created, replayed, conflict, full, owner_full, planning_spent };
  What what = What::created;
  std::string id;  ///< id of the job, if created or replayed
};

struct JobFilter {
  std::optional<api::JobState> state = {};
  std::optional<std::string> kind = {}, reference = {}, tag = {};
  std::optional<std::string> owner = {};  ///< jobs of this name alone
  std::optional<std::string> text = {};   ///< begin of the name, the reference or the id; not empty
  bool oldest_first = false;              ///< whether the oldest is the first; else the newest is
  std::string before = {};                ///< the last id of the page before; empty: from the first
  std::optional<std::int64_t> created_after = {},
                              created_before = {};  ///< limits of the time of posting: from, and before
  std::size_t limit = 50;
};

/// Identifies a worker, and the time until which its attempts are its own without a further heartbeat. A process has a
/// new name at every start. Clocks of several processes may differ by much less than the duration of a lease.
struct Lease {
  static constexpr std::int64_t forever = std::numeric_limits<std::int64_t>::max();
  std::string worker;
  std::int64_t now = 0;
  std::int64_t until = forever;
};

/// A run of a planner on a job: what every write of its worker is conditional on. The token increases with every claim
/// and is not given again, so that a planner that was thought stuck cannot store its result as another's.
struct Attempt {
  std::string id;
  std::int64_t token = 0;
  bool operator==(const Attempt&) const = default;
};

/// A job whose attempts were lost this often (the process died, or its lease ran out) while the process ran no other
/// job is not tried again: it ends as worker-lost. Where several ran, nobody knows which one is to blame: each of them
/// is a suspect, and suspects are planned alone. A worker that was paused beyond its lease cannot be told from one that
/// died until it goes on; the loss counts until then.
inline constexpr int max_losses_alone = 3;

/// The end of an attempt. `revision` is the last one shown to clients while it ran.
struct Ending {
  api::JobState state = api::JobState::failed;  ///< failed or cancelled
  std::string error;                            ///< problem document
  std::int64_t now = 0;
  std::uint64_t revision = 0;
  std::string result = {};  ///< result document of a plan that was not verified; empty: none
};

/// Properties of a stored series; its rows are read by Store::read_chunk.
struct SeriesInfo {
  std::string id;        ///< id of the job
  std::int64_t key = 0;  ///< key by which the store finds the series, beside the id
  std::vector<Column> columns;
  std::size_t count = 0, chunk_rows = 0;
  double cycle_time = 0;
  Independent independent = {};
  std::optional<PoseFrame> pose_frame = {};
  int views = 0;  ///< version of the stored views; 0: none
};

/// Returns the newest revision of an attempt's progress that clients may have seen.
using SeenRevision = std::function<std::uint64_t()>;

/// The progress of an attempt, as a heartbeat tells it.
struct Progressed {
  Attempt attempt;
  double fraction = 0;
  std::string stage = {}, message = {};
  std::uint64_t revision = 0;
};

/// An attempt that its worker still has. `revision` is the stored one; it is above the told one where the store has
/// raised it, and what is told next needs a greater one.
struct Held {
  Attempt attempt;
  std::uint64_t revision = 0;
  bool cancel_requested = false;
};

/// A callback that is to be delivered.
struct DueCallback {
  api::Job job;  ///< without its document
  std::string secret;
};
struct CallbackAttempt {
  std::string id;
  std::int64_t now = 0;
  std::optional<std::string> error = {};     ///< why it failed; nullopt: it was delivered
  std::optional<std::int64_t> next_at = {};  ///< when a failed one is tried again; nullopt: not any more
};

/// How long ended jobs are kept, those at least whose callback is to be delivered. What exceeds one of the limits is
/// removed, what ended first goes first.
struct Retention {
  std::optional<std::int64_t> time = {};   ///< ms since the end
  std::optional<std::int64_t> jobs = {};   ///< number of ended jobs
  std::optional<std::int64_t> bytes = {};  ///< size of the whole store
  std::int64_t spare_bytes = 16 << 20;     ///< free space that the store's file keeps; more is given back to the disk
};

enum class Removed { yes, running, unknown, refused };  ///< refused: the condition of the call did not hold

/// Result of Store::expire, and the time of the next call that has something to do.
struct Expired {
  std::vector<std::string> ids;   ///< queued jobs that ended because their deadline had passed
  std::vector<std::string> lost;  ///< running jobs whose lease had run out
  std::size_t removed = 0;        ///< ended jobs that were kept long enough
  std::optional<std::int64_t> next;
};

}  // namespace bahnwerk::server
