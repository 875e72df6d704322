#include "server/runtime/pool.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

namespace bahnwerk::server {

struct Pool::State {
  explicit State(unsigned count) : threads(count) {}
  boost::asio::thread_pool threads;
};

Pool::Pool(unsigned threads) : state_(std::make_unique<State>(threads)) {}
Pool::~Pool() { join(); }
void Pool::post(std::function<void()> work) { boost::asio::post(state_->threads, std::move(work)); }
void Pool::join() { state_->threads.join(); }

}  // namespace bahnwerk::server
