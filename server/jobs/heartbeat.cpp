#include "server/jobs/heartbeat.hpp"

#include <algorithm>
#include <utility>

#include "server/store/failure.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::chrono::milliseconds longest_interval{1'000};

}  // namespace

Heartbeat::Heartbeat(Store& store, LiveJobs& live, std::string worker, std::optional<std::chrono::milliseconds> lease,
                     std::function<void(const std::string&)> stored, const TimeSource& time)
    : store_(store),
      live_(live),
      worker_(std::move(worker)),
      lease_(lease),
      stored_(std::move(stored)),
      time_(time),
      interval_(lease ? std::min(longest_interval, *lease / 3) : longest_interval),
      next_(time.now() + interval_),
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
    next_ = time_.now() + interval_;
    lock.unlock();
    try {
      beat();
    } catch (const std::exception& error) {  // the next one may be in time; progress alone is no loss
      if (lease_) log_failure("heartbeat_failed", error);
    }
    lock.lock();
  }
}

void Heartbeat::beat() {
  const auto running = live_.all();
  std::vector<Progressed> attempts;
  std::map<std::string, std::uint64_t> told;
  for (const auto& live : running) {
    Progressed progressed = live->progressed();
    const auto known = told_.find(live->id());
    if (known != told_.end()) told.insert(*known);
    if (lease_ || known == told_.end() || known->second != progressed.revision)
      attempts.push_back(std::move(progressed));
  }
  told_ = std::move(told);
  if (attempts.empty()) return;
  const std::int64_t now = time_.now_ms();
  const auto held = store_.heartbeat({worker_, now, lease_ ? now + lease_->count() : Lease::forever}, attempts);
  for (const Progressed& progressed : attempts) {
    const auto live = std::find_if(running.begin(), running.end(),
                                   [&](const auto& each) { return each->id() == progressed.attempt.id; });
    const auto found =
        std::find_if(held.begin(), held.end(), [&](const Held& each) { return each.attempt == progressed.attempt; });
    if (found == held.end()) {
      (*live)->lost = true;
      continue;
    }
    if (found->cancel_requested) (*live)->cancel = true;
    (*live)->raise_above(found->revision, progressed.revision);
    const bool news = std::exchange(told_[progressed.attempt.id], progressed.revision) != progressed.revision;
    if (news) stored_(progressed.attempt.id);
  }
}

}  // namespace bahnwerk::server
