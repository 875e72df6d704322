#pragma once
/// The open connections, and the choice of those to close when there are too many. It has no sockets: a connection is a
/// number.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace bahnwerk::server {

/// Below its limits every connection is admitted. At a limit the connection that has waited longest without a complete
/// request is closed; an address at its own limit loses one of its own. Where all are busy the new one becomes a spare:
/// it is served health and readiness only, so that monitoring still sees the service. Listeners, whose answers take as
/// long as it takes until something happens, have three quarters of the connections, and of those of their address, at
/// most: beyond that the one that has listened longest gets its answer. Thread-safe; every call O(log n).
class ConnectionTable {
 public:
  using Id = std::uint64_t;
  using Time = std::chrono::steady_clock::time_point;
  /// waiting: for the next request, or in the middle of its header; body: in the middle of a body, since body_since();
  /// busy: a request is being answered; listening: its answer waits for something to happen, or is a stream of events.
  enum class Phase { waiting, body, busy, listening };
  struct Rules {
    std::size_t most = 1024;
    std::size_t max_per_address = 512;  ///< 0 = unlimited
    std::size_t spare = 32;
    std::chrono::milliseconds stalled{5'000};  ///< a body that waits for this long may be closed, too
  };
  enum class Place { regular, spare, none };
  struct Admission {
    Place place = Place::none;
    Id id = 0;                ///< set unless `place` is none
    std::optional<Id> leave;  ///< connection to close; it does not count any more
  };

  /// Returns since when a body waits: since its last bytes, or, where it came more slowly than it may, since the time
  /// at which a client that is just fast enough would have sent as much, `allowed` after its begin. So single bytes now
  /// and then keep no place.
  static Time body_since(Time begin, std::chrono::milliseconds allowed, Time last) {
    return allowed < last - begin ? begin + allowed : last;
  }

  explicit ConnectionTable(Rules rules) : rules_(rules) {}
  Admission admit(const std::string& address, Time now);
  /// Returns the listener whose answer has to end, if there are too many.
  std::optional<Id> enter(Id id, Phase phase, Time now);
  /// Counts the connection for another address: that of the client for which a proxy asks. An empty one has no limit.
  /// Returns false, without a change, if that address has all connections that it may have.
  bool assign(Id id, const std::string& address, Time now);
  void remove(Id id);
  std::optional<Id> longest_waiting(Time now);  ///< returns the connection to close when descriptors have run out
  std::size_t size() const;

 private:
  struct Entry {
    std::string address;
    Phase phase = Phase::waiting;
    Time since;
    bool spare = false, leaving = false;
  };
  using Waiting = std::set<std::pair<Time, Id>>;  ///< connections that are not busy, the longest waiting first
  struct Group {
    std::size_t count = 0;  ///< connections that are not being closed
    Waiting waiting, listening;
  };
  std::optional<Id> oldest(const Waiting& waiting, Time now) const;
  void dismiss(Id id);  ///< removes it from all counts
  /// Returns the set of this group that contains connections in this phase; nullptr for busy ones.
  static Waiting* set_of(Group& group, Phase phase);
  void list(Id id, const Entry& entry);
  void unlist(Id id, const Entry& entry);

  const Rules rules_;
  mutable std::mutex mutex_;
  Id next_ = 1;
  std::map<Id, Entry> entries_;
  Group all_, spares_;
  std::map<std::string, Group> addresses_;
};

}  // namespace bahnwerk::server
