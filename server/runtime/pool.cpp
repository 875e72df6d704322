#include "server/runtime/pool.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <condition_variable>
#include <mutex>

#include "server/runtime/log.hpp"
#include "server/runtime/priority.hpp"

namespace bahnwerk::server {

struct Pool::State {
  State(unsigned count, int lower_by) : nice(lower_by), threads(count) {}
  const int nice;
  std::mutex mutex;
  std::condition_variable idle;
  std::size_t pending = 0;
  boost::asio::thread_pool threads;
};

Pool::Pool(unsigned threads, int nice) : state_(std::make_unique<State>(threads, nice)) {}
Pool::~Pool() { join(); }

void Pool::post(std::function<void()> work) {
  {
    const std::lock_guard lock(state_->mutex);
    ++state_->pending;
  }
  boost::asio::post(state_->threads, [state = state_.get(), work = std::move(work)]() mutable {
    thread_local bool lowered = false;
    if (!lowered) lower_priority(state->nice);
    lowered = true;
    try {
      work();
    } catch (const std::exception& error) {  // no memory even to say so
      log::error("work_failed", {{"detail", error.what()}});
    }
    work = nullptr;  // the task's captures are destroyed before it counts as done
    const std::lock_guard lock(state->mutex);
    if (--state->pending == 0) state->idle.notify_all();
  });
}

bool Pool::wait_idle(std::chrono::milliseconds patience) {
  std::unique_lock lock(state_->mutex);
  return state_->idle.wait_for(lock, patience, [&] { return state_->pending == 0; });
}

void Pool::join() { state_->threads.join(); }

}  // namespace bahnwerk::server
