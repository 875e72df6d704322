#include "server/jobs/heartbeat.hpp"

#include <algorithm>

#include "server/runtime/clock.hpp"
#include "server/runtime/log.hpp"

namespace bahnwerk::server {

Heartbeat::Heartbeat(Store& store, LiveJobs& live, std::string worker, std::chrono::milliseconds lease)
    : store_(store), live_(live), worker_(std::move(worker)), lease_(lease), thread_([this] { loop(); }) {}

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
  while (!wake_.wait_for(lock, lease_ / 3, [&] { return stop_; })) {
    lock.unlock();
    beat();
    lock.lock();
  }
}

void Heartbeat::beat() {
  const auto running = live_.all();
  std::vector<Attempt> attempts;
  for (const auto& live : running) attempts.push_back({live->id(), live->attempt()});
  try {
    const std::int64_t now = now_ms();
    const auto over = store_.heartbeat({worker_, now, now + lease_.count()}, attempts);
    for (const auto& live : running)
      if (std::find(over.begin(), over.end(), Attempt{live->id(), live->attempt()}) != over.end()) live->lost = true;
  } catch (const StoreError& error) {  // the next one may be in time
    log::error("heartbeat_failed", {{"detail", error.what()}});
  }
}

}  // namespace bahnwerk::server
