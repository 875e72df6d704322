#include "server/jobs/deadlines.hpp"

#include <algorithm>
#include <chrono>

#include "server/runtime/log.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::int64_t longest_sleep = 10'000;  ///< ms; the system's clock may be set meanwhile, too
constexpr std::int64_t retry = 1'000;           ///< ms after the store failed

}  // namespace

Deadlines::Deadlines(Store& store, const TimeSource& time, std::function<void(const Expired&)> looked)
    : store_(store), time_(time), looked_(std::move(looked)) {
  look();
  thread_ = std::thread([this] { loop(); });
}

Deadlines::~Deadlines() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Deadlines::notify() {
  {
    const std::lock_guard lock(mutex_);
    ++notifications_;
  }
  wake_.notify_one();
}

std::int64_t Deadlines::look() {
  try {
    const Expired expired = store_.expire(time_.now_ms());
    for (const std::string& id : expired.ids)
      log::info("job_ended", {{"job", id}, {"state", "failed"}, {"problem", "deadline-exceeded"}});
    if (expired.removed > 0) log::info("jobs_removed", {{"jobs", expired.removed}, {"reason", "retention"}});
    for (const std::string& id : expired.lost) log::warn("attempt_lost", {{"job", id}});
    if (looked_) looked_(expired);
    return expired.next ? std::clamp<std::int64_t>(*expired.next - time_.now_ms(), 0, longest_sleep) : longest_sleep;
  } catch (const StoreError& error) {
    log::error("expire_failed", {{"detail", error.what()}});
    return retry;
  }
}

void Deadlines::loop() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    const std::uint64_t seen = notifications_;
    lock.unlock();
    const auto asleep_since = time_.now();
    const auto until = asleep_since + std::chrono::milliseconds(look());
    lock.lock();
    while (!stop_ && notifications_ == seen && time_.now() < until) time_.wait_until(lock, wake_, until);
  }
}

}  // namespace bahnwerk::server
