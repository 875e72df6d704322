#pragma once
/// One client's connection: a coroutine that reads a request, awaits its answer, writes it, and again. Only
/// listener.cpp and connection.cpp include this (Beast is heavy).
#include <atomic>
#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <memory>
#include <optional>

#include "server/http/listener.hpp"

namespace bahnwerk::server {

/// What all connections of a listener share.
struct ConnectionContext {
  Limits limits;
  ListenerHooks hooks;
  std::atomic<bool> closing{false};
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::ip::tcp::socket socket, std::shared_ptr<ConnectionContext> context);

  boost::asio::awaitable<void> serve();   ///< until the client or a fault ends it
  boost::asio::awaitable<void> refuse();  ///< answers 503 and closes
  void close_if_idle();                   ///< from any thread

 private:
  struct Incoming;  ///< a request as read, or the answer to a broken one
  boost::asio::awaitable<bool> await_first_byte();
  boost::asio::awaitable<std::optional<Incoming>> read();
  boost::asio::awaitable<Response> answer(RequestPtr request);
  boost::asio::awaitable<bool> write(Response response, const Incoming& incoming);
  boost::asio::awaitable<bool> write_stream(Response response, const Incoming& incoming);
  void stop_when_gone(std::shared_ptr<Feed> feed);  ///< tells the feed when the client closes its side
  boost::asio::awaitable<bool> write_raw(std::string text);
  boost::asio::awaitable<void> linger();
  void expire(std::chrono::milliseconds base, std::size_t bytes);

  boost::beast::tcp_stream stream_;
  std::shared_ptr<ConnectionContext> context_;
  boost::beast::flat_buffer buffer_;
  std::string peer_;
  bool idle_ = false;
};

}  // namespace bahnwerk::server
