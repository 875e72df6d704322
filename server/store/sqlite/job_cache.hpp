#pragma once
/// Jobs as they were last read. Many clients ask repeatedly for the few jobs that run or have just ended, and the store
/// is written rarely.
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "api/documents/job.hpp"

namespace bahnwerk::server {

/// Jobs that were read since the last commit. The next commit empties the cache, so changes need not be reported to it.
/// Thread-safe.
class JobCache {
 public:
  void put(std::uint64_t commits, const api::Job& job) {
    const std::lock_guard lock(mutex_);
    if (commits < commits_) return;
    if (commits > commits_ || jobs_.size() >= most) jobs_.clear();
    commits_ = commits;
    jobs_.insert_or_assign(job.id, job);
  }
  std::optional<api::Job> find(std::uint64_t commits, const std::string& id) const {
    const std::lock_guard lock(mutex_);
    if (commits != commits_) return std::nullopt;
    const auto found = jobs_.find(id);
    return found == jobs_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  static constexpr std::size_t most = 4096;
  mutable std::mutex mutex_;
  std::uint64_t commits_ = 0;
  std::unordered_map<std::string, api::Job> jobs_;
};

}  // namespace bahnwerk::server
