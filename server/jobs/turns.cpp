#include "server/jobs/turns.hpp"

#include <chrono>
#include <new>

namespace bahnwerk::server {
namespace {

constexpr std::chrono::milliseconds ask_interval{50};

/// Counts for as long as it lives.
class Counted {
 public:
  explicit Counted(unsigned& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  unsigned& count_;
};

}  // namespace

/// A turn, from the moment at which it may begin; `company` tells whether others ran at any time of it.
class Turns::Hold {
 public:
  Hold(Turns& turns, Turn turn, const std::function<void()>& ask) : turns_(turns), turn_(turn) {
    std::unique_lock lock(turns_.mutex_);
    if (turn == Turn::alone) {
      const Counted waiting(turns_.waiting_alone_);
      turns_.wait(lock, ask, [&] { return turns_.running_ == 0; });
      turns_.alone_ = true;
    } else {
      turns_.wait(lock, ask, [&] { return !turns_.alone_ && turns_.waiting_alone_ == 0; });
    }
    company_ = turns_.running_ > 0;
    ++turns_.running_;
    number_ = ++turns_.begun_;
  }
  ~Hold() {
    const std::lock_guard lock(turns_.mutex_);
    --turns_.running_;
    if (turn_ == Turn::alone) turns_.alone_ = false;
    turns_.changed_.notify_all();
  }
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  bool company() const {
    const std::lock_guard lock(turns_.mutex_);
    return company_ || turns_.begun_ != number_;
  }

 private:
  Turns& turns_;
  const Turn turn_;
  bool company_ = false;
  std::uint64_t number_ = 0;
};

void Turns::wait(std::unique_lock<std::mutex>& lock, const std::function<void()>& ask,
                 const std::function<bool()>& due) {
  while (!changed_.wait_for(lock, ask_interval, due)) {
    lock.unlock();
    ask();
    lock.lock();
  }
}

void Turns::run(const std::function<void()>& work, const std::function<void()>& ask,
                const std::function<void()>& before_alone) {
  {
    const Hold hold(*this, Turn::beside, ask);
    try {
      return work();
    } catch (const std::bad_alloc&) {
      if (!hold.company()) throw;
    }
  }
  const Hold hold(*this, Turn::alone, ask);
  before_alone();
  work();
}

}  // namespace bahnwerk::server
