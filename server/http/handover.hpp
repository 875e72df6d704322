#pragma once
/// Transfers values from threads without a coroutine to a coroutine. Only connection.cpp includes this.
#include <atomic>
#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <memory>
#include <optional>

#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace asio = boost::asio;
constexpr auto tuple_awaitable = asio::as_tuple(asio::use_awaitable);

/// A value that another thread passes to a coroutine: `set` posts it to the coroutine's strand, `get` awaits it there.
template <class Value>
class Handover {
 public:
  explicit Handover(const asio::any_io_executor& executor) : timer_(executor, asio::steady_timer::time_point::max()) {}
  static void set(const std::shared_ptr<Handover>& self, Value value) {
    if (self->taken_.exchange(true)) return;
    asio::post(self->timer_.get_executor(), [self, value = std::move(value)]() mutable {
      self->value_ = std::move(value);
      self->timer_.cancel();
    });
  }
  asio::awaitable<Value> get() {
    while (!value_) co_await timer_.async_wait(tuple_awaitable);
    co_return std::move(*value_);
  }

 private:
  asio::steady_timer timer_;
  std::atomic<bool> taken_{false};
  std::optional<Value> value_;
};

/// Held by every copy of a Reply: when the last copy is destroyed without an answer, the client still gets one.
struct Promise {
  explicit Promise(std::shared_ptr<Handover<Response>> to) : handover(std::move(to)) {}
  Promise(const Promise&) = delete;
  Promise& operator=(const Promise&) = delete;
  std::shared_ptr<Handover<Response>> handover;
  ~Promise() { Handover<Response>::set(handover, http_error_answer(500, "The request was given up.", "")); }
};

}  // namespace bahnwerk::server
