#include "server/jobs/notifier.hpp"

namespace bahnwerk::server {

Notifier::Notifier(const TimeSource& time) : time_(time), thread_([this] { loop(); }) {}

Notifier::~Notifier() {
  release();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  tick_.notify_one();
  thread_.join();
}

Notifier::Token Notifier::wait(const std::string& job, Clock::time_point until, std::function<void()> wake,
                               std::optional<Clock::time_point> progress_from) {
  Token token = 0;
  {
    const std::lock_guard lock(mutex_);
    token = next_++;
    if (!released_) {
      waiters_.emplace(token, Waiter{job, until, std::move(wake), progress_from});
      by_job_.emplace(job, token);
      by_time_.emplace(until, token);
      wake = nullptr;
    }
  }
  tick_.notify_one();
  if (wake) wake();
  return token;
}

namespace {

template <class Index>
void erase(Index& index, const typename Index::key_type& key, Notifier::Token token) {
  for (auto [at, end] = index.equal_range(key); at != end; ++at) {
    if (at->second != token) continue;
    index.erase(at);
    return;
  }
}

}  // namespace

std::function<void()> Notifier::take(Waiters::iterator waiter) {
  erase(by_job_, waiter->second.job, waiter->first);
  erase(by_time_, waiter->second.until, waiter->first);
  auto wake = std::move(waiter->second.wake);
  waiters_.erase(waiter);
  return wake;
}

void Notifier::advance(Waiters::iterator waiter, Clock::time_point until) {
  if (waiter->second.until <= until) return;
  erase(by_time_, waiter->second.until, waiter->first);
  waiter->second.until = until;
  by_time_.emplace(until, waiter->first);
}

bool Notifier::watched() const {
  const std::lock_guard lock(mutex_);
  return !waiters_.empty();
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

void Notifier::changed(const std::string& job, Change change) {
  std::vector<std::function<void()>> calls;
  bool sooner = false;
  {
    const std::lock_guard lock(mutex_);
    const auto now = time_.now();
    for (auto [at, end] = by_job_.equal_range(job); at != end;) {
      const auto waiter = waiters_.find(at->second);
      ++at;  // take() removes the entry
      const auto& from = waiter->second.progress_from;
      if (change == Change::state || (from && now >= *from))
        calls.push_back(take(waiter));
      else if (from) {
        advance(waiter, *from);
        sooner = true;
      }
    }
  }
  if (sooner) tick_.notify_one();
  for (const auto& call : calls) call();
}

std::vector<std::function<void()>> Notifier::take_all() {
  std::vector<std::function<void()>> calls;
  while (!waiters_.empty()) calls.push_back(take(waiters_.begin()));
  return calls;
}

void Notifier::all_changed() {
  std::vector<std::function<void()>> calls;
  {
    const std::lock_guard lock(mutex_);
    calls = take_all();
  }
  for (const auto& call : calls) call();
}

void Notifier::release() {
  std::vector<std::function<void()>> calls;
  {
    const std::lock_guard lock(mutex_);
    released_ = true;
    calls = take_all();
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
    if (first->first > time_.now()) {
      time_.wait_until(lock, tick_, Clock::time_point(first->first));
      continue;
    }
    const auto call = take(waiters_.find(first->second));
    lock.unlock();
    call();
    lock.lock();
  }
}

}  // namespace bahnwerk::server
