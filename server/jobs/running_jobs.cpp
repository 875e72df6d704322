#include "server/jobs/running_jobs.hpp"

#include <algorithm>

#include "server/store/failure.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::chrono::seconds interval{1};

}  // namespace

RunningJobs::RunningJobs(Store& store, const LiveJobs& live, Notifier& notifier, const TimeSource& time)
    : store_(store), live_(live), notifier_(notifier), time_(time) {
  if (!store_.shared()) return;
  thread_.emplace([this] {
    report();
    return interval;
  });
}

std::vector<Running> RunningJobs::all() {
  if (!store_.shared()) {
    std::vector<Running> running;
    for (const auto& live : live_.all()) running.push_back({live->id(), live->revision()});
    return running;
  }
  {
    const std::lock_guard lock(mutex_);
    if (looked_ && time_.now() < *looked_ + interval) return seen_;
  }
  return look();
}

void RunningJobs::changed() {
  const std::lock_guard lock(mutex_);
  looked_.reset();
}

std::vector<Running> RunningJobs::look() {
  const auto before = time_.now();
  auto running = store_.running();
  const std::lock_guard lock(mutex_);
  looked_ = before;
  seen_ = running;
  return running;
}

void RunningJobs::report() {
  if (!notifier_.watched()) return;
  try {
    auto running = look();
    for (const Running& job : running) {
      const auto known =
          std::find_if(reported_.begin(), reported_.end(), [&](const Running& r) { return r.id == job.id; });
      if (known == reported_.end() || known->revision != job.revision) notifier_.changed(job.id, Change::progress);
    }
    reported_ = std::move(running);
  } catch (const std::exception& error) {
    log_failure("running_not_read", error);
  }
}

}  // namespace bahnwerk::server
