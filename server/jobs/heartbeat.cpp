#include "server/jobs/heartbeat.hpp"

#include <algorithm>

#include "server/store/failure.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::chrono::milliseconds retry{1'000};  ///< after the store failed: whoever lives renews before others look

}  // namespace

Heartbeat::Heartbeat(Store& store, LiveJobs& live, std::string worker, std::chrono::milliseconds lease,
                     const TimeSource& time)
    : store_(store),
      live_(live),
      worker_(std::move(worker)),
      lease_(lease),
      time_(time),
      next_(time.now() + lease / 3),
      thread_([this] { loop(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Heartbeat::loop() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    while (!stop_ && time_.now() < next_) time_.wait_until(lock, wake_, next_);
    if (stop_) return;
    next_ = time_.now() + lease_ / 3;
    lock.unlock();
    const bool stored = beat();
    lock.lock();
    if (!stored) next_ = time_.now() + std::min(lease_ / 3, retry);
  }
}

bool Heartbeat::beat() {
  const auto running = live_.all();
  std::vector<Attempt> attempts;
  for (const auto& live : running) attempts.push_back(live->attempt());
  try {
    const std::int64_t now = time_.now_ms();
    const auto over = store_.heartbeat({worker_, now, now + lease_.count()}, attempts);
    for (const auto& live : running)
      if (std::find(over.begin(), over.end(), live->attempt()) != over.end()) live->lost = true;
  } catch (const StoreError& error) {  // the next one may be in time
    log_failure("heartbeat_failed", error);
    return false;
  }
  return true;
}

}  // namespace bahnwerk::server
