#pragma once
/// Who is connected, and who has to leave when there are too many. No sockets here: a connection is a number.
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

/// Below its limits everybody is admitted. At a limit the connection that has waited longest without a whole request in
/// hand makes room; an address at its own limit gives up one of its own. Where all are busy the newcomer becomes a
/// spare: it is served health and readiness only, so that whoever watches the service still sees it live. Thread-safe;
/// every call O(log n).
class ConnectionTable {
 public:
  using Id = std::uint64_t;
  using Time = std::chrono::steady_clock::time_point;
  /// waiting: for the next request, or in the middle of its header; body: in the middle of a body, since its last byte;
  /// busy: a request is being answered.
  enum class Phase { waiting, body, busy };
  struct Rules {
    std::size_t most = 1024;
    std::size_t max_per_address = 512;  ///< 0 = as many as there are
    std::size_t spare = 32;
    std::chrono::milliseconds stalled{5'000};  ///< a body that stood still for so long makes room, too
  };
  enum class Place { regular, spare, none };
  struct Admission {
    Place place = Place::none;
    Id id = 0;                ///< unless none
    std::optional<Id> leave;  ///< has to be closed; it does not count any more
  };

  explicit ConnectionTable(Rules rules) : rules_(rules) {}
  Admission admit(const std::string& address, Time now);
  void enter(Id id, Phase phase, Time now);
  void remove(Id id);
  std::optional<Id> longest_waiting(Time now);  ///< for want of descriptors: it has to be closed
  std::size_t size() const;

 private:
  struct Entry {
    std::string address;
    Phase phase = Phase::waiting;
    Time since;
    bool spare = false, leaving = false;
  };
  using Waiting = std::set<std::pair<Time, Id>>;  ///< not busy, longest first
  struct Group {
    std::size_t count = 0;  ///< not leaving
    Waiting waiting;
  };
  std::optional<Id> oldest(const Waiting& waiting, Time now) const;
  void dismiss(Id id);  ///< from all counts
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
