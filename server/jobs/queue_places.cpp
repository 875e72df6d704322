#include "server/jobs/queue_places.hpp"

#include <algorithm>
#include <functional>

namespace bahnwerk::server {

bool QueuePlaces::outdated() const {
  const std::lock_guard lock(mutex_);
  return !looked_ || time_.now() > *looked_ + std::chrono::seconds(1);
}

void QueuePlaces::look() {
  if (!outdated()) return;
  {
    const std::lock_guard lock(mutex_);
    looked_ = time_.now();  // one of those who ask looks
  }
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (const std::string& id : store_.queue(most)) places.emplace_back(std::hash<std::string>()(id), places.size());
  std::sort(places.begin(), places.end());
  const std::lock_guard lock(mutex_);
  places_ = std::move(places);
}

std::optional<std::size_t> QueuePlaces::ahead(const std::string& id) const {
  const std::size_t hash = std::hash<std::string>()(id);
  const std::lock_guard lock(mutex_);
  const auto found = std::lower_bound(places_.begin(), places_.end(), std::pair{hash, std::size_t{0}});
  return found == places_.end() || found->first != hash ? std::nullopt : std::optional(found->second);
}

}  // namespace bahnwerk::server
