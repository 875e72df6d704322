#include "server/http/connection_table.hpp"

#include <algorithm>

namespace bahnwerk::server {

std::optional<ConnectionTable::Id> ConnectionTable::oldest(const Waiting& waiting, Time now) const {
  for (const auto& [since, id] : waiting)
    if (entries_.at(id).phase == Phase::waiting || now - since >= rules_.stalled) return id;
  return std::nullopt;
}

ConnectionTable::Waiting* ConnectionTable::set_of(Group& group, Phase phase) {
  if (phase == Phase::busy) return nullptr;
  return phase == Phase::listening ? &group.listening : &group.waiting;
}

void ConnectionTable::list(Id id, const Entry& entry) {
  if (entry.leaving || entry.phase == Phase::busy) return;
  if (entry.spare) {
    set_of(spares_, entry.phase)->emplace(entry.since, id);
  } else {
    set_of(all_, entry.phase)->emplace(entry.since, id);
    set_of(addresses_[entry.address], entry.phase)->emplace(entry.since, id);
  }
}

void ConnectionTable::unlist(Id id, const Entry& entry) {
  if (entry.leaving || entry.phase == Phase::busy) return;
  if (entry.spare) {
    set_of(spares_, entry.phase)->erase({entry.since, id});
  } else {
    set_of(all_, entry.phase)->erase({entry.since, id});
    set_of(addresses_[entry.address], entry.phase)->erase({entry.since, id});
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
  if (rules_.max_per_address > 0 && !address.empty() && group != addresses_.end() &&
      group->second.count >= rules_.max_per_address) {
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

std::optional<ConnectionTable::Id> ConnectionTable::enter(Id id, Phase phase, Time now) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(id);
  if (found == entries_.end()) return std::nullopt;
  const auto change = [this](Id of, Phase to, Time at) {
    Entry& entry = entries_.at(of);
    unlist(of, entry);
    entry.phase = to;
    entry.since = at;
    list(of, entry);
  };
  change(id, phase, now);
  const Entry& entry = found->second;
  if (phase != Phase::listening || entry.spare || entry.leaving) return std::nullopt;
  const auto crowded = [](const Group& group, std::size_t most) {
    return most > 0 && group.listening.size() > std::max<std::size_t>(1, most - most / 4);
  };
  const Group& own = addresses_.at(entry.address);
  const Group* full = crowded(own, entry.address.empty() ? 0 : rules_.max_per_address) ? &own
                      : crowded(all_, rules_.most)                                     ? &all_
                                                                                       : nullptr;
  if (!full) return std::nullopt;
  const Id oldest = full->listening.begin()->second;
  change(oldest, Phase::busy, now);
  return oldest;
}

bool ConnectionTable::assign(Id id, const std::string& address, Time now) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(id);
  if (found == entries_.end() || found->second.spare || found->second.leaving) return true;
  Entry& entry = found->second;
  if (entry.address == address) return true;
  const auto group = addresses_.find(address);
  if (!address.empty() && rules_.max_per_address > 0 && group != addresses_.end() &&
      group->second.count >= rules_.max_per_address)
    return false;
  unlist(id, entry);
  const auto former = addresses_.find(entry.address);
  if (--former->second.count == 0) addresses_.erase(former);
  entry.address = address;
  entry.since = now;
  ++addresses_[address].count;
  list(id, entry);
  return true;
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
