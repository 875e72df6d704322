#include "server/runtime/look_thread.hpp"

#include <utility>

namespace bahnwerk::server {

LookThread::LookThread(std::function<std::chrono::milliseconds()> look, const TimeSource& time)
    : look_(std::move(look)), time_(time) {
  thread_ = std::thread([this] { loop(); });
}

void LookThread::notify() {
  {
    const std::lock_guard lock(mutex_);
    ++notifications_;
  }
  wake_.notify_one();
}

void LookThread::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void LookThread::loop() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    const std::uint64_t seen = notifications_;
    lock.unlock();
    const auto began = time_.now();
    const auto until = began + look_();
    lock.lock();
    while (!stop_ && notifications_ == seen && time_.now() < until) time_.wait_until(lock, wake_, until);
  }
}

}  // namespace bahnwerk::server
