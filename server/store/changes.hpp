#pragma once
/// How those who wait learn what changed in a store: at once of what this process commits, by asking of what others do.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "api/job.hpp"

namespace bahnwerk::server {

/// A job as its last change left it.
struct Changed {
  std::uint64_t sequence = 0;
  std::string id;
  std::optional<api::JobState> state;  ///< nullopt: removed
  bool cancel_requested = false;       ///< of a running job
  std::uint64_t revision = 0;          ///< 0 where the store does not know it without a look (callbacks, removed jobs)
};

struct Changes {
  std::vector<Changed> list;  ///< by growing sequence, every job once, with its last change
  /// Older removals than the store remembers lie between the sequence asked for and the first one of the list: whoever
  /// waits for any job has to look.
  bool gap = false;
};

class ChangeSource {
 public:
  virtual ~ChangeSource() = default;

  /// Other processes may change it, too: then only asking shows all changes.
  virtual bool shared() const = 0;

  /// `call` is told of every commit made through this object, before those who asked for the commit are: from any
  /// thread, one call at a time; it must be quick and may not throw, or call listen. Progress is left out: who stored
  /// it has shown it already. One listener; nullptr ends it, and when listen returns no call is under way any more.
  virtual void listen(std::function<void(const std::vector<Changed>&)> call) = 0;

  /// What changed after `sequence`, progress included, the oldest `limit` ones. Each change of a job gives it a new
  /// sequence, greater than all that anybody can have seen: nothing appears behind a sequence that was returned.
  /// Takes a look at the changes returned, not at all jobs.
  virtual Changes changes_since(std::uint64_t sequence, std::size_t limit) = 0;
  virtual std::uint64_t last_change() = 0;  ///< from where to ask for what comes
};

}  // namespace bahnwerk::server
