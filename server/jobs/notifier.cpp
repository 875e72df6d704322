#include "server/jobs/notifier.hpp"

#include <vector>

namespace bahnwerk::server {

Notifier::Notifier() : thread_([this] { loop(); }) {}

Notifier::~Notifier() {
  release();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  tick_.notify_one();
  thread_.join();
}

Notifier::Token Notifier::wait(const std::string& job, Clock::time_point until, std::function<void()> wake) {
  Token token = 0;
  {
    const std::lock_guard lock(mutex_);
    token = next_++;
    if (!released_) {
      waiters_.emplace(token, Waiter{job, until, std::move(wake)});
      by_job_.emplace(job, token);
      by_time_.emplace(until, token);
      wake = nullptr;
    }
  }
  tick_.notify_one();
  if (wake) wake();
  return token;
}

std::function<void()> Notifier::take(Waiters::iterator waiter) {
  const auto erase = [&](auto& index, const auto& key) {
    for (auto [at, end] = index.equal_range(key); at != end; ++at) {
      if (at->second != waiter->first) continue;
      index.erase(at);
      return;
    }
  };
  erase(by_job_, waiter->second.job);
  erase(by_time_, waiter->second.until);
  auto wake = std::move(waiter->second.wake);
  waiters_.erase(waiter);
  return wake;
}

void Notifier::wake(Token token) {
  std::function<void()> call;
  {
    const std::lock_guard lock(mutex_);
    const auto found = waiters_.find(token);
    if (found == waiters_.end()) return;
    call = take(found);
  }
  call();
}

void Notifier::changed(const std::string& job) {
  std::vector<std::function<void()>> calls;
  {
    const std::lock_guard lock(mutex_);
    for (auto found = by_job_.find(job); found != by_job_.end(); found = by_job_.find(job))
      calls.push_back(take(waiters_.find(found->second)));
  }
  for (const auto& call : calls) call();
}

void Notifier::release() {
  std::vector<std::function<void()>> calls;
  {
    const std::lock_guard lock(mutex_);
    released_ = true;
    while (!waiters_.empty()) calls.push_back(take(waiters_.begin()));
  }
  for (const auto& call : calls) call();
}

void Notifier::loop() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    if (by_time_.empty()) {
      tick_.wait(lock);
      continue;
    }
    const auto first = by_time_.begin();
    if (first->first > Clock::now()) {
      tick_.wait_until(lock, Clock::time_point(first->first));
      continue;
    }
    const auto call = take(waiters_.find(first->second));
    lock.unlock();
    call();
    lock.lock();
  }
}

}  // namespace bahnwerk::server
