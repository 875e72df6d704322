#pragma once
/// The interface by which waiters learn of changes in a store: commits of this process at once, those of others by
/// polling.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "api/documents/job.hpp"

namespace bahnwerk::server {

/// A job after its last change.
struct Changed {
  std::uint64_t sequence = 0;
  std::string id;
  std::optional<api::JobState> state;  ///< nullopt: removed
  bool cancel_requested = false;       ///< whether the cancellation of a running job was requested
  std::uint64_t revision = 0;          ///< 0 where the store does not know it without a query (callbacks, removed jobs)
};

struct Changes {
  std::vector<Changed> list;  ///< ordered by sequence; every job occurs once, with its last change
  /// Whether removals older than the store remembers lie between the requested sequence and the first one of the list:
  /// waiters for any job have to check it.
  bool gap = false;
};

class ChangeSource {
 public:
  virtual ~ChangeSource() = default;

  /// Tells whether other processes may change the store: then only polling shows all changes.
  virtual bool shared() const = 0;

  /// `call` receives every commit made through this object, before the callers of the commit do: from any thread, one
  /// call at a time; it must be quick and must not throw or call listen. Progress is left out: whoever stored it has
  /// already shown it. There is one listener; nullptr ends it, and when listen returns no call is in progress.
  virtual void listen(std::function<void(const std::vector<Changed>&)> call) = 0;

  /// `call` is told, from any thread, that other processes may have made changes, sooner than polling would show them;
  /// it must be quick. There is one listener; nullptr ends it, and when the call returns no other one is in progress.
  virtual void listen_to_others(std::function<void()>) {}

  /// Returns the changes after `sequence`, the oldest `limit` ones, of all jobs or of one owner's; progress is none.
  /// Each change of a job gives it a new sequence, greater than all that anybody can have seen: no change appears
  /// behind a returned sequence. The cost depends on the changes returned, not on the number of jobs.
  virtual Changes changes_since(std::uint64_t sequence, std::size_t limit,
                                const std::optional<std::string>& owner = std::nullopt) = 0;
  virtual std::uint64_t last_change() = 0;  ///< sequence from which to ask for later changes
};

}  // namespace bahnwerk::server
