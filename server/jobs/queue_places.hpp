#pragma once
/// How many jobs are before each one in the queue.
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/runtime/clock.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// The queue as it was at the last look, at most a second ago where somebody asks: looking costs as much as the queue
/// is long, and many clients ask for places. Thread-safe.
class QueuePlaces {
 public:
  QueuePlaces(Store& store, const TimeSource& time) : store_(store), time_(time) {}
  /// Returns whether it is more than a second since the last look.
  bool outdated() const;
  void look();  ///< reads the queue if that is outdated
  /// Returns how many jobs were before this one at the last look; nullopt: it was not among the first `most`.
  std::optional<std::size_t> ahead(const std::string& id) const;

 private:
  static constexpr std::size_t most = 100'000;
  Store& store_;
  const TimeSource& time_;
  mutable std::mutex mutex_;
  std::optional<TimeSource::Time> looked_;
  std::vector<std::pair<std::size_t, std::size_t>> places_;  ///< hash of the id and place, sorted
};

}  // namespace bahnwerk::server
