#include "server/http/connection_table.hpp"

namespace bahnwerk::server {

std::optional<ConnectionTable::Id> ConnectionTable::oldest(const Waiting& waiting, Time now) const {
  for (const auto& [since, id] : waiting)
    if (entries_.at(id).phase == Phase::waiting || now - since >= rules_.stalled) return id;
  return std::nullopt;
}

void ConnectionTable::list(Id id, const Entry& entry) {
  if (entry.leaving || entry.phase == Phase::busy) return;
  if (entry.spare) {
    spares_.waiting.emplace(entry.since, id);
  } else {
    all_.waiting.emplace(entry.since, id);
    addresses_[entry.address].waiting.emplace(entry.since, id);
  }
}

void ConnectionTable::unlist(Id id, const Entry& entry) {
  if (entry.leaving || entry.phase == Phase::busy) return;
  if (entry.spare) {
    spares_.waiting.erase({entry.since, id});
  } else {
    all_.waiting.erase({entry.since, id});
    addresses_[entry.address].waiting.erase({entry.since, id});
  }
}

void ConnectionTable::dismiss(Id id) {
  Entry& entry = entries_.at(id);
  if (entry.leaving) return;
  unlist(id, entry);
  entry.leaving = true;
  if (entry.spare) {
    --spares_.count;
    return;
  }
  --all_.count;
  const auto group = addresses_.find(entry.address);
  if (--group->second.count == 0) addresses_.erase(group);
}

ConnectionTable::Admission ConnectionTable::admit(const std::string& address, Time now) {
  const std::lock_guard lock(mutex_);
  Admission result;
  // Connections that are closing still have their sockets for a moment.
  if (entries_.size() >= 2 * rules_.most + rules_.spare) return result;
  bool spare = false;
  const auto group = addresses_.find(address);
  if (rules_.max_per_address > 0 && group != addresses_.end() && group->second.count >= rules_.max_per_address) {
    result.leave = oldest(group->second.waiting, now);
    spare = !result.leave;
  } else if (all_.count >= rules_.most) {
    result.leave = oldest(all_.waiting, now);
    spare = !result.leave;
  }
  if (spare && spares_.count >= rules_.spare) {
    result.leave = oldest(spares_.waiting, now);
    if (!result.leave) return result;
  }
  if (result.leave) dismiss(*result.leave);
  result.id = next_++;
  result.place = spare ? Place::spare : Place::regular;
  const Entry& entry = entries_.emplace(result.id, Entry{address, Phase::waiting, now, spare, false}).first->second;
  if (spare) {
    ++spares_.count;
  } else {
    ++all_.count;
    ++addresses_[address].count;
  }
  list(result.id, entry);
  return result;
}

void ConnectionTable::enter(Id id, Phase phase, Time now) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(id);
  if (found == entries_.end()) return;
  Entry& entry = found->second;
  unlist(id, entry);
  entry.phase = phase;
  entry.since = now;
  list(id, entry);
}

void ConnectionTable::remove(Id id) {
  const std::lock_guard lock(mutex_);
  if (!entries_.contains(id)) return;
  dismiss(id);
  entries_.erase(id);
}

std::optional<ConnectionTable::Id> ConnectionTable::longest_waiting(Time now) {
  const std::lock_guard lock(mutex_);
  const auto found = oldest(all_.waiting, now);
  if (found) dismiss(*found);
  return found;
}

std::size_t ConnectionTable::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

}  // namespace bahnwerk::server
