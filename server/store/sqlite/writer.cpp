#include "server/store/sqlite/writer.hpp"

#include <future>
#include <memory>

#include "server/runtime/clock.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t max_group = 512;

}  // namespace

Writer::Writer(Connection& connection, Observer observer) : connection_(connection), observer_(std::move(observer)) {
  thread_ = std::thread([this] { loop(); });
}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Writer::post(Work work, Done done) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(work), std::move(done)});
  }
  wake_.notify_one();
}

void Writer::run(const Work& work) {
  const auto promise = std::make_shared<std::promise<void>>();  // outlives whichever side is later
  post(work, [promise](const std::exception_ptr& error) {
    if (error)
      promise->set_exception(error);
    else
      promise->set_value();
  });
  promise->get_future().get();
}

void Writer::loop() {
  for (;;) {
    std::deque<Item> group;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      if (waiting_.size() <= max_group) {
        group.swap(waiting_);
      } else {
        for (std::size_t i = 0; i < max_group; ++i) {
          group.push_back(std::move(waiting_.front()));
          waiting_.pop_front();
        }
      }
    }
    commit(group);
  }
}

void Writer::commit(std::deque<Item>& group) {
  const auto start = std::chrono::steady_clock::now();
  std::exception_ptr error;
  try {
    connection_.execute("BEGIN IMMEDIATE");
    for (Item& item : group) item.work(connection_);
    connection_.execute("COMMIT");
    observer_(seconds_since(start), group.size());
  } catch (...) {
    error = std::current_exception();
    connection_.rollback();
  }
  if (error && group.size() > 1) {  // one bad work must not fail its neighbours
    for (Item& item : group) {
      std::deque<Item> alone;
      alone.push_back(std::move(item));
      commit(alone);
    }
    return;
  }
  for (Item& item : group) {
    if (item.done) item.done(error);
    item = {};  // what it captured goes before the next group is awaited
  }
}

}  // namespace bahnwerk::server
